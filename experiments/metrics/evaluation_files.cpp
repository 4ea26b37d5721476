#include "experiments/metrics/evaluation_files.h"

#include <iterator>
#include <nlohmann/json.hpp>

#include "experiments/csv_cell.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {
namespace {

using Json = nlohmann::ordered_json;

Json Value(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json Millimetres(const std::optional<double>& metres) {
  return metres ? Json(*metres / kMillimetre) : Json(nullptr);
}

Json WithinJson(const std::array<PrecisionRecall, kDistanceThresholds.size()>& within) {
  static constexpr const char* kKeys[] = {"1mm", "2mm", "5mm", "10mm"};
  static_assert(std::size(kKeys) == kDistanceThresholds.size());
  Json json;
  for (size_t i = 0; i < within.size(); ++i) {
    json[kKeys[i]] = {{"precision", Value(within[i].precision)},
                      {"recall", Value(within[i].recall)},
                      {"f", Value(within[i].F())}};
  }
  return json;
}

Json CurvesJson(const DistanceScores& scores) {
  Json json = WithinJson(scores.within);
  json["mean_mm"] = Millimetres(scores.mean);
  json["percentile_95_mm"] = Millimetres(scores.percentile_95);
  json["false_length"] = scores.false_length;
  json["missing_length"] = scores.missing_length;
  return json;
}

Json JunctionsJson(const JunctionScores& scores) {
  return {{"truth", scores.truth},
          {"found", scores.found},
          {"matched", scores.matched},
          {"valence_right", scores.valence_right},
          {"precision", Value(scores.Score().precision)},
          {"recall", Value(scores.Score().recall)},
          {"valence_share", Value(scores.ValenceShare())}};
}

Json TipsJson(const TipScores& scores) {
  return {{"truth", scores.truth},
          {"found", scores.found},
          {"matched", scores.matched},
          {"precision", Value(scores.Score().precision)},
          {"recall", Value(scores.Score().recall)}};
}

Json PathsJson(const AplsScores& scores) {
  return {{"truth_to_result", Value(scores.truth_to_result)},
          {"result_to_truth", Value(scores.result_to_truth)},
          {"both", Value(scores.Apls())}};
}

Json DiametersJson(const DiameterScores& scores) {
  Json edges = Json::array();
  for (const EdgeDiameter& edge : scores.edges) {
    edges.push_back({{"edge", edge.edge},
                     {"length_mm", edge.length / kMillimetre},
                     {"diameter_mm", edge.diameter / kMillimetre},
                     {"true_diameter_mm", edge.true_diameter / kMillimetre}});
  }
  return {{"mean_error_mm", Millimetres(scores.mean_error)},
          {"relative_error", Value(scores.relative_error)},
          {"compared_share", scores.compared_share},
          {"per_edge", edges}};
}

Json SurfaceJson(const SurfaceScores& scores) {
  Json json = WithinJson(scores.within);
  json["mean_to_truth_mm"] = Millimetres(scores.mean_to_truth);
  json["mean_to_mesh_mm"] = Millimetres(scores.mean_to_mesh);
  return json;
}

// The same keys without a value.
Json Emptied(Json json) {
  if (json.is_array()) return Json::array();
  if (!json.is_object()) return nullptr;
  for (Json& value : json) value = Emptied(value);
  return json;
}

Json PlacedCurvesJson(const PlacedScores& scores) {
  return {{"curves", CurvesJson(scores.curves)},
          {"junctions_10mm", JunctionsJson(scores.junctions_10mm)},
          {"junctions_5mm", JunctionsJson(scores.junctions_5mm)},
          {"tips_5mm", TipsJson(scores.tips_5mm)},
          {"apls", PathsJson(scores.paths)},
          {"diameter", DiametersJson(scores.diameters)}};
}

Json PlacedJson(const PlacedScores& scores) {
  Json json = PlacedCurvesJson(scores);
  json["surface"] = SurfaceJson(scores.surface.value_or(SurfaceScores{}));
  return json;
}

Json MainPieceJson(const MainPieceScores& scores) {
  return {{"length", scores.length},
          {"cycles", scores.cycles},
          {"raw", PlacedCurvesJson(scores.raw)},
          {"aligned", PlacedCurvesJson(scores.aligned)}};
}

Json MeshJson(const Evaluation& evaluation) {
  const WatertightReport mesh = evaluation.mesh.value_or(WatertightReport{});
  Json json = {
      {"faces", mesh.faces},
      {"components", mesh.components},
      {"boundary_edges", mesh.boundary_edges},
      {"non_manifold_edges", mesh.non_manifold_edges},
      {"self_intersections", mesh.self_intersections},
      {"watertight", mesh.IsWatertight() ? 1 : 0},
      {"volume", mesh.volume},
      {"volume_ratio", Value(evaluation.VolumeRatio())},
      {"true_volume", evaluation.true_volume.value_or(SampledVolume{}).volume},
      {"true_volume_error", evaluation.true_volume.value_or(SampledVolume{}).relative_error},
      {"area", mesh.area},
      {"area_outside", evaluation.mesh_area_outside}};
  return evaluation.mesh ? json : Emptied(json);
}

Json AlignmentJson(const RigidTransform& T_truth_result) {
  const Eigen::AngleAxisd rotation(T_truth_result.rotation());
  return {{"translation_mm", T_truth_result.translation().norm() / kMillimetre},
          {"rotation", rotation.angle()}};
}

// A bare mesh has no curves to give figures of.
void EmptyCurves(Json& json) {
  for (const char* key : {"length", "components", "cycles"}) json[key] = nullptr;
  json["main_piece"] = Emptied(json["main_piece"]);
  for (const char* place : {"raw", "aligned"}) {
    for (auto& [key, value] : json[place].items()) {
      if (key != "surface") value = Emptied(value);
    }
  }
}

Json EvaluationJson(const EvaluationLabels& labels, const Evaluation& evaluation) {
  const TopologyScores& topology = evaluation.topology;
  Json json = {{"result", labels.result},
               {"truth", labels.truth},
               {"length", evaluation.length},
               {"true_length", evaluation.true_length},
               {"components", topology.components},
               {"true_components", topology.true_components},
               {"cycles", topology.cycles},
               {"true_cycles", topology.true_cycles},
               {"alignment", AlignmentJson(evaluation.T_truth_result)},
               {"raw", PlacedJson(evaluation.raw)},
               {"aligned", PlacedJson(evaluation.aligned)},
               {"main_piece", MainPieceJson(evaluation.main_piece)},
               {"mesh", MeshJson(evaluation)}};
  if (!evaluation.has_curves) EmptyCurves(json);
  return json;
}

struct CsvRow {
  std::string header;
  std::string values;
};

// Calls visit(name, value) for every value but those in arrays; names are keys joined by dots.
template <class Visit>
void VisitValues(const Json& json, const std::string& name, const Visit& visit) {
  if (json.is_array()) return;
  if (!json.is_object()) {
    visit(name, json);
    return;
  }
  for (const auto& [key, value] : json.items()) {
    VisitValues(value, name.empty() ? key : name + "." + key, visit);
  }
}

void AppendCell(const std::string& name, const Json& value, CsvRow& row) {
  const std::string separator = row.header.empty() ? "" : ",";
  row.header += separator + name;
  row.values += separator;
  if (value.is_string()) {
    row.values += CsvCell(value.get<std::string>());
  } else if (!value.is_null()) {
    row.values += value.dump();
  }
}

std::string ReadIfThere(const std::filesystem::path& path) {
  return std::filesystem::exists(path) ? ReadFile(path) : "";
}

}  // namespace

std::string EvaluationText(const EvaluationLabels& labels, const Evaluation& evaluation) {
  // Names of files need not be UTF-8.
  return EvaluationJson(labels, evaluation).dump(1, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

void WriteEvaluation(const std::filesystem::path& path, const EvaluationLabels& labels,
                     const Evaluation& evaluation) {
  const std::string text = EvaluationText(labels, evaluation);
  WriteBytesAtomically(path, text);
}

void AppendEvaluation(const std::filesystem::path& path, const EvaluationLabels& labels,
                      const Evaluation& evaluation) {
  CsvRow row;
  VisitValues(EvaluationJson(labels, evaluation), "",
              [&](const std::string& name, const Json& value) { AppendCell(name, value, row); });
  std::string text = ReadIfThere(path);
  if (text.empty()) text = row.header + "\n";
  if (text.substr(0, text.find('\n')) != row.header) {
    throw Error(ErrorKind::kBadInput, path.string() + ": has other columns than an evaluation; " +
                                          "name a new file or one that evaluate has written");
  }
  if (text.back() != '\n') text += '\n';
  text += row.values + "\n";
  WriteBytesAtomically(path, text);
}

std::map<std::string, double> EvaluationFigures(const Evaluation& evaluation) {
  std::map<std::string, double> figures;
  VisitValues(EvaluationJson({}, evaluation), "", [&](const std::string& name, const Json& value) {
    if (value.is_number()) figures[name] = value.get<double>();
  });
  return figures;
}

}  // namespace curvefusion
