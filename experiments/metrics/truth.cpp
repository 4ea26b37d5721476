#include "experiments/metrics/truth.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/simulation/object_truth.h"
#include "graph/io/graph_io.h"
#include "kernel/error.h"
#include "kernel/json_input.h"
#include "kernel/text_input.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxLength = 1000;  // metres; curves are sampled every millimetre

fs::path TruthFile(const fs::path& path) {
  if (!fs::is_directory(path)) return path;
  for (const char* name : {"skeleton.json", "curves.json"}) {
    if (fs::exists(path / name)) return path / name;
  }
  throw Error(ErrorKind::kBadInput,
              path.string() + ": holds neither skeleton.json nor curves.json; give the truth/ " +
                  "folder of a simulated scan");
}

// Throws nlohmann's exceptions for what is not there or of another type.
WireCurve CurveOf(const nlohmann::json& json) {
  WireCurve curve;
  curve.diameter = json.at("diameter").get<double>();
  for (const nlohmann::json& point : json.at("points")) {
    curve.points.emplace_back(point.at(0).get<double>(), point.at(1).get<double>(),
                              point.at(2).get<double>());
  }
  if (json.contains("diameters")) json.at("diameters").get_to(curve.diameters);
  const bool closed = json.at("closed").get<bool>();
  if (closed && !curve.points.empty() && curve.points.front() != curve.points.back()) {
    curve.points.push_back(curve.points.front());
    if (!curve.diameters.empty()) curve.diameters.push_back(curve.diameters.front());
  }
  return curve;
}

SkeletonGraph TruthFromCurves(const std::string& text, const std::string& source) {
  WireObject object{source, {}};
  try {
    for (const nlohmann::json& json : ParseJson(text, source)) {
      object.curves.push_back(CurveOf(json));
    }
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorKind::kBadInput, source + ": is no list of curves: " + error.what());
  }
  double total_length = 0;
  for (size_t i = 0; i < object.curves.size(); ++i) {
    const WireCurve& curve = object.curves[i];
    const double length = Length(curve.points);
    total_length += length;
    const bool tapers = !curve.diameters.empty();
    if (tapers && (curve.diameters.size() != curve.points.size() ||
                   !(std::ranges::min(curve.diameters) > 0))) {
      throw Error(ErrorKind::kBadInput, source + ": curve " + std::to_string(i) +
                                            " needs one positive diameter a point, or none");
    }
    if (!(curve.diameter > 0 && length > 0)) {
      throw Error(ErrorKind::kBadInput,
                  source + ": curve " + std::to_string(i) + " has no length or no diameter");
    }
    if (!(total_length <= kMaxLength)) {
      throw Error(ErrorKind::kBadInput, source + ": has more than 1000 m of curve by curve " +
                                            std::to_string(i) + "; coordinates must be in metres");
    }
  }
  return TruthSkeleton(object);
}

}  // namespace

SkeletonGraph ReadTruth(const fs::path& path) {
  const fs::path file = TruthFile(path);
  const std::string text = ReadFile(file);
  const size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '[') {
    return TruthFromCurves(text, file.string());
  }
  SkeletonGraph truth = SkeletonFromJson(text, file.string());
  RequireRadii(truth, file.string());
  return truth;
}

void RequireRadii(const SkeletonGraph& truth, const std::string& source) {
  for (const EdgeId edge : truth.Edges()) {
    if (!truth.edge(edge).radii.empty()) continue;
    throw Error(ErrorKind::kBadInput, source + ": edge " + std::to_string(edge) +
                                          " has no radius; a truth needs them all");
  }
}

}  // namespace curvefusion
