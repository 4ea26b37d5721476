#include "experiments/simulation/families/wire_assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/spatial_search.h"

namespace curvefusion {
namespace {

constexpr double kSamePoint = 1e-3;    // mm; rounding of two ways to compute a point is 1e-12
constexpr double kNearVertex = 0.5;    // mm; segments shorter than that would be of no use
constexpr double kLongestSegment = 8;  // mm; of bent wires

// What is the arc length at a share, and between which vertices?
struct Place {
  size_t before = 0;
  double share = 0;  // of the segment
};

Place PlaceAt(const Polyline& points, double arc_length) {
  const std::vector<double> cumulative = CumulativeLength(points);
  const auto after = std::upper_bound(cumulative.begin(), cumulative.end() - 1, arc_length);
  const size_t i = std::max<std::ptrdiff_t>(after - cumulative.begin(), 1) - 1;
  const double length = cumulative[i + 1] - cumulative[i];
  return {i, length > 0 ? std::clamp((arc_length - cumulative[i]) / length, 0.0, 1.0) : 0.0};
}

Vec3 InsertedVertex(WireCurve& wire, double arc_length) {
  const Place place = PlaceAt(wire.points, arc_length);
  const Vec3& a = wire.points[place.before];
  const Vec3& b = wire.points[place.before + 1];
  const Vec3 p = (1 - place.share) * a + place.share * b;
  if ((p - a).norm() < kNearVertex) return a;
  if ((p - b).norm() < kNearVertex) return b;
  if (!wire.diameters.empty()) {
    const double diameter = (1 - place.share) * wire.diameters[place.before] +
                            place.share * wire.diameters[place.before + 1];
    wire.diameters.insert(wire.diameters.begin() + place.before + 1, diameter);
  }
  wire.points.insert(wire.points.begin() + place.before + 1, p);
  return p;
}

WireCurve Subdivided(const WireCurve& wire) {
  WireCurve fine{{wire.points.front()}, wire.diameter, {}};
  if (!wire.diameters.empty()) fine.diameters = {wire.diameters.front()};
  for (size_t i = 0; i + 1 < wire.points.size(); ++i) {
    const Vec3& a = wire.points[i];
    const Vec3& b = wire.points[i + 1];
    const int parts = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kLongestSegment)));
    for (int k = 1; k <= parts; ++k) {
      const double share = static_cast<double>(k) / parts;
      fine.points.push_back(k == parts ? b : Vec3((1 - share) * a + share * b));
      if (wire.diameters.empty()) continue;
      fine.diameters.push_back((1 - share) * wire.diameters[i] + share * wire.diameters[i + 1]);
    }
  }
  return fine;
}

// Points that are to be one get the position of the first of them.
void UnifySharedPoints(std::vector<WireCurve>& wires) {
  std::vector<Vec3> positions;
  for (const WireCurve& wire : wires) {
    positions.insert(positions.end(), wire.points.begin(), wire.points.end());
  }
  if (positions.empty()) return;
  const PointIndex index(positions);
  std::vector<int> found;
  size_t i = 0;
  for (WireCurve& wire : wires) {
    for (Vec3& p : wire.points) {
      index.WithinRadius(positions[i++], kSamePoint, found);
      p = positions[*std::ranges::min_element(found)];
    }
  }
}

}  // namespace

int WireAssembly::Add(const Polyline& points, double diameter) {
  wires_.push_back({points, diameter, {}});
  return static_cast<int>(wires_.size()) - 1;
}

int WireAssembly::AddTapered(const Polyline& points, double first_diameter, double last_diameter) {
  WireCurve wire{points, (first_diameter + last_diameter) / 2, {}};
  const std::vector<double> cumulative = CumulativeLength(points);
  for (const double at : cumulative) {
    const double share = at / cumulative.back();
    wire.diameters.push_back((1 - share) * first_diameter + share * last_diameter);
  }
  wires_.push_back(std::move(wire));
  return static_cast<int>(wires_.size()) - 1;
}

int WireAssembly::AddLoop(const Polyline& points, double diameter) {
  const int wire = Add(points, diameter);
  wires_[wire].points.push_back(points.front());
  return wire;
}

void WireAssembly::Append(const WireAssembly& other, const Vec3& shift) {
  for (WireCurve wire : other.wires_) {
    for (Vec3& p : wire.points) p += shift;
    wires_.push_back(std::move(wire));
  }
}

Vec3 WireAssembly::VertexNear(int wire, const Vec3& near) {
  return InsertedVertex(wires_[wire], Project(wires_[wire].points, near).arc_length);
}

Vec3 WireAssembly::VertexAt(int wire, double share) {
  return InsertedVertex(wires_[wire], share * LengthOf(wire));
}

Vec3 WireAssembly::DirectionAt(int wire, double share) const {
  const Polyline& points = wires_[wire].points;
  const Place place = PlaceAt(points, share * LengthOf(wire));
  return (points[place.before + 1] - points[place.before]).normalized();
}

double WireAssembly::DiameterAt(int wire, double share) const {
  const WireCurve& curve = wires_[wire];
  const Place place = PlaceAt(curve.points, share * LengthOf(wire));
  return (1 - place.share) * curve.DiameterAt(place.before) +
         place.share * curve.DiameterAt(place.before + 1);
}

double WireAssembly::LengthOf(int wire) const { return Length(wires_[wire].points); }

double WireAssembly::Clearance(const Polyline& points, double diameter, double start,
                               int except) const {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<double> cumulative = CumulativeLength(points);
  for (size_t k = 0; k < wires_.size(); ++k) {
    if (static_cast<int>(k) == except) continue;
    const WireCurve& wire = wires_[k];
    const double radius =
        (wire.diameters.empty() ? wire.diameter : std::ranges::max(wire.diameters)) / 2;
    for (size_t i = 0; i < points.size(); ++i) {
      if (cumulative[i] < start) continue;
      const double gap = Project(wire.points, points[i]).distance - radius - diameter / 2;
      least = std::min(least, gap);
    }
  }
  return least;
}

void WireAssembly::Warp(const std::function<Vec3(const Vec3&)>& map) {
  for (WireCurve& wire : wires_) {
    wire = Subdivided(wire);
    for (Vec3& p : wire.points) p = map(p);
  }
}

Eigen::AlignedBox3d WireAssembly::Bounds() const {
  Eigen::AlignedBox3d bounds;
  for (const WireCurve& wire : wires_) {
    for (const Vec3& p : wire.points) bounds.extend(p);
  }
  return bounds;
}

WireObject WireAssembly::Finished(const std::string& name) const {
  WireObject object{name, wires_, WeldRule::kSharedPoints};
  UnifySharedPoints(object.curves);
  for (WireCurve& wire : object.curves) {
    wire.diameter *= kMillimetre;
    for (double& diameter : wire.diameters) diameter *= kMillimetre;
    for (Vec3& p : wire.points) p *= kMillimetre;
  }
  return object;
}

}  // namespace curvefusion
