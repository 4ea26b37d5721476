#include "fusion/segmentation/depth_opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "capture/depth_noise.h"
#include "kernel/error.h"

namespace curvefusion {

void VisitOptions(DepthOpeningOptions& options, OptionVisitor& visitor) {
  visitor.Visit(
      {"opening_radius", "m", 0, 0.5,
       "The rendering's surfaces are eroded and dilated by so much; what is narrower than "
       "twice that is no large surface. CurveFusion 4.1."},
      options.radius);
  visitor.Visit({"discontinuity", "m", 0.001, 0.5,
                 "A step of the rendering's depth above that is an edge, unless the surface is as "
                 "steep beside it. CurveFusion 4.1 gives no value."},
                options.discontinuity);
  visitor.Visit({"solid_depth", "m", 0, 0.1,
                 "Deviation: what frames saw through so far behind its rendering is no large "
                 "surface but a grille; 0 = not asked."},
                options.solid_depth);
}

namespace {

// Derived, the tangent of 85 degrees: a surface seen at more from its normal cannot be told from a
// discontinuity.
constexpr float kSteepestSlope = 11.4f;
constexpr auto kStepNoise = static_cast<float>(kStepPerSquaredDepth);
// What is less solid was seen through: 1 = solid, 0 and less = mostly seen through. Chosen not far
// above 0: behind a table seen at a grazing angle by some frames and from above by others it is a
// small share only, but not negative.
constexpr double kMinSolidity = 0.05;

// How a pixel hangs together with its neighbours; links up and left are theirs down and right.
enum PixelLink : uint8_t {
  kRight = 1,
  kDown = 2,
  kDownRight = 4,
  kDownLeft = 8,
  kNearEdge = 16,  ///< a neighbour lies across a discontinuity and farther, or is missing
};

// Which neighbouring pixels of a rendering lie on one surface.
class SurfaceLinks {
 public:
  SurfaceLinks(const DepthImage& depth, const PinholeCamera& camera,
               const DepthOpeningOptions& options)
      : depth_(depth),
        discontinuity_(static_cast<float>(options.discontinuity)),
        links_(depth.width(), depth.height(), 0) {
    const float steepest_u = kSteepestSlope / static_cast<float>(camera.fx);
    const float steepest_v = kSteepestSlope / static_cast<float>(camera.fy);
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        if (u + 1 < depth.width()) LinkPair(u, v, 1, 0, kRight, steepest_u);
        if (v + 1 < depth.height()) LinkPair(u, v, 0, 1, kDown, steepest_v);
      }
    }
    LinkDiagonals();
  }

  const Image<uint8_t>& links() const { return links_; }

 private:
  // Links pixel (u, v) with the next one along (du, dv), or marks the edge between them.
  void LinkPair(int u, int v, int du, int dv, PixelLink link, float steepest) {
    const float a = depth_(u, v), b = depth_(u + du, v + dv);
    if (a > 0 && b > 0) {
      const float near = std::min(a, b), step = std::abs(a - b);
      const float tolerance = std::max(discontinuity_, kStepNoise * near * near);
      if (step <= tolerance ||
          (step <= steepest * near && ContinuesSlope(u, v, du, dv, tolerance))) {
        links_(u, v) |= link;
        return;
      }
    }
    if (a > 0 && !(b > 0 && b < a)) links_(u, v) |= kNearEdge;
    if (b > 0 && !(a > 0 && a < b)) links_(u + du, v + dv) |= kNearEdge;
  }

  // Whether a step goes on the slope beside it, on either side. Planes are linear in inverse depth.
  bool ContinuesSlope(int u, int v, int du, int dv, float tolerance) const {
    const auto predicts = [&](int base_u, int base_v, int sign) {
      const int beside_u = base_u - sign * du, beside_v = base_v - sign * dv;
      if (!depth_.Contains(beside_u, beside_v) || !(depth_(beside_u, beside_v) > 0)) return false;
      const float inverse = 2 / depth_(base_u, base_v) - 1 / depth_(beside_u, beside_v);
      const float next = depth_(base_u + sign * du, base_v + sign * dv);
      return inverse > 0 && std::abs(1 / inverse - next) <= tolerance;
    };
    return predicts(u, v, 1) || predicts(u + du, v + dv, -1);
  }

