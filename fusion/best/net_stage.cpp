#include "fusion/best/net_stage.h"

#include <utility>
#include <vector>

#include "kernel/point_grid.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kDiameterError = 0.1;  // relative; chosen: 0 to .28 in docs/nets.md#figures

}  // namespace

NetCurves TraceNets(const Nets& nets, const StageReporter& reporter, Reconstruction& result) {
  if (nets.empty()) return {};
  const char* stage = "nets";
  const StageLog::Timer timer = reporter.Begin(stage);
  const double before = result.skeleton.TotalLength();
  NetCurves curves =
      AddNetCurves(result.sequence, nets, result.radii.unmeasured_radius, result.skeleton);
  if (before > 0) result.trust.wire_length *= 1 - curves.replaced / before;
  result.trust.wire_length += curves.length;
  reporter.log.Count(stage, "wires, m", curves.length);
  reporter.log.Count(stage, "replaced, m", curves.replaced);
  reporter.observer.OnGraph("with_nets", result.skeleton);
  return curves;
}

void MeasureNetWires(const NetCurves& nets, Reconstruction& result) {
  std::vector<Vec3> places;
  std::vector<double> diameters, all;
  for (const NetWire& wire : nets.wires) {
    if (wire.diameter == 0) continue;
    places.insert(places.end(), wire.points.begin(), wire.points.end());
    diameters.insert(diameters.end(), wire.points.size(), wire.diameter);
  }
  if (places.empty()) return;
  const PointGrid grid(places, kSameWire);
  for (EdgeRadius& edge : result.radii.edges) {
    if (edge.radius > 0) continue;
    std::vector<double> near;
    const Polyline& points = result.skeleton.edge(edge.edge).points;
    for (const Vec3& p : points) {
      const int place = grid.Nearest(p, kSameWire);
      if (place >= 0) near.push_back(diameters[place]);
    }
    if (2 * near.size() < points.size()) continue;
    edge.radius = 0.5 * Median(std::move(near));
    edge.error = kDiameterError * edge.radius;
    all.push_back(edge.radius);
  }
  if (result.radii.global_radius == 0 && !all.empty())
    result.radii.global_radius = result.radii.unmeasured_radius = Median(std::move(all));
  AssignRadii(result.radii, result.skeleton);
}

}  // namespace curvefusion
