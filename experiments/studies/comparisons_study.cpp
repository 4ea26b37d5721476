// Other methods on the same scans, against the same truth (CurveFusion 5, Comparisons, and its
// figure 2). experiments/baselines says what each is given.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "capture/content/colour_findings.h"
#include "capture/frame_stream.h"
#include "capture/sequence.h"
#include "experiments/baselines/lifted_edges.h"
#include "experiments/baselines/merged_skeleton.h"
#include "experiments/baselines/silhouette_maps.h"
#include "experiments/baselines/silhouette_voxels.h"
#include "experiments/baselines/three_view_wires.h"
#include "experiments/baselines/volumetric_fusion.h"
#include "experiments/metrics/curve_metrics.h"
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

// Images of Liu 2017 are so many times as wide as the depth camera's: 2560 x 1920 pixels. Those of
// the authors' examples are 2464 x 1632 and 3008 x 2008.
constexpr double kWireImageScale = 4;

// "40 calibrated cameras" of the original setup of Tabb 2013 (CurveFusion 5, Comparisons).
constexpr int kSilhouetteViews = 40;

enum class Kind {
  kCurveFusion,
  kVolume,
  kKinectFusion,
  kAllFrames,
  kBundle,
  kBridgedBundle,
  kColourEdges,
  kSilhouettes,
  kStudio,
  kThreeViews,
  kThreeViewsStrict
};

struct Method {
  const char* name;
  Kind kind;
  double voxel_mm = 0;
  const char* poses = "orbslam2";
  double wire_mm = 0;  // in place of the object's own
};
// "Thin structures of diameter larger than 10 mm can be reconstructed with reasonable quality using
// the conventional KinectFusion pipeline" (CurveFusion 4, assumption iv): the object of 15 mm wire.
// KinectFusion's volume is that of 5 mm, near the 5.9 mm of its 512^3 voxels over 3 m. Tabb 2013
// has the finest voxels of VolumeFusion, 1.5 pixels wide at .7 m; it had 3.6 mm for trees.
constexpr Method kMethods[] = {{"VolumeFusion 2 mm", Kind::kVolume, 2},
                               {"VolumeFusion 4 mm", Kind::kVolume, 4},
                               {"VolumeFusion 5 mm", Kind::kVolume, 5},
                               {"BundleFusion poses", Kind::kVolume, 4, "bundlefusion"},
                               {"KinectFusion", Kind::kKinectFusion, 5},
                               {"KinectFusion, 15 mm", Kind::kKinectFusion, 5, "orbslam2", 15},
                               {"L1 of all frames", Kind::kAllFrames},
                               {"L1 of a bundle", Kind::kBundle},
                               {"Huang 2013 branches", Kind::kBridgedBundle},
                               {"colour edges", Kind::kColourEdges},
                               {"Tabb 2013", Kind::kSilhouettes, 2},
                               {"Tabb 2013 studio", Kind::kStudio, 2},
                               {"Liu 2017", Kind::kThreeViews},
                               {"Liu 2017 strict", Kind::kThreeViewsStrict}};

bool IsVolume(Kind kind) { return kind == Kind::kVolume || kind == Kind::kKinectFusion; }

bool IsSilhouettes(Kind kind) { return kind == Kind::kSilhouettes || kind == Kind::kStudio; }

bool IsSurface(Kind kind) { return IsVolume(kind) || IsSilhouettes(kind); }

Method MethodNamed(const std::string& name) {
  for (const Method& known : kMethods) {
    if (known.name == name) return known;
  }
  return {"CurveFusion", Kind::kCurveFusion};
}

Kind KindOf(const std::string& method) { return MethodNamed(method).kind; }

std::vector<std::string> ComparedObjects(const StudyRequest& request) {
  if (!request.objects.empty()) return ObjectsOf(request);
  if (request.quick) return {"cat"};
  return {"hanger", "cage", "cat"};  // the first is that of the paper's figure 2
}

Config ConfigOf(const StudyRequest& request, const Method& method) {
  if (!IsVolume(method.kind)) return CaseConfig(request, Profile::kPaper);
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
        other.scan->object_options.wire_diameter = method.wire_mm * kMillimetre;
        cases.push_back(other);
      }
    }
  }
  return cases;
}

