#include "apps/live/live_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/page_curves.h"
#include "apps/page_frames.h"
#include "apps/preview.h"
#include "kernel/angle.h"
#include "kernel/polyline.h"

namespace curvefusion {

namespace {

using Json = nlohmann::ordered_json;

// Of the curves: what a browser draws anew every second.
constexpr size_t kMaxPoints = 40'000;
// Hints are shown for so many curves, those of which most is unknown; more would cover them.
constexpr size_t kHints = 6;
// Metres: shorter curves are of the noise that the next frames clear up.
constexpr double kLeastHintLength = 0.03;

const char* PhaseName(LivePhase phase) {
  switch (phase) {
    case LivePhase::kWaiting:
      return "waiting";
    case LivePhase::kScanning:
      return "scanning";
    case LivePhase::kReconstructing:
      return "reconstructing";
    default:
      return "done";
  }
}

double Rounded(double value, double steps) { return std::round(value * steps) / steps; }

Json VectorJson(const Vec3& v, double steps) {
  return {Rounded(v.x(), steps), Rounded(v.y(), steps), Rounded(v.z(), steps)};
}

Json CameraJson(const LiveState& state) {
  if (!state.T_world_camera) return nullptr;
  return FrameJson({"", "", state.camera, state.T_world_camera->inverse()});
}

std::vector<double> Lengths(const SkeletonGraph& graph) {
  std::vector<double> lengths;
  for (const EdgeId id : graph.Edges()) lengths.push_back(Length(graph.edge(id).points));
  return lengths;
}

Json HintsJson(const LiveSnapshot& snapshot) {
  const std::vector<double> lengths = Lengths(snapshot.graph);
  std::vector<size_t> wanted;
  for (size_t i = 0; i < snapshot.curves.size(); ++i) {
    if (!snapshot.curves[i].look_from.isZero() && lengths[i] >= kLeastHintLength)
      wanted.push_back(i);
  }
  const auto unknown = [&](size_t i) { return lengths[i] * (1 - snapshot.curves[i].evidence); };
  std::stable_sort(wanted.begin(), wanted.end(),
                   [&](size_t a, size_t b) { return unknown(a) > unknown(b); });
  wanted.resize(std::min(wanted.size(), kHints));
  Json hints = Json::array();
  for (const size_t i : wanted) {
    hints.push_back({{"curve", i},
                     {"at", VectorJson(snapshot.curves[i].at / kMillimetre, 10)},
                     {"from", VectorJson(snapshot.curves[i].look_from, 1e4)}});
  }
  return hints;
}

Json PathJson(const Sequence& sample) {
  Json path = Json::array();
  for (const SequenceFrame& frame : sample.frames) {
    const Vec3 p = frame.T_world_camera.translation() / kMillimetre;
    for (int axis = 0; axis < 3; ++axis) path.push_back(Rounded(p[axis], 10));
  }
  return path;
}

Json FiguresJson(const LiveSnapshot& snapshot) {
  const std::vector<double> lengths = Lengths(snapshot.graph);
  Json figures = Json::array();
  for (size_t i = 0; i < snapshot.curves.size(); ++i) {
    const CurveSightings& seen = snapshot.curves[i];
    figures.push_back({{"evidence", Rounded(seen.evidence, 1e3)},
                       {"frames", seen.frames},
                       {"spread_degrees", Rounded(seen.spread / kDegree, 1)},
                       {"length_mm", Rounded(lengths[i] / kMillimetre, 1)},
                       {"free_ends", seen.free_ends}});
  }
  return figures;
}

// Milliseconds of all threads a used frame.
Json CostJson(const LiveState& state) {
  const auto per_frame = [&](double seconds) {
    return Rounded(1000 * seconds / std::max(1, state.used), 10);
  };
  const LiveCost& cost = state.cost;
  return {{"volume", per_frame(cost.volume)},
          {"learning", per_frame(cost.learning)},
          {"segmentation", per_frame(cost.segmentation)},
          {"registration", per_frame(cost.registration)},
          {"snapshots", per_frame(cost.snapshots)}};
}

}  // namespace

Json StateJson(const LiveState& state) {
  const SnapshotFigures& snapshot = state.snapshot;
  return {{"format", "curvefusion-live"},
          {"version", 1},
          {"phase", PhaseName(state.phase)},
          {"seconds", Rounded(state.seconds, 100)},
          {"frames",
           {{"arrived", state.arrived},
            {"used", state.used},
            {"dropped", state.dropped},
            {"lost", state.lost}}},
          {"frame_rate", Rounded(state.frame_rate, 10)},
          {"processor_ms_per_frame", CostJson(state)},
          {"volume_bytes", state.volume_bytes},
          {"snapshot",
           {{"number", snapshot.number},
            {"seconds_behind", Rounded(snapshot.seconds_behind, 100)},
            {"most_seconds_behind", Rounded(snapshot.most_behind, 100)},
            {"curves", snapshot.curves},
            {"free_ends", snapshot.free_ends},
            {"length", Rounded(snapshot.length, 1e3)}}},
          {"camera", CameraJson(state)}};
}

Json SightingsJson(const LiveSnapshot& snapshot) {
  Json curves = Json::array();
  for (const CurveSightings& seen : snapshot.curves) {
    curves.push_back(
        {{"frames", seen.frames},
         {"spread", Rounded(seen.spread, 1e3)},
         {"free_ends", seen.free_ends},
         {"evidence", Rounded(seen.evidence, 1e3)},
         {"at", VectorJson(seen.at, 1e4)},
         {"look_from", seen.look_from.isZero() ? Json() : VectorJson(seen.look_from, 1e4)}});
  }
  return curves;
}

Json CurvesJson(const LiveSnapshot& snapshot, int number, const Sequence& sample) {
  const SkeletonGraph none;
  const double tolerance = DrawingTolerance(snapshot.graph, none, kMaxPoints);
  const Mat3 axes = MeanCameraAxes(sample);
  return {{"number", number},
          {"curves", DrawnCurves(snapshot.graph, tolerance)},
          {"uncertain", DrawnCurves(none, tolerance)},
          {"figures", FiguresJson(snapshot)},
          {"hints", HintsJson(snapshot)},
          {"up", VectorJson(axes.row(1), 1e6)},
          {"towards_viewer", VectorJson(axes.row(2), 1e6)},
          {"camera_path", PathJson(sample)}};
}

}  // namespace curvefusion
