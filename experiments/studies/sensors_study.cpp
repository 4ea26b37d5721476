// Which sensors are good enough? A PrimeSense is comparable to a Kinect V1, with an SR300 the rack
// of 8 mm can be reconstructed and the breadholder of 5 mm cannot, a Kinect V2 "cannot be used for
// producing any reasonable reconstruction results", and an Artec Space Spider shows wires of 1.5 mm
// (CurveFusion 5, Effect of different sensors). As in the paper's figure "we also provide a sample
// of a single depth frame and a bundle".
#include <algorithm>
#include <filesystem>

#include "capture/sequence.h"
#include "experiments/metrics/truth.h"
#include "experiments/studies/bar_panels.h"
#include "experiments/studies/fine_scan.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/method_outcome.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"
#include "graph/io/graph_io.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr int kBundle = 30;  // frames; of the paper
constexpr FrameCounts kFrames = {300, 30};  // 10 s: Table 1 of the paper has 5.5 to 23 s, and 38

struct Model {
  const char* object;
  double diameter;
};
// The diameters that the paper's figure of the sensors gives.
constexpr Model kModels[] = {{"breadholder", 5 * kMillimetre}, {"rack", 8 * kMillimetre}};

void AddCases(const StudyRequest& request, const std::string& object, const SimulationOptions& scan,
              uint64_t seed, std::vector<StudyCase>& cases) {
  for (const Profile profile : request.profiles) {
    cases.push_back(
        {{{"object", object}, {"sensor", scan.sensor}, {"profile", ProfileName(profile)}},
         seed,
         scan,
         ConfigOfScan(request, profile, scan)});
  }
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const Model& model : kModels) {
    for (const char* sensor : {"kinect_v1", "primesense", "sr300", "kinect_v2"}) {
      for (const uint64_t seed : SeedsOf(request)) {
        SimulationOptions scan = ObjectScan(request, model.object, seed, kFrames);
        scan.sensor = sensor;
        scan.object_options.wire_diameter = model.diameter;
        AddCases(request, model.object, scan, seed, cases);
      }
    }
  }
  for (const uint64_t seed : SeedsOf(request)) {
    AddCases(request, "small breadholder", FineScan(request, seed, kFrames), seed, cases);
  }
  return cases;
}

// All depth around the object that frames from `first` on show, in the world.
ObservedPoints DepthAround(const SkeletonGraph& truth, const Sequence& sequence, int first,
                           int count) {
  const Eigen::AlignedBox3d box = BoxAround(truth);
  ObservedPoints points;
  for (int frame = first; frame < std::min(first + count, sequence.frame_count()); ++frame) {
    const RigidTransform& T_world_camera = sequence.frames[frame].T_world_camera;
    const DepthImage depth = LoadDepth(sequence, frame);
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        if (!(depth(u, v) > 0)) continue;
        const Vec3 p = T_world_camera * sequence.depth_camera.Unproject(u, v, depth(u, v));
        if (!box.contains(p)) continue;
        points.Add(p, (p - T_world_camera.translation()).normalized(), 1);
      }
    }
  }
  return points;
}

RunOutcome Run(const RunInput& input) {
  const RunOutcome outcome = input.reconstruct(input);
  const SkeletonGraph truth = ReadTruth(input.scan / "truth");
  const Sequence sequence = OpenSequence(input.scan);
  const int first = std::max(0, (sequence.frame_count() - kBundle) / 2);
  const auto draw_depth = [&](const char* name, int frame, int count) {
    DrawInCommonView(input.folder / name, {}, DepthAround(truth, sequence, frame, count), truth);
  };
  draw_depth("frame.png", first + kBundle / 2, 1);
  draw_depth("bundle.png", first, kBundle);
  DrawInCommonView(input.folder / "skeleton.png", ReadSkeleton(input.folder / "skeleton.json"), {},
                   truth);
  return outcome;
}

const std::vector<TableColumn> kColumns = {
    {"F2", "aligned.curves.2mm.f"},
    {"recall at 5 mm", "aligned.curves.5mm.recall"},
    {"precision at 5 mm", "aligned.curves.5mm.precision"},
    {"false length (m)", "aligned.curves.false_length"},
    {"diameter error (mm)", "aligned.diameter.mean_error_mm"},
    {"pieces", "components", 0}};

// Of the first seed: a row an object and sensor, a frame, a bundle, then the profiles' curves.
void DrawPictures(const StudyResults& results) {
  PictureGrid grid{.columns = {"a frame", "a bundle"}};
  grid.cell_height = 1.25;  // the longest name of a row fits
  for (const RunGroup& profile : GroupRuns(results.runs, {"profile"})) {
    grid.columns.push_back(profile.labels.front().second);
  }
  for (const RunGroup& row : GroupRuns(results.runs, {"object", "sensor"})) {
    grid.rows.push_back(row.labels[0].second + "\\n" + row.labels[1].second);
    const auto picture = [&](const StudyRun& run, const char* name) {
      const fs::path file = run.folder / name;
      return fs::exists(file) ? fs::relative(file, results.folder).string() : std::string();
    };
    grid.pictures.push_back(picture(*row.runs.front(), "frame.png"));
    grid.pictures.push_back(picture(*row.runs.front(), "bundle.png"));
    for (size_t column = 2; column < grid.columns.size(); ++column) {
      const auto run = std::find_if(row.runs.begin(), row.runs.end(), [&](const StudyRun* r) {
        return LabelOf(r->labels, "profile") == grid.columns[column];
      });
      grid.pictures.push_back(run == row.runs.end() ? "" : picture(**run, "skeleton.png"));
    }
  }
  DrawPictureGrid(results.folder, results.stem + "_pictures", grid);
}

void Report(const StudyResults& results) {
  WriteTable(results.folder, results.stem,
             MedianTable(GroupRuns(results.runs, {"object", "sensor", "profile"}), kColumns));
  DrawBarPanels(results, {"object", "sensor"},
                {{"F at 2 mm, aligned", "aligned.curves.2mm.f"},
                 {"Recall at 5 mm", "aligned.curves.5mm.recall"},
                 {"Precision at 5 mm", "aligned.curves.5mm.precision"},
                 {"Pieces (truth: 1)", "components"}});
  DrawPictures(results);
}

}  // namespace

Study SensorsStudy() {
  return {"sensors",
          "Breadholder (5 mm) and rack (8 mm) on Kinect V1, PrimeSense, SR300 and Kinect V2, 1.5 "
          "mm wire on an Artec Space Spider",
          Cases, Run, Report};
}

}  // namespace curvefusion