  // Diagonal neighbours hang together when one of the two ways around does.
  void LinkDiagonals() {
    for (int v = 0; v + 1 < links_.height(); ++v) {
      uint8_t* row = links_.row(v);
      const uint8_t* below = links_.row(v + 1);
      for (int u = 0; u + 1 < links_.width(); ++u) {
        const bool right = row[u] & kRight, down = row[u] & kDown;
        const bool right_down = row[u + 1] & kDown, below_right = below[u] & kRight;
        if ((right && right_down) || (down && below_right)) row[u] |= kDownRight;
        if ((right && down) || (right_down && below_right)) row[u + 1] |= kDownLeft;
      }
    }
  }

  const DepthImage& depth_;
  float discontinuity_;
  Image<uint8_t> links_;
};

// Absolute offset to the nearest source pixel.
struct Nearest {
  static constexpr int kNone = std::numeric_limits<int>::max();
  int squared = kNone;
  int limit = 0;  ///< squared distance up to which the source reaches
  int16_t du = 0;
  int16_t dv = 0;
};

// Distances to the nearest source pixel within the same surface (Danielsson 1980, in four sweeps),
// as far as that source reaches. Offsets only grow along a path: around an obstacle the way counts,
// as far as four sweeps can follow it.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const Image<uint8_t>& links)
      : links_(links), nearest_(links.width(), links.height(), Nearest()) {}

  void AddSource(int u, int v, float reach_px) {
    nearest_(u, v).squared = 0;
    nearest_(u, v).limit = static_cast<int>(reach_px * reach_px);
  }

  void Propagate() {
    const int height = links_.height();
    for (int v = 0; v < height; ++v) {
      if (v > 0) PullFromAbove(v);
      SweepRow(v);
    }
    for (int v = height - 2; v >= 0; --v) {
      PullFromBelow(v);
      SweepRow(v);
    }
  }

  /// Squared distance in pixels; Nearest::kNone where no source reaches.
  int Squared(int u, int v) const { return nearest_(u, v).squared; }

 private:
  void Pull(Nearest& pixel, const Nearest& neighbour, int step_u, int step_v) const {
    if (neighbour.squared >= pixel.squared) return;
    const int du = neighbour.du + step_u, dv = neighbour.dv + step_v;
    const int squared = du * du + dv * dv;
    if (squared >= pixel.squared || squared > neighbour.limit) return;
    pixel = {squared, neighbour.limit, static_cast<int16_t>(du), static_cast<int16_t>(dv)};
  }

  void PullFromAbove(int v) {
    const int width = links_.width();
    const uint8_t* links = links_.row(v - 1);
    const Nearest* above = nearest_.row(v - 1);
    Nearest* row = nearest_.row(v);
    for (int u = 0; u < width; ++u) {
      if (row[u].squared == 0) continue;
      if (links[u] & kDown) Pull(row[u], above[u], 0, 1);
      if (u > 0 && links[u - 1] & kDownRight) Pull(row[u], above[u - 1], 1, 1);
      if (u + 1 < width && links[u + 1] & kDownLeft) Pull(row[u], above[u + 1], 1, 1);
    }
  }

  void PullFromBelow(int v) {
    const int width = links_.width();
    const uint8_t* links = links_.row(v);
    const Nearest* below = nearest_.row(v + 1);
    Nearest* row = nearest_.row(v);
    for (int u = 0; u < width; ++u) {
      if (row[u].squared == 0) continue;
      if (links[u] & kDown) Pull(row[u], below[u], 0, 1);
      if (links[u] & kDownRight) Pull(row[u], below[u + 1], 1, 1);
      if (links[u] & kDownLeft) Pull(row[u], below[u - 1], 1, 1);
    }
  }

  void SweepRow(int v) {
    const uint8_t* links = links_.row(v);
    Nearest* row = nearest_.row(v);
    for (int u = 1; u < links_.width(); ++u) {
      if (links[u - 1] & kRight) Pull(row[u], row[u - 1], 1, 0);
    }
    for (int u = links_.width() - 2; u >= 0; --u) {
      if (links[u] & kRight) Pull(row[u], row[u + 1], 1, 0);
    }
  }

  const Image<uint8_t>& links_;
  Image<Nearest> nearest_;
};

