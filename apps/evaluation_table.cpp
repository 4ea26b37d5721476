#include "apps/evaluation_table.h"

#include <fmt/format.h>

#include <numbers>

namespace curvefusion {

namespace {

using Within = std::array<PrecisionRecall, kDistanceThresholds.size()>;

std::string Share(const std::optional<double>& share) {
  return share ? fmt::format("{:.3f}", *share) : "-";
}

std::string Millimetres(const std::optional<double>& metres) {
  return metres ? fmt::format("{:.2f} mm", *metres / kMillimetre) : "-";
}

std::string Percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f} %", 100 * *share) : "-";
}

std::string Scores(const PrecisionRecall& score) {
  return fmt::format("{:>5} {:>5} {:>5}", Share(score.precision), Share(score.recall),
                     Share(score.F()));
}

std::string Row(const std::string& name, const std::string& raw, const std::string& aligned) {
  return fmt::format("{:<26}{:>18}   {:>18}\n", name, raw, aligned);
}

std::string WithinRows(const std::string& name, const Within& raw, const Within& aligned) {
  std::string rows;
  for (size_t i = 0; i < raw.size(); ++i) {
    const double threshold_mm = kDistanceThresholds[i] / kMillimetre;
    rows += Row(fmt::format("{} within {:.0f} mm", name, threshold_mm), Scores(raw[i]),
                Scores(aligned[i]));
  }
  return rows;
}

std::string JunctionRows(const std::string& radius, const JunctionScores& raw,
                         const JunctionScores& aligned) {
  const auto counts = [](const JunctionScores& scores) {
    return fmt::format("{} of {} ({})", scores.matched, scores.truth, scores.found);
  };
  return Row("junctions within " + radius, Scores(raw.Score()), Scores(aligned.Score())) +
         Row("  matched of true (found)", counts(raw), counts(aligned)) +
         Row("  valence right", Share(raw.ValenceShare()), Share(aligned.ValenceShare()));
}

std::string PlacedRows(const PlacedScores& raw, const PlacedScores& aligned) {
  std::string rows = WithinRows("curves", raw.curves.within, aligned.curves.within);
  rows += Row("  mean distance", Millimetres(raw.curves.mean), Millimetres(aligned.curves.mean));
  rows += Row("  95th percentile", Millimetres(raw.curves.percentile_95),
              Millimetres(aligned.curves.percentile_95));
  rows += JunctionRows("10 mm", raw.junctions_10mm, aligned.junctions_10mm);
  rows += JunctionRows("5 mm", raw.junctions_5mm, aligned.junctions_5mm);
  rows += Row("paths (APLS)", Scores({raw.paths.result_to_truth, raw.paths.truth_to_result}),
              Scores({aligned.paths.result_to_truth, aligned.paths.truth_to_result}));
  rows += Row("diameter error", Millimetres(raw.diameters.mean_error),
              Millimetres(aligned.diameters.mean_error));
  rows += Row("  relative", Percent(raw.diameters.relative_error),
              Percent(aligned.diameters.relative_error));
  return rows;
}

std::string SurfaceRows(const SurfaceScores& raw, const SurfaceScores& aligned) {
  return WithinRows("surface", raw.within, aligned.within) +
         Row("  mean mesh to tubes", Millimetres(raw.mean_to_truth),
             Millimetres(aligned.mean_to_truth)) +
         Row("  mean tubes to mesh", Millimetres(raw.mean_to_mesh),
             Millimetres(aligned.mean_to_mesh));
}

std::string MeshRows(const Evaluation& evaluation) {
  const WatertightReport& mesh = *evaluation.mesh;
  const SampledVolume& truth = *evaluation.true_volume;
  const std::string ratio =
      evaluation.VolumeRatio()
          ? fmt::format("{:.3f} of the true tubes' (which is sampled to {:.1f} %)",
                        *evaluation.VolumeRatio(), 100 * truth.relative_error)
          : "- (the surface is not closed)";
  return fmt::format(
      "mesh around the truth     {} faces, {} parts, {} boundary edges, {} edges of more than two\n"
      "                          faces, {} self-intersections; {:.4f} m2, elsewhere {:.4f} m2\n"
      "mesh volume               {}\n",
      mesh.faces, mesh.components, mesh.boundary_edges, mesh.non_manifold_edges,
      mesh.self_intersections, mesh.area, evaluation.mesh_area_outside, ratio);
}

std::string TopologyRows(const Evaluation& evaluation) {
  const TopologyScores& topology = evaluation.topology;
  return fmt::format(
      "\n{:<26}{} (truth {})\n{:<26}{} (truth {})\n{:<26}{:.3f} m (truth {:.3f} m)\n", "components",
      topology.components, topology.true_components, "cycles", topology.cycles,
      topology.true_cycles, "length", evaluation.length, evaluation.true_length);
}

std::string AlignmentRow(const RigidTransform& T_truth_result) {
  const Eigen::AngleAxisd rotation(T_truth_result.rotation());
  return fmt::format("{:<26}{:.2f} mm, {:.3f} degrees\n", "alignment",
                     T_truth_result.translation().norm() / kMillimetre,
                     rotation.angle() * 180 / std::numbers::pi);
}

}  // namespace

std::string EvaluationTable(const Evaluation& evaluation) {
  const PlacedScores& raw = evaluation.raw;
  const PlacedScores& aligned = evaluation.aligned;
  std::string table = Row("", "raw", "aligned") + Row("", "  P     R     F  ", "  P     R     F  ");
  if (evaluation.has_curves) table += PlacedRows(raw, aligned);
  if (raw.surface && aligned.surface) table += SurfaceRows(*raw.surface, *aligned.surface);
  if (evaluation.has_curves) table += TopologyRows(evaluation);
  table += AlignmentRow(evaluation.T_truth_result);
  if (evaluation.mesh) table += MeshRows(evaluation);
  return table;
}

}  // namespace curvefusion
