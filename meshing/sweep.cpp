#include "meshing/sweep.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "meshing/hashed_number.h"

namespace curvefusion {

namespace {

constexpr int kDomeRings = 4;  // of 16 sides: steps of 22.5 degrees in both directions
// Of the radius: a dome of so few rings has the volume of a hemisphere when its pole lies so high
// and its inner rings are so wide.
constexpr double kDomeHeight = 1.0214;
constexpr double kDomeWidth = 1.0125;
constexpr double kTaperLength = 0.35;  // of the radius
constexpr double kTaperPart = 0.3;     // at most, of the segment

int PreviousPoint(const TubePath& path, int i) {
  const int n = static_cast<int>(path.axis.points.size());
  return path.closed ? (i + n - 1) % n : std::max(i - 1, 0);
}

int NextPoint(const TubePath& path, int i) {
  const int n = static_cast<int>(path.axis.points.size());
  return path.closed ? (i + 1) % n : std::min(i + 1, n - 1);
}

Vec3 DirectionBefore(const TubePath& path, int i) {
  const Polyline& points = path.axis.points;
  const int before = PreviousPoint(path, i);
  return before == i ? (points[NextPoint(path, i)] - points[i]).normalized()
                     : (points[i] - points[before]).normalized();
}

Vec3 DirectionAfter(const TubePath& path, int i) {
  const Polyline& points = path.axis.points;
  const int after = NextPoint(path, i);
  return after == i ? DirectionBefore(path, i) : Vec3((points[after] - points[i]).normalized());
}

Vec3 Tangent(const TubePath& path, int i) {
  return (DirectionBefore(path, i) + DirectionAfter(path, i)).normalized();
}

Vec3 Reflected(const Vec3& v, const Vec3& across) {
  return v - 2 / across.squaredNorm() * across.dot(v) * across;
}

// Carries a normal from point i to the next by two reflections.
Vec3 TransportedNormal(const TubePath& path, int i, const Vec3& normal) {
  const int next = NextPoint(path, i);
  const Vec3 step = path.axis.points[next] - path.axis.points[i];
  const Vec3 reflected_normal = Reflected(normal, step);
  const Vec3 reflected_tangent = Reflected(Tangent(path, i), step);
  const Vec3 second = Tangent(path, next) - reflected_tangent;
  const Vec3 carried =
      second.squaredNorm() > 0 ? Reflected(reflected_normal, second) : reflected_normal;
  const Vec3 tangent = Tangent(path, next);
  return (carried - carried.dot(tangent) * tangent).normalized();
}

// Radius of the corners of a regular polygon that has the area of the unit circle.
double CornerRadius(int sides) {
  const double angle = 2 * std::numbers::pi / sides;
  return std::sqrt(angle / std::sin(angle));
}

// A plane with its axes, in which rings are drawn.
struct RingFrame {
  Vec3 centre, normal, binormal;
  Vec3 mitre_direction = Vec3::Zero();
  double mitre_stretch = 0;
};

RingFrame FrameAt(const TubePath& path, int i, const Vec3& normal) {
  const Vec3 before = DirectionBefore(path, i);
  const Vec3 after = DirectionAfter(path, i);
  RingFrame frame{path.axis.points[i], normal, Tangent(path, i).cross(normal)};
  const Vec3 bend = after - before;
  if (bend.squaredNorm() > 0) {
    frame.mitre_direction = bend.normalized();
    frame.mitre_stretch = 2 / (before + after).norm() - 1;
  }
  return frame;
}

class RingWriter {
 public:
  RingWriter(int sides, double phase) : corner_radius_(CornerRadius(sides)), phase_(phase) {
    rings_.sides = sides;
  }

  void AddRing(const RingFrame& frame, double radius) {
    for (int k = 0; k < rings_.sides; ++k) {
      const double angle = phase_ + 2 * std::numbers::pi * k / rings_.sides;
      const double noise = 2 * HashedNumber(rings_.vertices.size()) - 1;
      Vec3 offset = radius * corner_radius_ * (1 + kSurfaceRoughness * noise) *
                    (std::cos(angle) * frame.normal + std::sin(angle) * frame.binormal);
      offset += frame.mitre_stretch * offset.dot(frame.mitre_direction) * frame.mitre_direction;
      rings_.vertices.push_back((frame.centre + offset).cast<float>());
    }
    ++rings_.ring_count;
  }

  // The rings of a hemisphere from latitude index `first` to `last` (0 = the rim, excluded).
  void AddDome(const RingFrame& rim, const Vec3& outward, double radius, bool towards_pole) {
    for (int step = 1; step < kDomeRings; ++step) {
      const int ring = towards_pole ? step : kDomeRings - step;
      const double latitude = std::numbers::pi / 2 * ring / kDomeRings;
      RingFrame frame = rim;
      frame.centre += radius * kDomeHeight * std::sin(latitude) * outward;
      AddRing(frame, radius * kDomeWidth * std::cos(latitude));
    }
  }

