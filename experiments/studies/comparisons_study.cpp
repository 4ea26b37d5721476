// Other methods on the same scans, against the same truth (CurveFusion 4, Comparisons, and its
// figure 2). experiments/baselines says what each is given.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "capture/content/colour_findings.h"
#include "capture/sequence.h"
#include "experiments/baselines/lifted_edges.h"
#include "experiments/baselines/merged_skeleton.h"
#include "experiments/baselines/volumetric_fusion.h"
#include "experiments/metrics/truth.h"
#include "experiments/pictures/orthographic_view.h"
#include "experiments/studies/bar_panels.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/method_outcome.h"
#include "experiments/studies/reconstruction_run.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

// As a mesh is cut to the object (PartAroundTruth).
constexpr double kMargin = 30 * kMillimetre;

enum class Kind { kCurveFusion, kVolume, kKinectFusion, kAllFrames, kColourEdges };

struct Method {
  const char* name;
  Kind kind;
  double voxel_mm = 0;
  const char* poses = "orbslam2";
};
// KinectFusion's volume is that of 5 mm, near the 5.9 mm of its 512^3 voxels over 3 m.
constexpr Method kMethods[] = {{"VolumeFusion 2 mm", Kind::kVolume, 2},
                               {"VolumeFusion 4 mm", Kind::kVolume, 4},
                               {"VolumeFusion 5 mm", Kind::kVolume, 5},
                               {"BundleFusion poses", Kind::kVolume, 4, "bundlefusion"},
                               {"KinectFusion", Kind::kKinectFusion, 5},
                               {"L1 of all frames", Kind::kAllFrames},
                               {"colour edges", Kind::kColourEdges}};

bool IsSurface(Kind kind) { return kind == Kind::kVolume || kind == Kind::kKinectFusion; }

Kind KindOf(const std::string& method) {
  for (const Method& known : kMethods) {
    if (known.name == method) return known.kind;
  }
  return Kind::kCurveFusion;
}

std::vector<std::string> ComparedObjects(const StudyRequest& request) {
  if (!request.objects.empty()) return ObjectsOf(request);
  if (request.quick) return {"cat"};
  return {"hanger", "cage", "cat"};  // the first is that of the paper's figure 2
}

Config ConfigOf(const StudyRequest& request, const Method& method) {
  if (!IsSurface(method.kind)) return CaseConfig(request, Profile::kPaper);
  return CaseConfig(request, Profile::kPaper,
                    {fmt::format("volume.voxel_size={}", method.voxel_mm * kMillimetre),
                     fmt::format("volume.truncation_voxels={}", TsdfOptions().truncation_voxels)});
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const std::string& object : ComparedObjects(request)) {
    for (const uint64_t seed : SeedsOf(request)) {
      const SimulationOptions scan = ObjectScan(request, object, seed);
      for (const Profile profile : request.profiles) {
        cases.push_back({{{"object", object}, {"method", ProfileName(profile)}},
                         seed,
                         scan,
                         CaseConfig(request, profile)});
      }
      for (const Method& method : kMethods) {
        StudyCase other{
            {{"object", object}, {"method", method.name}}, seed, scan, ConfigOf(request, method)};
        other.scan->pose_source = method.poses;
        cases.push_back(other);
      }
    }
  }
  return cases;
}

Eigen::AlignedBox3d BoxAround(const SkeletonGraph& truth) {
  Eigen::AlignedBox3d box = ViewBounds(truth, Mat3::Identity());
  return {box.min() - Vec3::Constant(kMargin), box.max() + Vec3::Constant(kMargin)};
}

RunOutcome RunCurveFusion(const RunInput& input, Sequence sequence, const SkeletonGraph& truth) {
  UseFittedColourCamera(sequence);  // as the command does
  InterruptibleObserver observer(input.progress);
  const Reconstruction result = Reconstruct(sequence, input.study_case.config.pipeline, observer);
  return KeepSkeletonOfMethod(input, result.skeleton, result.points, truth);
}

RunOutcome Run(const RunInput& input) {
  const Sequence sequence = OpenSequence(input.scan);
  const SkeletonGraph truth = ReadTruth(input.scan / "truth");
  const PipelineOptions& options = input.study_case.config.pipeline;
  const auto keep = [&](const SkeletonOfPoints& result) {
    return KeepSkeletonOfMethod(input, result.skeleton, result.points, truth);
  };
  switch (KindOf(LabelOf(input.study_case.labels, "method"))) {
    case Kind::kVolume:
      return KeepSurfaceOfMethod(
          input, VolumeFusionSurface(sequence, VolumeOptions(options), input.progress), truth);
    case Kind::kKinectFusion:
      return KeepSurfaceOfMethod(
          input, FuseAsKinectFusion(sequence, VolumeOptions(options), input.progress).surface,
          truth);
    case Kind::kAllFrames:
      return keep(SkeletonOfAllFrames(sequence, std::get<PaperOptions>(options), input.progress));
    case Kind::kColourEdges:
      return keep(SkeletonOfColourEdges(sequence, BoxAround(truth), std::get<PaperOptions>(options),
                                        input.progress));
    case Kind::kCurveFusion:
      break;
  }
  return RunCurveFusion(input, sequence, truth);
}

const std::vector<TableColumn> kColumns = {{"F5", "F5"},
                                           {"F2", "F2"},
                                           {"recall at 5 mm", "recall"},
                                           {"precision at 5 mm", "precision"},
                                           {"pieces", "pieces", 0}};

// What each method gives of the first seed, seen from the same side: a row an object.
void DrawPictures(const StudyResults& results) {
  PictureGrid grid;
  grid.cell_width = 1.25;  // the longest name of a method fits
  for (const RunGroup& method : GroupRuns(results.runs, {"method"})) {
    grid.columns.push_back(method.labels.front().second);
  }
  for (const RunGroup& object : GroupRuns(results.runs, {"object"})) {
    grid.rows.push_back(object.labels.front().second);
    for (const std::string& method : grid.columns) {
      const auto run = std::find_if(object.runs.begin(), object.runs.end(), [&](const StudyRun* r) {
        return LabelOf(r->labels, "method") == method;
      });
      const char* file = IsSurface(KindOf(method)) ? "mesh.png" : "skeleton.png";
      const bool is_there = run != object.runs.end() && fs::exists((*run)->folder / file);
      grid.pictures.push_back(
          is_there ? fs::relative((*run)->folder / file, results.folder).string() : "");
    }
  }
  DrawPictureGrid(results.folder, results.stem + "_pictures", grid);
}

void Report(const StudyResults& results) {
  WriteTable(results.folder, results.stem,
             MedianTable(GroupRuns(results.runs, {"object", "method"}), kColumns));
  DrawBarPanels(results, {"method"},
                {{"F at 5 mm, aligned", "F5"},
                 {"F at 2 mm, aligned", "F2"},
                 {"Recall at 5 mm", "recall"},
                 {"Precision at 5 mm", "precision"}});
  DrawPictures(results);
}

}  // namespace

Study ComparisonsStudy() {
  return {"comparisons",
          "VolumeFusion, KinectFusion, L1 of all frames and colour edges beside both profiles",
          Cases,
          Run,
          Report};
}

}  // namespace curvefusion
