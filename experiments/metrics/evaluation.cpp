#include "experiments/metrics/evaluation.h"

#include <utility>

#include "experiments/metrics/main_piece.h"
#include "experiments/metrics/truth_alignment.h"
#include "graph/validate.h"

namespace curvefusion {
namespace {

// A million samples at 1 mm; measured: 840 m against themselves take 3 s and 280 MB.
constexpr double kMaxLength = 1000;

AlignmentPoints PointsToAlign(const SkeletonGraph& graph) {
  SkeletonSamples samples = SampleSkeleton(graph);
  return {std::move(samples.positions), std::move(samples.tangents)};
}

PlacedScores Compare(const SkeletonGraph& result, const SkeletonGraph& truth) {
  const SkeletonSamples result_samples = SampleSkeleton(result);
  const SkeletonSamples truth_samples = SampleSkeleton(truth);
  PlacedScores scores;
  scores.curves = CompareCurves(result_samples, truth_samples);
  scores.junctions_10mm = MatchJunctions(result, truth, 10 * kMillimetre);
  scores.junctions_5mm = MatchJunctions(result, truth, 5 * kMillimetre);
  scores.tips_5mm = MatchTips(result, truth, 5 * kMillimetre);
  scores.paths = ComparePaths(result, truth);
  scores.diameters = CompareDiameters(result_samples, truth_samples);
  return scores;
}

// Whichever piece is the main one after the alignment.
MainPieceScores CompareMainPiece(const SkeletonGraph& result, const SkeletonGraph& truth,
                                 const Evaluation& evaluation) {
  if (evaluation.topology.components < 2) {
    return {evaluation.length, evaluation.topology.cycles, evaluation.raw, evaluation.aligned};
  }
  const RigidTransform& T_truth_result = evaluation.T_truth_result;
  const SkeletonGraph aligned = MainPiece(Transformed(result, T_truth_result), truth);
  const SkeletonGraph raw = Transformed(aligned, T_truth_result.inverse());
  return {aligned.TotalLength(), aligned.CycleRank(), Compare(raw, truth), Compare(aligned, truth)};
}

void CompareMesh(const TriangleMesh& mesh, const SkeletonGraph& truth, Evaluation& evaluation) {
  evaluation.raw.surface = CompareSurface(PartAroundTruth(mesh, truth).mesh, truth);
  const MeshPart part = PartAroundTruth(Transformed(mesh, evaluation.T_truth_result), truth);
  evaluation.aligned.surface = CompareSurface(part.mesh, truth);
  evaluation.mesh = ExamineMesh(part.mesh);
  evaluation.mesh_area_outside = part.area_outside;
  constexpr int kVolumeSamples = 100000;  // an error of about .1 %
  evaluation.true_volume = VolumeOfTubes(truth, kVolumeSamples);
}

}  // namespace

std::optional<double> Evaluation::VolumeRatio() const {
  if (!mesh || !true_volume || true_volume->volume <= 0) return std::nullopt;
  if (mesh->faces == 0 || mesh->boundary_edges > 0) return std::nullopt;
  return mesh->volume / true_volume->volume;
}

Evaluation Evaluate(const SkeletonGraph& result, const TriangleMesh* mesh,
                    const SkeletonGraph& truth) {
  RequireLength(result, kMaxLength, "the result");
  RequireLength(truth, kMaxLength, "the truth");
  Evaluation evaluation;
  evaluation.T_truth_result = AlignToTruth(PointsToAlign(result), PointsToAlign(truth));
  evaluation.raw = Compare(result, truth);
  evaluation.aligned = Compare(Transformed(result, evaluation.T_truth_result), truth);
  evaluation.topology = CompareTopology(result, truth);
  evaluation.length = result.TotalLength();
  evaluation.true_length = truth.TotalLength();
  evaluation.main_piece = CompareMainPiece(result, truth, evaluation);
  if (mesh != nullptr) CompareMesh(*mesh, truth, evaluation);
  return evaluation;
}

Evaluation EvaluateMesh(const TriangleMesh& mesh, const SkeletonGraph& truth) {
  Evaluation evaluation;
  evaluation.has_curves = false;
  evaluation.topology = CompareTopology({}, truth);
  evaluation.true_length = truth.TotalLength();
  evaluation.T_truth_result = AlignSurfaceToTruth(PartAroundTruth(mesh, truth).mesh, truth);
  CompareMesh(mesh, truth, evaluation);
  return evaluation;
}

}  // namespace curvefusion
