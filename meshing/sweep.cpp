#include "meshing/sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "meshing/ball_rings.h"
#include "meshing/hashed_number.h"

namespace curvefusion {

namespace {

// A dome has a ring for every four sides: steps of the same angle in both directions.
constexpr int kSidesPerDomeRing = 4;
constexpr int kLeastDomeRings = 4;
// A dome stands out of its ball to make up for its volume, and where tubes are joined to it what
// touches there would bridge the groove beside it: such a dome has more rings, which stand out
// less.
constexpr int kRingsOfJoinedDome = 2;
// Of the radius: a dome of four rings has the volume of a hemisphere when its pole lies so high
// and its inner rings are so wide; with more rings the excess falls with the square of their
// number.
constexpr double kDomeHeight = 1.0214;
constexpr double kDomeWidth = 1.0125;

// Of the radius: longer, it leaves a groove beside the disc; it must meet the ball at an angle.
constexpr double kTaperLength = 0.12;
// At its pole a dome that stays within balls lies so deep in them, in radii, that it does not
// coincide with another tube that follows the same balls.
constexpr double kSunk = 0.015;
constexpr double kTaperPart = 0.3;  // at most, of the segment

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

  // The circle in a frame, as the corners of a polygon.
  Ring Circle(const RingFrame& frame, double radius) const {
    Ring ring{frame.centre, radius, {}};
    for (int k = 0; k < rings_.sides; ++k) {
      const double angle = phase_ + 2 * std::numbers::pi * k / rings_.sides;
      Vec3 offset = radius * (std::cos(angle) * frame.normal + std::sin(angle) * frame.binormal);
      offset += frame.mitre_stretch * offset.dot(frame.mitre_direction) * frame.mitre_direction;
      ring.offsets.push_back(offset);
    }
    return ring;
  }

  void Add(const Ring& ring) {
    for (const Vec3& offset : ring.offsets) {
      const double noise = 2 * HashedNumber(rings_.vertices.size()) - 1;
      const double scale = corner_radius_ * (1 + kSurfaceRoughness * noise);
      rings_.vertices.push_back((ring.centre + scale * offset).cast<float>());
    }
    ++rings_.ring_count;
  }

  void AddRing(const RingFrame& frame, double radius) { Add(Circle(frame, radius)); }

  // The inner rings of a hemisphere, which stays within the balls if there are any.
  void AddDome(const RingFrame& rim, const Vec3& outward, double radius, bool towards_pole,
               bool joined, const TubeAxis& balls) {
    const int count = DomeRings(joined);
    for (int step = 1; step < count; ++step) {
      const double latitude = std::numbers::pi / 2 * (towards_pole ? step : count - step) / count;
      Ring ring = Circle(rim, radius * Swollen(kDomeWidth, count) * std::cos(latitude));
      const Vec3 up =
          radius * Swollen(kDomeHeight, count) * std::sin(latitude) / corner_radius_ * outward;
      for (Vec3& offset : ring.offsets) offset += up;
      if (!balls.points.empty()) {
        ring = OntoBalls(ring, balls, radius);
        for (Vec3& offset : ring.offsets) offset *= 1 - kSunk * std::sin(latitude);
      }
      Add(ring);
    }
  }

  Vec3f Pole(const RingFrame& rim, const Vec3& outward, double radius, bool joined,
             const TubeAxis& balls) const {
    const double height =
        balls.points.empty()
            ? radius
            : (1 - kSunk) * std::min(radius, ExtentOfBalls(balls, rim.centre, outward));
    return (rim.centre + height * Swollen(kDomeHeight, DomeRings(joined)) * outward).cast<float>();
  }

  void MarkPoint() { rings_.ring_of_point.push_back(rings_.ring_count); }
  TubeRings& rings() { return rings_; }

 private:
  int DomeRings(bool joined) const {
    const int count = std::max(kLeastDomeRings, rings_.sides / kSidesPerDomeRing);
    return joined ? kRingsOfJoinedDome * count : count;
  }

  // What the factor for a dome of the least number of rings is for one of so many.
  static double Swollen(double factor, int rings) {
    const double share = static_cast<double>(kLeastDomeRings) / rings;
    return 1 + (factor - 1) * share * share;
  }

