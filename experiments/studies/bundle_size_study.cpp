// How many frames make a bundle? "when too few frames are grouped together, e.g. k=1 or 4, the
// merged point cloud is too sparse and leads to a broken partial skeleton ... when too many, e.g.
// k=240 or 1000, the merged point cloud becomes more dense but too blurry"; and VolumeFusion "fails
// to produce satisfactory reconstruction from any accumulated point cloud" (CurveFusion 5, Effect
// of bundle size, and its figure).
#include <fmt/format.h>

#include <algorithm>

#include "capture/sequence.h"
#include "capture/trajectory.h"
#include "experiments/baselines/volumetric_fusion.h"
#include "experiments/metrics/truth.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/method_outcome.h"
#include "experiments/studies/reconstruction_run.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"
#include "fusion/best/best_pipeline.h"
#include "fusion/paper/paper_pipeline.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr int kFrames = 1000;  // the most that the paper names
constexpr int kQuickFrames = 80;
constexpr const char* kVolume = "VolumeFusion";
// Fine enough for a wire of 4.5 mm; a finer one holds more noise, not more wire.
constexpr double kFineVoxel = 2 * kMillimetre;
// The room behind the wires is seen in every frame: a third of them shows it as well.
constexpr int kRoomStride = 3;

struct Scale {
  std::vector<std::string> objects;
  std::vector<int> sizes;
  int frames;
};

Scale ScaleOf(const StudyRequest& request) {
  Scale scale = {{"cat"}, {1, 4, 10, 30, 80, 240, kFrames}, kFrames};
  if (request.quick) scale = {{"cat"}, {1, 4, 10, 30, kQuickFrames}, kQuickFrames};
  if (!request.objects.empty()) scale.objects = ObjectsOf(request);
  return scale;
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  const Scale scale = ScaleOf(request);
  std::vector<StudyCase> cases;
  for (const std::string& object : scale.objects) {
    for (const uint64_t seed : SeedsOf(request)) {
      SimulationOptions scan;
      scan.object = object;
      scan.seed = seed;
      scan.frames = scale.frames;
      for (const int size : scale.sizes) {
        const auto add = [&](const std::string& method, const Config& config) {
          cases.push_back(
              {{{"object", object}, {"frames", std::to_string(size)}, {"method", method}},
               seed,
               scan,
               config});
        };
        for (const Profile profile : request.profiles) {
          add(ProfileName(profile),
              CaseConfig(request, profile, {fmt::format("bundle.frames={}", size)}));
        }
        add(kVolume, CaseConfig(request, Profile::kPaper,
                                {fmt::format("volume.voxel_size={}", kFineVoxel),
                                 fmt::format("volume.truncation_voxels={}",
                                             TsdfOptions().truncation_voxels)}));
      }
    }
  }
  return cases;
}

// The scan moved so that the pose of its middle frame is the true one: a single bundle is wrong by
// the drift within it, not by the drift before it.
Sequence AnchoredScan(const std::filesystem::path& scan) {
  Sequence sequence = OpenSequence(scan);
  const Trajectory truth = ReadTumTrajectory(scan / "truth" / "trajectory.txt", [](const auto&) {});
  const SequenceFrame& middle = sequence.frames[sequence.frames.size() / 2];
  const StampedPose* pose = NearestPose(truth, middle.timestamp);
  if (pose == nullptr) {
    throw Error(ErrorKind::kBadInput,
                (scan / "truth").string() + ": has no pose at " + middle.name);
  }
  const RigidTransform T_true_given = pose->T_world_camera * middle.T_world_camera.inverse();
  for (SequenceFrame& frame : sequence.frames) {
    frame.T_world_camera = T_true_given * frame.T_world_camera;
  }
  return sequence;
}

// So many frames around the middle one.
Sequence MiddleFrames(const Sequence& sequence, int count) {
  Sequence middle = sequence;
  const int first = std::max(0, sequence.frame_count() / 2 - count / 2);
  const int last = std::min(first + count, sequence.frame_count());
  middle.frames.assign(sequence.frames.begin() + first, sequence.frames.begin() + last);
  return middle;
}

RunOutcome RunVolume(const RunInput& input, const Sequence& bundle, const SkeletonGraph& truth) {
  const TsdfOptions options = VolumeOptions(input.study_case.config.pipeline);
  return KeepSurfaceOfMethod(input, VolumeFusionSurface(bundle, options, input.progress), truth);
}

// The rest of a profile's method where the room's large surfaces are known already.
Reconstruction ReconstructIn(const TsdfVolume& room, const Sequence& bundle,
                             const PipelineOptions& options, PipelineObserver& observer) {
  if (const auto* paper = std::get_if<PaperOptions>(&options)) {
    return ReconstructPaperAgainst(room, bundle, *paper, observer);
  }
  return ReconstructBestAgainst(room, bundle, std::get<BestOptions>(options), observer);
}

RunOutcome RunSkeleton(const RunInput& input, const Sequence& scan, const Sequence& bundle,
                       const SkeletonGraph& truth) {
  const Config& config = input.study_case.config;
  const TsdfVolume room =
      FusedVolume(scan, VolumeOptions(config.pipeline), input.progress, kRoomStride);
  InterruptibleObserver observer(input.progress);
  const Reconstruction result = ReconstructIn(room, bundle, config.pipeline, observer);
  return KeepSkeletonOfMethod(input, result.skeleton, result.points, truth);
}

