#include "fusion/best/curves_in_depth.h"

#include <algorithm>
#include <cmath>

#include "capture/farthest_depth.h"
#include "capture/frame_stream.h"
#include "kernel/parallel.h"
#include "kernel/polyline.h"

namespace curvefusion {

namespace {

constexpr double kStep = 0.003;  // metres; chosen: between the places that depth is asked about
// Depth shows wires in wrong places, but in the right pixels. Chosen on four scans of wires, of
// whose curves from colour .84 and more lie where depth shows something thin, and five rooms
// without any, where .42 at most do (docs/lab_notebook.md).
constexpr double kMinThinInDepth = 0.6;
// Or depth does not show them at all, but what is behind. Chosen: that holds for .95 to 1.00 of the
// places of a rack and a wheel by a phone (training scans), and for .07 to .43 of what five rooms
// without wires give.
constexpr double kMinFreeInDepth = 0.9;
// Or depth has holes there, as of a thin wire by an SR300. Chosen: .01 to .03 of the places of a
// cage, a cube frame and a dome (training scans) are measured, and .63 to .69 of all have depth
// that lies behind on both sides. Rooms without wires have .49 and more of the places measured.
constexpr double kMaxMeasuredInHoles = 0.1;
constexpr double kMinOpenInHoles = 0.55;
constexpr double kReach = 0.05;  // chosen: of the width of images, from a place to depth beside it
constexpr int kThinImages = 20;  // chosen: enough for a share
// Images tell no size: of that which depth will tell in the end, of the distance. Derived:
// HoldToScaleOfDepth tries as much. Without it the frame of a monitor, too near by 43 mm, lies
// before its own depth.
constexpr double kScaleError = 0.06;
constexpr double kThinCellPx = 8;  // chosen: of images 640 pixels wide

double Share(size_t part, size_t of) {
  return of > 0 ? static_cast<double>(part) / static_cast<double>(of) : 0;
}

// Where images have pixels in which something lies, as cells with their neighbours.
MaskImage CellsAround(const std::vector<Vec3>& points, const PinholeCamera& cells,
                      const RigidTransform& T_camera_world) {
  MaskImage around(cells.width, cells.height, 0);
  for (const Vec3& point : points) {
    const Vec3 p = T_camera_world * point;
    if (p.z() <= 0) continue;
    const Vec2 pixel = cells.Project(p);
    if (!cells.Contains(pixel)) continue;
    const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
    for (int v = std::max(0, at.y() - 1); v <= std::min(cells.height - 1, at.y() + 1); ++v)
      for (int u = std::max(0, at.x() - 1); u <= std::min(cells.width - 1, at.x() + 1); ++u)
        around(u, v) = 1;
  }
  return around;
}

PinholeCamera ThinCells(const PinholeCamera& camera) {
  return camera.Scaled(640 / (kThinCellPx * camera.width));
}

// Places in the world of a sequence's poses.
struct PosedPlaces {
  std::vector<Vec3> places;
  const Sequence& sequence;
};

std::vector<Vec3> PlacesAlong(const SkeletonGraph& skeleton) {
  std::vector<Vec3> places;
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline points = Resample(skeleton.edge(id).points, kStep);
    places.insert(places.end(), points.begin(), points.end());
  }
  return places;
}

// How many of the places, over 20 images, lie in pixels around which others do, at whatever
// distance.
double ShareInPixelsOf(const PosedPlaces& others, const PosedPlaces& places,
                       const std::vector<int>& frames) {
  const PinholeCamera cells = ThinCells(others.sequence.color_camera);
  size_t looked = 0, found = 0;
  for (const int frame : EvenlyThinned(frames, kThinImages)) {
    const MaskImage around =
        CellsAround(others.places, cells, others.sequence.T_color_world(frame));
    const RigidTransform T_color_world = places.sequence.T_color_world(frame);
    for (const Vec3& place : places.places) {
      const Vec3 p = T_color_world * place;
      if (p.z() <= 0 || !cells.Contains(cells.Project(p))) continue;
      const Eigen::Vector2i at = PinholeCamera::Rounded(cells.Project(p));
      ++looked;
      found += around(at.x(), at.y());
    }
  }
  return Share(found, looked);
}

// Whether depth lies behind a place on both sides of the curve that it lies on: what is there is a
// wire, or nothing.
bool IsOpenOnBothSides(const DepthImage& depth, const Vec2& pixel, const Vec2& along,
                       double behind) {
  const Vec2 across = Vec2(-along.y(), along.x()).normalized();
  const auto is_open_at = [&](double distance) {
    const Eigen::Vector2i at = PinholeCamera::Rounded(pixel + distance * across);
    return depth.Contains(at.x(), at.y()) && depth(at.x(), at.y()) > behind;
  };
  const int reach = static_cast<int>(std::lround(kReach * depth.width()));
  bool is_left = false, is_right = false;
  for (int distance = 1; distance <= reach; ++distance) {
    is_left = is_left || is_open_at(-distance);
    is_right = is_right || is_open_at(distance);
  }
  return is_left && is_right;
}

}  // namespace