  static Vec3f Pole(const RingFrame& rim, const Vec3& outward, double radius) {
    return (rim.centre + radius * kDomeHeight * outward).cast<float>();
  }

  void MarkPoint() { rings_.ring_of_point.push_back(rings_.ring_count); }
  TubeRings& rings() { return rings_; }

 private:
  TubeRings rings_;
  double corner_radius_;
  double phase_;
};

// The full ring a little before a flat end that is thinner than the tube.
void AddTaper(const TubePath& path, int end_point, const RingFrame& frame, RingWriter& writer) {
  const int neighbour = end_point == 0 ? 1 : end_point - 1;
  const double radius = path.axis.radii[end_point];
  const Vec3 inward = path.axis.points[neighbour] - path.axis.points[end_point];
  const double length = std::min(kTaperLength * radius, kTaperPart * inward.norm());
  RingFrame tapered = frame;
  tapered.centre += length * inward.normalized();
  writer.AddRing(tapered, radius);
}

void AddStart(const TubePath& path, const RingFrame& frame, RingWriter& writer) {
  const TubeEnd& end = path.ends[0];
  const double radius = path.axis.radii.front();
  if (end.rounded) {
    writer.AddDome(frame, -DirectionAfter(path, 0), radius, false);
    writer.MarkPoint();
    writer.AddRing(frame, radius);
    return;
  }
  writer.MarkPoint();
  writer.AddRing(frame, end.radius);
  if (end.radius < radius) AddTaper(path, 0, frame, writer);
}

void AddFinish(const TubePath& path, const RingFrame& frame, RingWriter& writer) {
  const TubeEnd& end = path.ends[1];
  const int last = static_cast<int>(path.axis.points.size()) - 1;
  const double radius = path.axis.radii.back();
  if (!end.rounded && end.radius < radius) AddTaper(path, last, frame, writer);
  writer.MarkPoint();
  writer.AddRing(frame, end.rounded ? radius : end.radius);
  if (end.rounded) writer.AddDome(frame, DirectionBefore(path, last), radius, true);
}

void AddPoles(const TubePath& path, const std::vector<RingFrame>& frames, RingWriter& writer) {
  const int last = static_cast<int>(path.axis.points.size()) - 1;
  const std::array<int, 2> points = {0, last};
  const std::array<Vec3, 2> outward = {-DirectionAfter(path, 0), DirectionBefore(path, last)};
  for (int side = 0; side < 2; ++side) {
    if (!path.ends[side].rounded) continue;
    writer.rings().poles[side] = static_cast<int>(writer.rings().vertices.size());
    writer.rings().vertices.push_back(
        writer.Pole(frames[points[side]], outward[side], path.axis.radii[points[side]]));
  }
}

void AddBand(const TubeRings& rings, int ring, std::vector<std::array<int, 3>>& triangles) {
  const int sides = rings.sides;
  const int next = (ring + 1) % rings.ring_count;
  for (int k = 0; k < sides; ++k) {
    const int a = ring * sides + k;
    const int b = ring * sides + (k + 1) % sides;
    const int c = next * sides + k;
    const int d = next * sides + (k + 1) % sides;
    triangles.push_back({a, b, d});
    triangles.push_back({a, d, c});
  }
}

void AddPoleFan(const TubeRings& rings, int side, std::vector<std::array<int, 3>>& triangles) {
  const int first = side == 0 ? 0 : (rings.ring_count - 1) * rings.sides;
  for (int k = 0; k < rings.sides; ++k) {
    const int a = first + k;
    const int b = first + (k + 1) % rings.sides;
    triangles.push_back(side == 0 ? std::array<int, 3>{b, a, rings.poles[0]}
                                  : std::array<int, 3>{a, b, rings.poles[1]});
  }
}

// A disc over a ring without new vertices, as a zigzag; `backwards` faces the start of the tube.
void AddDisc(const TubeRings& rings, int ring, bool backwards,
             std::vector<std::array<int, 3>>& triangles) {
  const int base = ring * rings.sides;
  int low = 0;
  int high = rings.sides - 1;
  for (bool raise_low = true; high - low > 1; raise_low = !raise_low) {
    const int middle = raise_low ? low + 1 : high - 1;
    std::array<int, 3> triangle = {base + low, base + middle, base + high};
    if (backwards) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
    (raise_low ? low : high) = middle;
  }
}

int SegmentCount(const TubeRings& rings) {
  return static_cast<int>(rings.ring_of_point.size()) - (rings.closed ? 0 : 1);
}

// One past the last band of a segment.
int BandsEnd(const TubeRings& rings, int segment) {
  return segment + 1 < static_cast<int>(rings.ring_of_point.size())
             ? rings.ring_of_point[segment + 1]
             : rings.ring_count;
}

std::vector<std::array<int, 3>> SideTriangles(const TubeRings& rings, int first_segment,
                                              int last_segment) {
  std::vector<std::array<int, 3>> triangles;
  for (int segment = first_segment; segment < last_segment; ++segment) {
    const auto side = SegmentTriangles(rings, segment % SegmentCount(rings));
    triangles.insert(triangles.end(), side.begin(), side.end());
  }
  return triangles;
}

TriangleMesh WithUsedVertices(const TubeRings& rings, std::vector<std::array<int, 3>> triangles) {
  TriangleMesh mesh;
  // A map, not a table: the stub of a long tube uses few of its vertices.
  std::map<int, int> compact;
  for (std::array<int, 3>& triangle : triangles) {
    for (int& vertex : triangle) {
      const auto [entry, is_new] =
          compact.try_emplace(vertex, static_cast<int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(rings.vertices[vertex]);
      vertex = entry->second;
    }
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

}  // namespace

std::vector<Vec3> RotationMinimisingNormals(const TubePath& path) {
  const int n = static_cast<int>(path.axis.points.size());
  std::vector<Vec3> normals = {Tangent(path, 0).unitOrthogonal()};
  for (int i = 0; i + 1 < n; ++i) normals.push_back(TransportedNormal(path, i, normals.back()));
  if (!path.closed) return normals;
  const Vec3 arrived = TransportedNormal(path, n - 1, normals.back());
  const Vec3 axis = Tangent(path, 0);
  const double twist = std::atan2(axis.dot(arrived.cross(normals[0])), arrived.dot(normals[0]));
  for (int i = 0; i < n; ++i) {
    normals[i] = Eigen::AngleAxisd(twist * i / n, Tangent(path, i)) * normals[i];
  }
  return normals;
}

TubeRings SweepRings(const TubePath& path, int sides, double phase) {
  const int n = static_cast<int>(path.axis.points.size());
  const std::vector<Vec3> normals = RotationMinimisingNormals(path);
  std::vector<RingFrame> frames;
  for (int i = 0; i < n; ++i) frames.push_back(FrameAt(path, i, normals[i]));
  RingWriter writer(sides, phase);
  writer.rings().closed = path.closed;
  for (int i = 0; i < n; ++i) {
    if (!path.closed && i == 0) {
      AddStart(path, frames[i], writer);
    } else if (!path.closed && i == n - 1) {
      AddFinish(path, frames[i], writer);
    } else {
      writer.MarkPoint();
      writer.AddRing(frames[i], path.axis.radii[i]);
    }
  }
  if (!path.closed) AddPoles(path, frames, writer);
  return writer.rings();
}

std::vector<std::array<int, 3>> SegmentTriangles(const TubeRings& rings, int segment) {
  std::vector<std::array<int, 3>> triangles;
  const bool starts = !rings.closed && segment == 0;
  const bool finishes = !rings.closed && segment + 1 == SegmentCount(rings);
  const int first = starts ? 0 : rings.ring_of_point[segment];
  const int end = finishes ? rings.ring_count - 1 : BandsEnd(rings, segment);
  for (int ring = first; ring < end; ++ring) AddBand(rings, ring, triangles);
  for (int side = 0; side < 2; ++side) {
    if (!(side == 0 ? starts : finishes)) continue;
    if (rings.poles[side] >= 0) {
      AddPoleFan(rings, side, triangles);
    } else {
      AddDisc(rings, side == 0 ? 0 : rings.ring_count - 1, side == 0, triangles);
    }
  }
  return triangles;
}

TriangleMesh SideOfStub(const TubeRings& rings, int first_segment, int last_segment) {
  return WithUsedVertices(rings, SideTriangles(rings, first_segment, last_segment));
}

TriangleMesh CloseStub(const TubeRings& rings, int first_segment, int last_segment) {
  const int count = SegmentCount(rings);
  std::vector<std::array<int, 3>> triangles = SideTriangles(rings, first_segment, last_segment);
  const bool whole_ring = rings.closed && last_segment - first_segment == count;
  const auto ring_at = [&](int point) {
    return rings.ring_of_point[point % (count + !rings.closed)];
  };
  if (!whole_ring && (rings.closed || first_segment > 0)) {
    AddDisc(rings, ring_at(first_segment), true, triangles);
  }
  if (!whole_ring && (rings.closed || last_segment < count)) {
    AddDisc(rings, ring_at(last_segment), false, triangles);
  }
  return WithUsedVertices(rings, std::move(triangles));
}

}  // namespace curvefusion