RunOutcome RunCurveFusion(const RunInput& input, Sequence sequence, const SkeletonGraph& truth) {
  UseFittedColourCamera(sequence);  // as the command does
  InterruptibleObserver observer(input.progress);
  const Reconstruction result = Reconstruct(sequence, input.study_case.config.pipeline, observer);
  RunOutcome outcome = KeepSkeletonOfMethod(input, result.skeleton, result.points, truth);
  AddSurfaceOfCurves(result.skeleton, input.study_case.config.tubes, truth, outcome.figures);
  return outcome;
}

double MeanDistance(const Sequence& sequence, const Vec3& p) {
  double sum = 0;
  for (const SequenceFrame& frame : sequence.frames) {
    sum += (frame.T_world_camera.translation() - p).norm();
  }
  return sum / sequence.frame_count();
}

// What a user can segment of the scan's colour images; or true silhouettes of the depth camera all
// around the object, as far away as in the scan.
std::vector<SilhouetteMap> SilhouettesOf(const RunInput& input, Sequence sequence, Kind kind,
                                         const SkeletonGraph& truth) {
  if (kind == Kind::kStudio) {
    const Vec3 center = BoxAround(truth).center();
    return TrueSilhouettes(truth, sequence.depth_camera,
                           PosesAround(center, MeanDistance(sequence, center), kSilhouetteViews));
  }
  UseFittedColourCamera(sequence);  // as for CurveFusion
  return ColourSilhouettes(sequence, EvenlyThinned(AllFrames(sequence), kSilhouetteViews),
                           std::get<PaperOptions>(input.study_case.config.pipeline),
                           input.progress);
}

RunOutcome RunTabb(const RunInput& input, const Sequence& sequence, const Method& method,
                   const SkeletonGraph& truth) {
  VoxelSet voxels;
  const Cost cost = CostOf([&] {
    voxels =
        FitVoxelsToSilhouettes(SilhouettesOf(input, sequence, method.kind, truth), BoxAround(truth),
                               method.voxel_mm * kMillimetre, input.progress);
  });
  RunOutcome outcome = KeepSurfaceOfMethod(input, SurfaceOf(voxels), truth);
  AddCost(cost, sequence.frame_count(), outcome.figures);
  return outcome;
}

// True silhouettes of three cameras around the middle of the scan's views, as far away as these:
// "precise camera calibration and clean background" (CurveFusion, figure 14).
std::vector<SilhouetteMap> ThreeSilhouettes(const Sequence& sequence, const SkeletonGraph& truth) {
  const Vec3 center = BoxAround(truth).center();
  Vec3 away = Vec3::Zero();
  for (const SequenceFrame& frame : sequence.frames) {
    away += (frame.T_world_camera.translation() - center).normalized();
  }
  return TrueSilhouettes(
      truth, sequence.depth_camera.Scaled(kWireImageScale),
      ThreePosesAround(center, away.normalized(), MeanDistance(sequence, center)));
}

// Of the curves before the selection: how many, how long, which share of that within 5 mm of the
// truth, and of the truth within 5 mm of them; how many have more than half beyond. Poses are true,
// so nothing is aligned.
void AddCandidateFigures(const SkeletonGraph& candidates, const SkeletonGraph& truth,
                         Figures& figures) {
  const SkeletonSamples samples = SampleSkeleton(candidates), true_samples = SampleSkeleton(truth);
  const PrecisionRecall scores = CompareCurves(samples, true_samples).within[2];
  static_assert(kDistanceThresholds[2] == 5 * kMillimetre);
  figures["candidates"] = candidates.edge_count();
  figures["candidate_length"] = candidates.TotalLength();
  figures["candidate_precision"] = scores.precision.value_or(0);
  figures["candidate_recall"] = scores.recall.value_or(0);
  const std::vector<double> distances = DistancesTo(samples.positions, true_samples.positions);
  std::map<EdgeId, double> beyond;  // metres, less those within
  for (size_t i = 0; i < samples.size(); ++i) {
    const bool is_beyond = distances[i] > kDistanceThresholds[2];
    beyond[samples.edges[i]] += is_beyond ? samples.lengths[i] : -samples.lengths[i];
  }
  figures["spurious_candidates"] = static_cast<double>(std::count_if(
      beyond.begin(), beyond.end(), [](const auto& edge) { return edge.second > 0; }));
}