bool PlacesInDepth::HaveHoles() const { return Share(measured, looked) < kMaxMeasuredInHoles; }

double PlacesInDepth::ShareOpen() const {
  return HaveHoles() ? Share(open, looked) : Share(free, measured);
}

bool PlacesInDepth::AreOpen() const {
  return ShareOpen() >= (HaveHoles() ? kMinOpenInHoles : kMinFreeInDepth);
}

PlacesInDepth LookUpDepth(const Sequence& sequence, const SkeletonGraph& skeleton,
                          const std::vector<int>& frames) {
  const PinholeCamera& camera = sequence.depth_camera;
  PlacesInDepth places;
  for (const int frame : EvenlyThinned(frames, kThinImages)) {
    const DepthImage depth = LoadDepth(sequence, frame);
    const RigidTransform T_camera_world = sequence.frames[frame].T_world_camera.inverse();
    for (const EdgeId id : skeleton.Edges()) {
      const Polyline points = Resample(skeleton.edge(id).points, kStep);
      for (size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec3 p = T_camera_world * points[i];
        const Vec3 next = T_camera_world * points[i + 1];
        if (p.z() <= 0 || next.z() <= 0 || !camera.Contains(camera.Project(p))) continue;
        const Vec2 pixel = camera.Project(p);
        const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
        const double there = depth(at.x(), at.y());
        const double margin = kHidingDistance + kScaleError * p.z();
        if (there > 0 && there < p.z() - margin) continue;  // hidden
        const bool is_free = there > p.z() + margin;
        ++places.looked;
        places.measured += there > 0;
        places.free += is_free;
        places.open += is_free || IsOpenOnBothSides(depth, pixel, camera.Project(next) - pixel,
                                                    p.z() + margin);
      }
    }
  }
  return places;
}

std::vector<PosteriorImage> KeepThinInDepth(const Reconstruction& depth,
                                            const std::vector<int>& frames,
                                            std::vector<PosteriorImage> posteriors) {
  ParallelFor(0, static_cast<int64_t>(frames.size()), 1, [&](int64_t i) {
    const MaskImage around =
        CellsAround(depth.points.positions, ThinCells(depth.sequence.color_camera),
                    depth.sequence.T_color_world(frames[i]));
    PosteriorImage& image = posteriors[i];
    for (int v = 0; v < image.height(); ++v) {
      const uint8_t* cells = around.row(v * around.height() / image.height());
      uint8_t* likely = image.row(v);
      for (int u = 0; u < image.width(); ++u)
        if (cells[u * around.width() / image.width()] == 0) likely[u] = 0;
    }
  });
  return posteriors;
}

double ShareThinInDepth(const Reconstruction& depth, const Reconstruction& colour,
                        const std::vector<int>& frames) {
  return ShareInPixelsOf({depth.points.positions, depth.sequence},
                         {PlacesAlong(colour.skeleton), colour.sequence}, frames);
}

bool IsThinInDepth(double share) { return share >= kMinThinInDepth; }

double ShareOnCurves(const Reconstruction& depth, const Reconstruction& colour,
                     const std::vector<int>& frames) {
  return ShareInPixelsOf({PlacesAlong(colour.skeleton), colour.sequence},
                         {depth.points.positions, depth.sequence}, frames);
}

}  // namespace curvefusion