// Lengths on a surface as the image shows them.
class MetricScale {
 public:
  explicit MetricScale(const PinholeCamera& camera)
      : focal_length_(static_cast<float>(std::sqrt(camera.fx * camera.fy))) {}
  float Pixels(double metres, float depth) const {
    return focal_length_ * static_cast<float>(metres) / depth;
  }

 private:
  float focal_length_;  // of square pixels of the same area
};

float LeastDepth(const DepthImage& depth) {
  float least = std::numeric_limits<float>::infinity();
  for (size_t i = 0; i < depth.size(); ++i) {
    if (depth.data()[i] > 0) least = std::min(least, depth.data()[i]);
  }
  return least;
}

// Takes from `eroded` what lies within the radius of a source pixel of the same surface.
template <typename IsSource>
void ErodeFrom(const IsSource& is_source, const DepthImage& depth, const Image<uint8_t>& links,
               const MetricScale& scale, double radius, MaskImage& eroded) {
  SurfaceDistance to_source(links);
  const float greatest_reach = scale.Pixels(radius, LeastDepth(depth)) + 1;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (is_source(u, v)) to_source.AddSource(u, v, greatest_reach);
    }
  }
  to_source.Propagate();
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!eroded(u, v)) continue;
      // An edge runs half a pixel outside of the centre of the last pixel.
      const float reach = std::max(0.0f, scale.Pixels(radius, depth(u, v)) - 0.5f);
      eroded(u, v) = static_cast<float>(to_source.Squared(u, v)) >= reach * reach;
    }
  }
}

// 1 where a disc of the radius around the pixel keeps within its surface, and one of half the
// radius within what nothing was seen through: lone solid places of a grille go.
MaskImage Erode(const DepthImage& depth, const DepthImage& solidity, const Image<uint8_t>& links,
                const MetricScale& scale, const DepthOpeningOptions& options) {
  MaskImage eroded(depth.width(), depth.height(), 0);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) eroded(u, v) = depth(u, v) > 0;
  }
  const auto is_edge = [&](int u, int v) { return (links(u, v) & kNearEdge) != 0; };
  ErodeFrom(is_edge, depth, links, scale, options.radius, eroded);
  if (solidity.size() == 0) return eroded;
  const auto is_open = [&](int u, int v) { return solidity(u, v) < kMinSolidity; };
  ErodeFrom(is_open, depth, links, scale, options.radius / 2, eroded);
  return eroded;
}

// The pixels of the rendering within the discs around what erosion left.
DepthImage DilateBack(const DepthImage& depth, const Image<uint8_t>& links,
                      const MetricScale& scale, double radius, const MaskImage& eroded) {
  // Pixels; derived: erosion and dilation together round by up to one pixel where an edge runs
  // obliquely.
  constexpr float kRounding = 1;
  SurfaceDistance to_eroded(links);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!eroded(u, v)) continue;
      to_eroded.AddSource(u, v, scale.Pixels(radius, depth(u, v)) + kRounding);
    }
  }
  to_eroded.Propagate();
  DepthImage opened(depth.width(), depth.height(), 0);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (to_eroded.Squared(u, v) != Nearest::kNone) opened(u, v) = depth(u, v);
    }
  }
  return opened;
}

}  // namespace

DepthImage OpenDepth(const DepthImage& rendering, const PinholeCamera& camera,
                     const DepthImage& solidity, const DepthOpeningOptions& options) {
  if (rendering.width() != camera.width || rendering.height() != camera.height) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("depth rendering of {} x {} pixels does not fit its camera of {} x {}",
                            rendering.width(), rendering.height(), camera.width, camera.height));
  }
  const SurfaceLinks surface(rendering, camera, options);
  const MetricScale scale(camera);
  assert(solidity.size() == 0 || solidity.size() == rendering.size());
  const MaskImage eroded = Erode(rendering, solidity, surface.links(), scale, options);
  return DilateBack(rendering, surface.links(), scale, options.radius, eroded);
}

}  // namespace curvefusion