  TubeRings rings_;
  double corner_radius_;
  double phase_;
};

bool Tapers(const TubePath& path, int side) {
  const TubeEnd& end = path.ends[side];
  return !end.rounded &&
         end.radius < (side == 0 ? path.axis.radii.front() : path.axis.radii.back());
}

// Where the side of a tube begins at a point: before a flat end that is thinner than the tube a
// little farther on.
RingFrame FrameOfSide(const TubePath& path, int i, RingFrame frame) {
  const int last = static_cast<int>(path.axis.points.size()) - 1;
  if (path.closed || (i != 0 && i != last) || !Tapers(path, i == 0 ? 0 : 1)) return frame;
  const Vec3 inward = path.axis.points[i == 0 ? 1 : i - 1] - path.axis.points[i];
  const double length = std::min(kTaperLength * path.axis.radii[i], kTaperPart * inward.norm());
  frame.centre += length * inward.normalized();
  return frame;
}

using SegmentBalls = std::vector<TubeAxis>;

// The balls beside a segment, none where there is no such segment.
const TubeAxis& BallsOf(const SegmentBalls& balls, int segment) {
  static const TubeAxis none;
  return segment < static_cast<int>(balls.size()) ? balls[segment] : none;
}

void AddStart(const TubePath& path, const RingFrame& frame, const Ring& side,
              const SegmentBalls& balls, RingWriter& writer) {
  const TubeEnd& end = path.ends[0];
  const double radius = path.axis.radii.front();
  if (end.rounded) {
    writer.AddDome(frame, -DirectionAfter(path, 0), radius, false, end.joined, BallsOf(balls, 0));
    writer.MarkPoint();
    writer.Add(side);
    return;
  }
  writer.MarkPoint();
  writer.AddRing(frame, end.radius);
  if (Tapers(path, 0)) writer.Add(side);
}

void AddFinish(const TubePath& path, const RingFrame& frame, const Ring& side,
               const SegmentBalls& balls, RingWriter& writer) {
  const TubeEnd& end = path.ends[1];
  const int last = static_cast<int>(path.axis.points.size()) - 1;
  if (Tapers(path, 1)) writer.Add(side);
  writer.MarkPoint();
  if (end.rounded) {
    writer.Add(side);
    writer.AddDome(frame, DirectionBefore(path, last), path.axis.radii.back(), true, end.joined,
                   BallsOf(balls, last - 1));
  } else {
    writer.AddRing(frame, end.radius);
  }
}

void AddPoles(const TubePath& path, const std::vector<RingFrame>& frames, const SegmentBalls& balls,
              RingWriter& writer) {
  const int last = static_cast<int>(path.axis.points.size()) - 1;
  const std::array<int, 2> points = {0, last};
  const std::array<int, 2> segments = {0, last - 1};
  const std::array<Vec3, 2> outward = {-DirectionAfter(path, 0), DirectionBefore(path, last)};
  for (int side = 0; side < 2; ++side) {
    if (!path.ends[side].rounded) continue;
    writer.rings().poles[side] = static_cast<int>(writer.rings().vertices.size());
    writer.rings().vertices.push_back(
        writer.Pole(frames[points[side]], outward[side], path.axis.radii[points[side]],
                    path.ends[side].joined, BallsOf(balls, segments[side])));
  }
}

// The rings at the points of a path, with the shape of the balls of the segments to both sides.
std::vector<Ring> ShapedRings(const TubePath& path, const std::vector<Ring>& circles,
                              const SegmentBalls& balls) {
  std::vector<Ring> shaped = circles;
  for (int i = 0; i < static_cast<int>(circles.size()); ++i) {
    TubeAxis beside = BallsOf(balls, i);
    const int before = PreviousPoint(path, i);
    if (before != i) AppendAxis(BallsOf(balls, before), beside);
    const double greatest = kGreatestExtent * circles[i].radius;
    if (!beside.points.empty()) shaped[i] = OntoBalls(circles[i], beside, greatest);
  }
  return shaped;
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

TubeRings SweepRings(const TubePath& path, int sides, double phase,
                     const std::vector<TubeAxis>& balls) {
  const int n = static_cast<int>(path.axis.points.size());
  const std::vector<Vec3> normals = RotationMinimisingNormals(path);
  RingWriter writer(sides, phase);
  writer.rings().closed = path.closed;
  std::vector<RingFrame> frames;
  std::vector<Ring> circles;
  for (int i = 0; i < n; ++i) {
    frames.push_back(FrameAt(path, i, normals[i]));
    circles.push_back(writer.Circle(FrameOfSide(path, i, frames[i]), path.axis.radii[i]));
  }
  const std::vector<Ring> shaped = ShapedRings(path, circles, balls);
  for (int i = 0; i < n; ++i) {
    if (!path.closed && i == 0) {
      AddStart(path, frames[i], shaped[i], balls, writer);
    } else if (!path.closed && i == n - 1) {
      AddFinish(path, frames[i], shaped[i], balls, writer);
    } else {
      writer.MarkPoint();
      writer.Add(shaped[i]);
    }
    if (BallsOf(balls, i).points.empty()) continue;
    const int next = NextPoint(path, i);
    for (const Ring& ring :
         RingsBetween(circles[i], circles[next], shaped[i], shaped[next], balls[i])) {
      writer.Add(ring);
    }
  }
  if (!path.closed) AddPoles(path, frames, balls, writer);
  return writer.rings();
}

}  // namespace curvefusion
