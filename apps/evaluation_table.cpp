#include "apps/evaluation_table.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "kernel/angle.h"

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

std::string Metres(double metres) { return fmt::format("{:.3f} m", metres); }

// Cells of the columns raw, aligned and main piece.
std::string Row(const std::string& name, const std::vector<std::string>& cells) {
  std::string row = fmt::format("{:<23}", name);
  for (const std::string& cell : cells) row += fmt::format("  {:>17}", cell);
  return row + "\n";
}

// The scores of each column, and a row with a cell of each.
class Columns {
 public:
  explicit Columns(std::vector<const PlacedScores*> columns) : columns_(std::move(columns)) {}

  template <class Cell>
  std::string Row(const std::string& name, const Cell& cell) const {
    std::vector<std::string> cells;
    for (const PlacedScores* scores : columns_) cells.push_back(cell(*scores));
    return curvefusion::Row(name, cells);
  }

 private:
  std::vector<const PlacedScores*> columns_;
};

template <class WithinOf>
std::string WithinRows(const std::string& name, const Columns& columns, const WithinOf& within) {
  std::string rows;
  for (size_t i = 0; i < kDistanceThresholds.size(); ++i) {
    const double threshold_mm = kDistanceThresholds[i] / kMillimetre;
    rows += columns.Row(fmt::format("{} within {:.0f} mm", name, threshold_mm),
                        [&](const PlacedScores& s) { return Scores(within(s)[i]); });
  }
  return rows;
}

std::string Counts(int matched, int truth, int found) {
  return fmt::format("{} of {} ({})", matched, truth, found);
}

std::string JunctionRows(const std::string& radius, JunctionScores PlacedScores::*junctions,
                         const Columns& columns) {
  return columns.Row("junctions within " + radius, [&](const PlacedScores& s) {
    return Scores((s.*junctions).Score());
  }) + columns.Row("  of true ones (found)", [&](const PlacedScores& s) {
    const JunctionScores& scores = s.*junctions;
    return Counts(scores.matched, scores.truth, scores.found);
  }) + columns.Row("  valence right", [&](const PlacedScores& s) {
    return Share((s.*junctions).ValenceShare());
  });
}

std::string TipRows(const Columns& columns) {
  return columns.Row("tips within 5 mm", [](const PlacedScores& s) {
    return Scores(s.tips_5mm.Score());
  }) + columns.Row("  of true ones (found)", [](const PlacedScores& s) {
    return Counts(s.tips_5mm.matched, s.tips_5mm.truth, s.tips_5mm.found);
  });
}

std::string CurveRows(const Columns& columns) {
  using S = const PlacedScores&;
  return WithinRows("curves", columns, [](S s) -> const Within& { return s.curves.within; }) +
         columns.Row("  mean distance", [](S s) { return Millimetres(s.curves.mean); }) +
         columns.Row("  95th percentile", [](S s) { return Millimetres(s.curves.percentile_95); }) +
         columns.Row("  false (over 10 mm)", [](S s) { return Metres(s.curves.false_length); }) +
         columns.Row("  missing", [](S s) { return Metres(s.curves.missing_length); });
}

std::string PlacedRows(const Columns& columns) {
  using S = const PlacedScores&;
  return CurveRows(columns) + JunctionRows("10 mm", &PlacedScores::junctions_10mm, columns) +
         JunctionRows("5 mm", &PlacedScores::junctions_5mm, columns) + TipRows(columns) +
         columns.Row("paths (APLS)",
                     [](S s) {
                       return Scores({s.paths.result_to_truth, s.paths.truth_to_result});
                     }) +
         columns.Row("diameter error", [](S s) { return Millimetres(s.diameters.mean_error); }) +
         columns.Row("  relative", [](S s) { return Percent(s.diameters.relative_error); });
}

std::string SurfaceRows(const Columns& columns) {
  using S = const PlacedScores&;
  return WithinRows("surface", columns, [](S s) -> const Within& { return s.surface->within; }) +
         columns.Row("  mean mesh to tubes",
                     [](S s) { return Millimetres(s.surface->mean_to_truth); }) +
         columns.Row("  mean tubes to mesh",
                     [](S s) { return Millimetres(s.surface->mean_to_mesh); });
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
      "mesh around the truth    {} faces, {} parts, {} boundary edges, {} edges of more than two\n"
      "                         faces, {} self-intersections; {:.4f} m2, elsewhere {:.4f} m2\n"
      "mesh volume              {}\n",
      mesh.faces, mesh.components, mesh.boundary_edges, mesh.non_manifold_edges,
      mesh.self_intersections, mesh.area, evaluation.mesh_area_outside, ratio);
}

std::string TopologyRows(const Evaluation& evaluation) {
  const TopologyScores& topology = evaluation.topology;
  const MainPieceScores& piece = evaluation.main_piece;
  const std::string header = Row("", {"truth", "result", "main piece"});
  const std::string components = Row("components", {std::to_string(topology.true_components),
                                                    std::to_string(topology.components), "-"});
  const std::string cycles =
      Row("cycles", {std::to_string(topology.true_cycles), std::to_string(topology.cycles),
                     std::to_string(piece.cycles)});
  const std::string length = Row(
      "length", {Metres(evaluation.true_length), Metres(evaluation.length), Metres(piece.length)});
  return fmt::format("\n{}{}{}{}", header, components, cycles, length);
}

std::string AlignmentRow(const RigidTransform& T_truth_result) {
  const Eigen::AngleAxisd rotation(T_truth_result.rotation());
  return fmt::format("\n{:<25}{:.2f} mm, {:.3f} degrees\n", "alignment",
                     T_truth_result.translation().norm() / kMillimetre, rotation.angle() / kDegree);
}

}  // namespace

std::string EvaluationTable(const Evaluation& evaluation) {
  std::vector<std::string> names = {"raw", "aligned"};
  if (evaluation.has_curves) names.emplace_back("main piece");
  std::string table =
      Row("", names) + Row("", std::vector<std::string>(names.size(), "P     R     F  "));
  if (evaluation.has_curves) {
    table +=
        PlacedRows(Columns({&evaluation.raw, &evaluation.aligned, &evaluation.main_piece.aligned}));
  }
  if (evaluation.raw.surface && evaluation.aligned.surface) {
    table += SurfaceRows(Columns({&evaluation.raw, &evaluation.aligned}));
  }
  if (evaluation.has_curves) table += TopologyRows(evaluation);
  table += AlignmentRow(evaluation.T_truth_result);
  if (evaluation.mesh) table += MeshRows(evaluation);
  return table;
}

}  // namespace curvefusion
