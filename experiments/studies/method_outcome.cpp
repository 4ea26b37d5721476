#include "experiments/studies/method_outcome.h"

#include <string>

#include "experiments/metrics/evaluation_files.h"
#include "experiments/metrics/normal_error.h"
#include "experiments/pictures/mesh_view.h"
#include "experiments/pictures/orthographic_view.h"
#include "experiments/pictures/png.h"
#include "experiments/studies/reconstruction_run.h"
#include "kernel/angle.h"

namespace curvefusion {

namespace {

constexpr int kPicture = 420;  // pixels, width and height of a picture
constexpr double kPointInk = .75;
constexpr double kFilled = .9;  // share of it that the object fills

// Where the true object stands in every picture of it.
struct Framing {
  OrthographicView view;
  Eigen::AlignedBox3d bounds;
  double scale = 1;  // pixels per metre
};

// From the side of -y, where the simulator's camera is, and a little from above.
Framing FramingOf(const SkeletonGraph& truth) {
  Framing framing;
  const Mat3 tilt = Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix();
  Mat3 front;
  front << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  framing.view = {"", tilt * front, false, kPointInk};
  framing.bounds = ViewBounds(truth, framing.view.R_view_world);
  framing.scale = kFilled * kPicture / framing.bounds.sizes().head<2>().maxCoeff();
  return framing;
}

ColorImage Picture(const SkeletonGraph& graph, const ObservedPoints& points,
                   const Framing& framing) {
  return DrawFramedView(graph, points, framing.view, framing.bounds, kPicture, kPicture,
                        framing.scale);
}

void AddCommonFigures(const std::string& kind, const std::string& pieces, Figures& figures) {
  const auto copy = [&](const std::string& from, const char* to) {
    const auto found = figures.find(from);
    figures[to] = found == figures.end() ? 0 : found->second;
  };
  copy(kind + ".5mm.f", "F5");
  copy(kind + ".2mm.f", "F2");
  copy(kind + ".5mm.recall", "recall");
  copy(kind + ".5mm.precision", "precision");
  copy(pieces, "pieces");
}

void AddJunctionFigures(Figures& figures) {
  const std::string kind = "aligned.junctions_10mm.";
  figures["spurious_junctions"] = figures.at(kind + "found") - figures.at(kind + "matched");
  figures["missed_junctions"] = figures.at(kind + "truth") - figures.at(kind + "matched");
}

void AddSurfaceFigures(const TriangleMesh& mesh, const Evaluation& evaluation,
                       const SkeletonGraph& truth, Figures& figures) {
  const SurfaceScores& scores = *evaluation.aligned.surface;
  figures["surface.F2"] = scores.within[1].F().value_or(0);
  figures["surface.recall"] = scores.within[2].recall.value_or(0);
  static_assert(kDistanceThresholds[1] == 2 * kMillimetre);
  static_assert(kDistanceThresholds[2] == 5 * kMillimetre);
  const std::optional<double> error =
      MeanNormalError(Transformed(mesh, evaluation.T_truth_result), truth);
  if (error) figures["normal_error_deg"] = *error / kDegree;
}

}  // namespace

Eigen::AlignedBox3d BoxAround(const SkeletonGraph& truth) {
  constexpr double kMargin = 30 * kMillimetre;
  const Eigen::AlignedBox3d box = BoundsOf(truth);
  return {box.min() - Vec3::Constant(kMargin), box.max() + Vec3::Constant(kMargin)};
}

void DrawInCommonView(const std::filesystem::path& file, const SkeletonGraph& graph,
                      const ObservedPoints& points, const SkeletonGraph& truth) {
  WritePng(file, Picture(graph, points, FramingOf(truth)));
}

RunOutcome KeepSkeletonOfMethod(const RunInput& input, const SkeletonGraph& skeleton,
                                const ObservedPoints& points, const SkeletonGraph& truth) {
  DrawInCommonView(input.folder / "points.png", {}, points, truth);
  DrawInCommonView(input.folder / "skeleton.png", skeleton, {}, truth);
  RunOutcome outcome = EvaluateAndKeep(skeleton, input);
  AddCommonFigures("aligned.curves", "components", outcome.figures);
  AddJunctionFigures(outcome.figures);
  return outcome;
}

void AddSurfaceOfCurves(const SkeletonGraph& skeleton, const TubeOptions& options,
                        const SkeletonGraph& truth, Figures& figures) {
  const TriangleMesh mesh = ToTriangleMesh(BuildTubes(skeleton, options).surface);
  AddSurfaceFigures(mesh, EvaluateMesh(mesh, truth), truth, figures);
}

RunOutcome KeepSurfaceOfMethod(const RunInput& input, const TriangleMesh& surface,
                               const SkeletonGraph& truth) {
  const TriangleMesh mesh = PartAroundTruth(surface, truth).mesh;
  const Framing framing = FramingOf(truth);
  WritePng(input.folder / "mesh.png",
           DrawMesh(mesh, framing.view, framing.bounds, kPicture, kPicture, framing.scale));
  const Evaluation evaluation = EvaluateMesh(mesh, truth);
  RunOutcome outcome{!mesh.triangles.empty(), EvaluationFigures(evaluation)};
  AddCommonFigures("aligned.surface", "mesh.components", outcome.figures);
  AddSurfaceFigures(mesh, evaluation, truth, outcome.figures);
  return outcome;
}

}  // namespace curvefusion
