#include "fusion/silhouettes/silhouette_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace curvefusion {

namespace {

// Chosen: depth draws curves up to 6 mm beside their wires (docs/lab_notebook.md).
constexpr double kGrid = 0.0015;         // metres
constexpr double kMiddleRadius = 0.003;  // metres; about that of a wire
constexpr double kStep = 0.003;          // metres
constexpr double kCorridor = 0.006;      // metres beside the guide
constexpr double kMaxDetour = 1.3;       // of the guide's length

using Cell = std::array<int, 3>;

// The cells of a grid around a curve, looked at when they are asked for.
class Corridor {
 public:
  Corridor(const WireSilhouettes& silhouettes, const Polyline& guide, double min_share)
      : silhouettes_(silhouettes), guide_(guide), min_share_(min_share) {}

  Vec3 PositionOf(const Cell& cell) const {
    return guide_.front() + kGrid * Vec3(cell[0], cell[1], cell[2]);
  }

  Cell CellAt(const Vec3& p) const {
    const Vec3 at = (p - guide_.front()) / kGrid;
    return {static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())),
            static_cast<int>(std::lround(at.z()))};
  }

  /// What a step to a cell costs over its length: more beside the guide, infinite beside the wire.
  double CostOf(const Cell& cell) {
    const auto [known, is_new] = costs_.try_emplace(cell, std::numeric_limits<double>::infinity());
    if (is_new) {
      const Vec3 p = PositionOf(cell);
      const double share_of_radius = Project(guide_, p).distance / kCorridor;
      if (share_of_radius <= 1 && silhouettes_.Share(p) >= min_share_)
        known->second = 1 + share_of_radius * share_of_radius;
    }
    return known->second;
  }

  bool IsWire(const Cell& cell) { return std::isfinite(CostOf(cell)); }

 private:
  const WireSilhouettes& silhouettes_;
  const Polyline& guide_;
  double min_share_;
  std::map<Cell, double> costs_;
};

template <class Visit>
void VisitAround(const Cell& cell, int reach, const Visit& visit) {
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z)
        visit(Cell{cell[0] + x, cell[1] + y, cell[2] + z},
              std::sqrt(static_cast<double>(x * x + y * y + z * z)));
}

// Cells from the front of the guide to its back, both included; empty where no path leads there
// (A* search, Hart, Nilsson and Raphael 1968).
std::vector<Cell> ShortestPath(Corridor& corridor, const Polyline& guide) {
  const Cell goal = corridor.CellAt(guide.back());
  const auto remaining = [&goal](const Cell& cell) {
    return std::hypot(cell[0] - goal[0], cell[1] - goal[1], cell[2] - goal[2]);
  };
  using Entry = std::tuple<double, double, Cell>;  // bound, length so far
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::map<Cell, std::pair<double, Cell>> reached;
  const Cell start{};
  open.emplace(remaining(start), 0, start);
  reached[start] = {0, start};
  while (!open.empty()) {
    const auto [bound, length, cell] = open.top();
    open.pop();
    if (cell == goal) break;
    if (length > reached[cell].first) continue;
    VisitAround(cell, 1, [&, length = length, cell = cell](const Cell& next, double step) {
      if (step == 0) return;
      const double to_next = length + step * (next == goal ? 1 : corridor.CostOf(next));
      const auto known = reached.find(next);
      if (!std::isfinite(to_next) || (known != reached.end() && known->second.first <= to_next))
        return;
      reached[next] = {to_next, cell};
      open.emplace(to_next + remaining(next), to_next, next);
    });
  }
  if (reached.count(goal) == 0) return {};
  std::vector<Cell> cells{goal};
  while (cells.back() != start) cells.push_back(reached[cells.back()].second);
  std::reverse(cells.begin(), cells.end());
  return cells;
}

// The middle of the wire around a place.
Vec3 MiddleAround(Corridor& corridor, const Vec3& p) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  VisitAround(corridor.CellAt(p), static_cast<int>(kMiddleRadius / kGrid),
              [&](const Cell& cell, double distance) {
                if (distance * kGrid > kMiddleRadius || !corridor.IsWire(cell)) return;
                sum += corridor.PositionOf(cell);
                ++count;
              });
  return count > 0 ? Vec3(sum / count) : p;
}

}  // namespace

std::optional<Polyline> PathThroughSilhouettes(const WireSilhouettes& silhouettes,
                                               const Polyline& guide, double min_share) {
  Corridor cells(silhouettes, guide, min_share);
  Polyline path{guide.front()};
  for (const Cell& cell : ShortestPath(cells, guide)) path.push_back(cells.PositionOf(cell));
  if (path.size() < 2) return std::nullopt;
  path.back() = guide.back();
  path.erase(path.begin() + 1);
  for (int round = 0; round < 3; ++round) {
    for (size_t i = 1; i + 1 < path.size(); ++i) path[i] = MiddleAround(cells, path[i]);
    Polyline next = path;
    for (size_t i = 1; i + 1 < path.size(); ++i)
      next[i] = 0.25 * path[i - 1] + 0.5 * path[i] + 0.25 * path[i + 1];
    path = std::move(next);
  }
  const double length = Length(path);
  // Ends may lie a wire beside where they should.
  if (length <= 0 || length > kMaxDetour * Length(guide) + kCorridor) return std::nullopt;
  return Resample(path, kStep);
}

}  // namespace curvefusion