RunOutcome RunLiu(const RunInput& input, const Sequence& sequence, Kind kind,
                  const SkeletonGraph& truth) {
  const SupportRule rule =
      kind == Kind::kThreeViewsStrict ? SupportRule::kMeanDistance : SupportRule::kOfProgram;
  const std::vector<SilhouetteMap> views = ThreeSilhouettes(sequence, truth);
  ThreeViewWires wires;
  const Cost cost = CostOf([&] { wires = WiresOfThreeViews(views, rule, input.progress); });
  ObservedPoints points;  // of the candidates, for their picture
  for (const Vec3& p : SampleSkeleton(wires.candidates).positions) points.Add(p, Vec3::Zero(), 1);
  RunOutcome outcome = KeepSkeletonOfMethod(input, wires.selected, points, truth);
  AddCandidateFigures(wires.candidates, truth, outcome.figures);
  AddCost(cost, sequence.frame_count(), outcome.figures);
  return outcome;
}

// The frames of a bundle around the middle of the scan.
BundleFrames MiddleBundle(const Sequence& sequence, const PaperOptions& options) {
  const int count = std::min(options.bundle.frames, sequence.frame_count());
  const int first = (sequence.frame_count() - count) / 2;
  return {first, first + count};
}

SkeletonOfPoints L1Skeleton(const RunInput& input, const Sequence& sequence, Kind kind) {
  const auto& options = std::get<PaperOptions>(input.study_case.config.pipeline);
  const BundleFrames frames = kind == Kind::kAllFrames ? BundleFrames(0, sequence.frame_count())
                                                       : MiddleBundle(sequence, options);
  const BranchStrategy strategy = kind == Kind::kBridgedBundle ? BranchStrategy::kBridgePoints
                                                               : BranchStrategy::kExplicitJunctions;
  return SkeletonOfFrames(sequence, frames, strategy, options, input.progress);
}

RunOutcome Run(const RunInput& input) {
  const Sequence sequence = OpenSequence(input.scan);
  const SkeletonGraph truth = ReadTruth(input.scan / "truth");
  const PipelineOptions& options = input.study_case.config.pipeline;
  const auto keep = [&](const SkeletonOfPoints& result) {
    return KeepSkeletonOfMethod(input, result.skeleton, result.points, truth);
  };
  const Method method = MethodNamed(LabelOf(input.study_case.labels, "method"));
  switch (method.kind) {
    case Kind::kVolume:
      return KeepSurfaceOfMethod(
          input, VolumeFusionSurface(sequence, VolumeOptions(options), input.progress), truth);
    case Kind::kKinectFusion:
      return KeepSurfaceOfMethod(
          input, FuseAsKinectFusion(sequence, VolumeOptions(options), input.progress).surface,
          truth);
    case Kind::kAllFrames:
    case Kind::kBundle:
    case Kind::kBridgedBundle:
      return keep(L1Skeleton(input, sequence, method.kind));
    case Kind::kColourEdges:
      return keep(SkeletonOfColourEdges(sequence, BoxAround(truth), std::get<PaperOptions>(options),
                                        input.progress));
    case Kind::kSilhouettes:
    case Kind::kStudio:
      return RunTabb(input, sequence, method, truth);
    case Kind::kThreeViews:
    case Kind::kThreeViewsStrict:
      return RunLiu(input, sequence, method.kind, truth);
    case Kind::kCurveFusion:
      break;
  }
  return RunCurveFusion(input, sequence, truth);
}

const std::vector<TableColumn> kColumns = {{"F5", "F5"},
                                           {"F2", "F2"},
                                           {"recall at 5 mm", "recall"},
                                           {"precision at 5 mm", "precision"},
                                           {"pieces", "pieces", 0},
                                           {"junctions: spurious", "spurious_junctions", 0},
                                           {"missed", "missed_junctions", 0},
                                           {"surface: F2", "surface.F2"},
                                           {"surface: recall at 5 mm", "surface.recall"},
                                           {"normals off by (deg)", "normal_error_deg", 0},
                                           {"candidates", "candidates", 0},
                                           {"spurious", "spurious_candidates", 0},
                                           {"precision of all", "candidate_precision"},
                                           {"recall", "candidate_recall"}};

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
          "VolumeFusion, KinectFusion, L1 of all frames, branches of Huang 2013, colour edges, "
          "Tabb 2013 and Liu 2017 beside both profiles",
          Cases, Run, Report};
}

}  // namespace curvefusion