RunOutcome Run(const RunInput& input) {
  const Labels& labels = input.study_case.labels;
  const Sequence scan = AnchoredScan(input.scan);
  const Sequence bundle = MiddleFrames(scan, std::stoi(LabelOf(labels, "frames")));
  const SkeletonGraph truth = ReadTruth(input.scan / "truth");
  return LabelOf(labels, "method") == kVolume ? RunVolume(input, bundle, truth)
                                              : RunSkeleton(input, scan, bundle, truth);
}

const std::vector<TableColumn> kColumns = {
    {"F5", "F5"},
    {"F2", "F2"},
    {"recall at 5 mm", "recall"},
    {"precision at 5 mm", "precision"},
    {"junction recall", "aligned.junctions_10mm.recall"},
    {"junction precision", "aligned.junctions_10mm.precision"},
    {"pieces", "pieces", 0}};

struct Panel {
  const char* title;
  const char* figure;
};
constexpr Panel kPanels[] = {{"F at 5 mm", "F5"},
                             {"F at 2 mm", "F2"},
                             {"Junction recall", "aligned.junctions_10mm.recall"},
                             {"Pieces (truth: 1)", "pieces"}};

std::vector<std::string> PanelFigures() {
  std::vector<std::string> figures;
  for (const Panel& panel : kPanels) figures.emplace_back(panel.figure);
  return figures;
}

std::string PlotCommands(const std::vector<RunGroup>& methods, const std::vector<RunGroup>& sizes,
                         double most_pieces) {
  std::vector<std::string> ticks;
  for (const RunGroup& size : sizes) ticks.push_back(size.labels.front().second);
  std::string commands =
      fmt::format("set xrange [0.8:{}*1.3]\nset xtics ({})\n", ticks.back(),
                  fmt::join(ticks, ", ")) +
      "set datafile missing '?'\nset logscale x\nset xlabel 'Frames in the bundle' offset 0,0.4\n"
      "set object 1 rectangle from first 10,graph 0 to first 80,graph 1 behind fillcolor rgb "
      "'#F3F3F3' fillstyle solid noborder\n"
      "set multiplot layout 2,2 margins 0.07,0.985,0.11,0.88 spacing 0.09,0.20\n"
      "set key at screen 0.5,0.985 center top horizontal maxrows 1\n";
  int column = 2;
  for (const Panel& panel : kPanels) {
    const bool is_count = std::string(panel.figure) == "pieces";
    commands += fmt::format(
        "set title '{}' offset 0,-0.6\n{}\n", panel.title,
        is_count
            ? fmt::format("set logscale y; set yrange [0.8:{}]; set ytics auto", 1.3 * most_pieces)
            : "set yrange [0:1.05]; set ytics 0.2");
    std::vector<std::string> parts;
    for (size_t i = 0; i < methods.size(); ++i) {
      parts.push_back(fmt::format(
          "data index {0} using ($1*{1:.3f}):{2}:{3}:{4} with yerrorlines lt {5} title '{6}'", i,
          1 + 0.06 * static_cast<double>(i), column, column + 1, column + 2, i + 1,
          methods[i].labels.front().second));
    }
    commands += fmt::format("plot {}\nunset key\n", fmt::join(parts, ", "));
    column += 3;
  }
  return commands + "unset multiplot";
}

struct PictureRow {
  std::string name;
  std::string method;
  std::string file;
};

// The paper's figure for one object: a column a bundle size; the first seed's pictures.
void DrawPictures(const StudyResults& results, const RunGroup& object,
                  const std::vector<RunGroup>& methods) {
  std::vector<PictureRow> rows;
  for (const RunGroup& method : methods) {
    const std::string name = method.labels.front().second;
    if (name == kVolume) continue;
    rows.push_back({name + ": points", name, "points.png"});
    rows.push_back({name + ": skeleton", name, "skeleton.png"});
  }
  rows.push_back({kVolume, kVolume, "mesh.png"});
  PictureGrid grid;
  for (const PictureRow& row : rows) {
    grid.rows.push_back(row.name);
    for (const StudyRun* run : object.runs) {
      if (run->seed != object.runs.front()->seed) continue;
      if (LabelOf(run->labels, "method") != row.method) continue;
      if (grid.rows.size() == 1) grid.columns.push_back("k = " + LabelOf(run->labels, "frames"));
      const std::filesystem::path picture = run->folder / row.file;
      grid.pictures.push_back(std::filesystem::exists(picture)
                                  ? std::filesystem::relative(picture, results.folder).string()
                                  : "");
    }
  }
  DrawPictureGrid(results.folder, results.stem + "_" + object.labels.front().second, grid);
}

void Report(const StudyResults& results) {
  const std::vector<RunGroup> methods = GroupRuns(results.runs, {"method"});
  const std::vector<RunGroup> sizes = GroupRuns(results.runs, {"method", "frames"});
  WriteTable(results.folder, results.stem, MedianTable(sizes, kColumns));
  WriteTable(results.folder, results.stem + "_objects",
             MedianTable(GroupRuns(results.runs, {"object", "method", "frames"}), kColumns));
  DrawPlot(results.folder, results.stem,
           {SpreadBlocks(sizes, "method", "frames", PanelFigures()),
            PlotCommands(methods, GroupRuns(results.runs, {"frames"}),
                         GreatestOf(results.runs, "pieces", 10)),
            6.5, 4.2});
  for (const RunGroup& object : GroupRuns(results.runs, {"object"})) {
    DrawPictures(results, object, methods);
  }
}

}  // namespace

Study BundleSizeStudy() {
  return {"bundle-size",
          "Skeletons of a single bundle of 1 to 1,000 frames, and VolumeFusion of the same frames",
          Cases, Run, Report};
}

}  // namespace curvefusion
