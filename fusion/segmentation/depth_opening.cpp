#include "fusion/segmentation/depth_opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "kernel/error.h"

namespace curvefusion {

void VisitOptions(DepthOpeningOptions& options, OptionVisitor& visitor) {
  visitor.Visit(
      {"opening_radius", "m", 0, 0.5,
       "The rendering's surfaces are eroded and dilated by so much; what is narrower than "
       "twice that is no large surface. CurveFusion 3.1."},
      options.radius);
  visitor.Visit({"discontinuity", "m", 0.001, 0.5,
                 "A step of the rendering's depth above that is an edge, unless the surface is as "
                 "steep beside it. CurveFusion 3.1 gives no value."},
                options.discontinuity);
  visitor.Visit({"solid_depth", "m", 0, 0.1,
                 "Deviation: what frames saw through so far behind its rendering is no large "
                 "surface but a grille; 0 = not asked."},
                options.solid_depth);
  visitor.Visit(
      {"min_solidity", "", 0, 1,
       "Deviation: what is less solid there was seen through. 1 = solid, 0 and less = mostly "
       "seen through; grazing views of a surface come near 0."},
      options.min_solidity);
  visitor.Visit({"discontinuity_noise", "1/m", 0, 0.1,
                 "Steps up to that times depth squared are noise. Khoshelham 2012 for the Kinect."},
                options.noise_quadratic);
}

namespace {

// A surface seen at more than 85 degrees from its normal cannot be told from a discontinuity.
constexpr float kSteepestSlope = 11.4f;

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
        noise_quadratic_(static_cast<float>(options.noise_quadratic)),
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
      const float tolerance = std::max(discontinuity_, noise_quadratic_ * near * near);
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
  float noise_quadratic_;
  Image<uint8_t> links_;
};

// Lengths as the image shows them, across the line of sight, in pixels.
class ImageMetric {
 public:
  using Value = int;
  ImageMetric(const DepthImage&, const PinholeCamera& camera)
      : focal_length_(static_cast<float>(std::sqrt(camera.fx * camera.fy))) {}
  float Reach(double metres, float depth) const {
    return focal_length_ * static_cast<float>(metres) / depth;
  }
  float Pixel(float) const { return 1; }
  // Offsets only grow along a path: around an obstacle the way counts, as far as four sweeps can
  // follow it.
  static int Offset(int before, int step) { return before + std::abs(step); }
  int Squared(int, int, int du, int dv) const { return du * du + dv * dv; }

 private:
  float focal_length_;  // of square pixels of the same area
};

// Distances between the points that pixels show, in metres.
class SpaceMetric {
 public:
  using Value = float;
  SpaceMetric(const DepthImage& depth, const PinholeCamera& camera)
      : focal_length_(static_cast<float>(std::sqrt(camera.fx * camera.fy))),
        points_(depth.width(), depth.height()) {
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        points_(u, v) = camera.Unproject(u, v, depth(u, v)).cast<float>();
      }
    }
  }
  float Reach(double metres, float) const { return static_cast<float>(metres); }
  float Pixel(float depth) const { return depth / focal_length_; }
  static int Offset(int before, int step) { return before + step; }
  // From a pixel to the one at an offset back from it.
  float Squared(int u, int v, int du, int dv) const {
    return (points_(u, v) - points_(u - du, v - dv)).squaredNorm();
  }

 private:
  float focal_length_;
  Image<Eigen::Vector3f> points_;
};

// Offset from the nearest source pixel, and its distance.
template <class Value>
struct Nearest {
  static constexpr Value kNone = std::numeric_limits<Value>::max();
  Value squared = kNone;
  Value limit = 0;  ///< squared distance up to which the source reaches
  int16_t du = 0;
  int16_t dv = 0;
};

// Distances to the nearest source pixel within the same surface (Danielsson 1980, in four sweeps),
// as far as that source reaches.
template <class Metric>
class SurfaceDistance {
 public:
  using Value = typename Metric::Value;
  using Pixel = Nearest<Value>;

  SurfaceDistance(const Image<uint8_t>& links, const Metric& metric)
      : links_(links), metric_(metric), nearest_(links.width(), links.height(), Pixel()) {}

  void AddSource(int u, int v, float reach) {
    nearest_(u, v).squared = 0;
    nearest_(u, v).limit = static_cast<Value>(reach * reach);
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

  /// Squared distance; Pixel::kNone where no source reaches.
  Value Squared(int u, int v) const { return nearest_(u, v).squared; }

 private:
  // Takes the source of a neighbour, which lies (-step_u, -step_v) from the pixel.
  void Pull(int u, int v, const Pixel& neighbour, int step_u, int step_v) {
    Pixel& pixel = nearest_(u, v);
    if (neighbour.squared >= pixel.squared) return;
    const int du = Metric::Offset(neighbour.du, step_u);
    const int dv = Metric::Offset(neighbour.dv, step_v);
    const Value squared = metric_.Squared(u, v, du, dv);
    if (squared >= pixel.squared || squared > neighbour.limit) return;
    pixel = {squared, neighbour.limit, static_cast<int16_t>(du), static_cast<int16_t>(dv)};
  }

  void PullFromAbove(int v) {
    const int width = links_.width();
    const uint8_t* links = links_.row(v - 1);
    const Pixel* above = nearest_.row(v - 1);
    for (int u = 0; u < width; ++u) {
      if (nearest_(u, v).squared == 0) continue;
      if (links[u] & kDown) Pull(u, v, above[u], 0, 1);
      if (u > 0 && links[u - 1] & kDownRight) Pull(u, v, above[u - 1], 1, 1);
      if (u + 1 < width && links[u + 1] & kDownLeft) Pull(u, v, above[u + 1], -1, 1);
    }
  }

  void PullFromBelow(int v) {
    const int width = links_.width();
    const uint8_t* links = links_.row(v);
    const Pixel* below = nearest_.row(v + 1);
    for (int u = 0; u < width; ++u) {
      if (nearest_(u, v).squared == 0) continue;
      if (links[u] & kDown) Pull(u, v, below[u], 0, -1);
      if (links[u] & kDownRight) Pull(u, v, below[u + 1], -1, -1);
      if (links[u] & kDownLeft) Pull(u, v, below[u - 1], 1, -1);
    }
  }

  void SweepRow(int v) {
    const uint8_t* links = links_.row(v);
    Pixel* row = nearest_.row(v);
    for (int u = 1; u < links_.width(); ++u) {
      if (links[u - 1] & kRight) Pull(u, v, row[u - 1], 1, 0);
    }
    for (int u = links_.width() - 2; u >= 0; --u) {
      if (links[u] & kRight) Pull(u, v, row[u + 1], -1, 0);
    }
  }

  const Image<uint8_t>& links_;
  const Metric& metric_;
  Image<Pixel> nearest_;
};

float LeastDepth(const DepthImage& depth) {
  float least = std::numeric_limits<float>::infinity();
  for (size_t i = 0; i < depth.size(); ++i) {
    if (depth.data()[i] > 0) least = std::min(least, depth.data()[i]);
  }
  return least;
}

// Takes from `eroded` what lies within the radius of a source pixel of the same surface.
template <class Metric, typename IsSource>
void ErodeFrom(const IsSource& is_source, const DepthImage& depth, const Image<uint8_t>& links,
               const Metric& metric, double radius, MaskImage& eroded) {
  SurfaceDistance<Metric> to_source(links, metric);
  const float least = LeastDepth(depth);
  const float greatest_reach = metric.Reach(radius, least) + metric.Pixel(least);
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
      const float z = depth(u, v);
      const float reach = std::max(0.0f, metric.Reach(radius, z) - 0.5f * metric.Pixel(z));
      eroded(u, v) = static_cast<float>(to_source.Squared(u, v)) >= reach * reach;
    }
  }
}

// 1 where a disc of the radius around the pixel keeps within its surface, and one of half the
// radius within what nothing was seen through: lone solid places of a grille go.
template <class Metric>
MaskImage Erode(const DepthImage& depth, const DepthImage& solidity, const Image<uint8_t>& links,
                const Metric& metric, const DepthOpeningOptions& options) {
  MaskImage eroded(depth.width(), depth.height(), 0);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) eroded(u, v) = depth(u, v) > 0;
  }
  const auto is_edge = [&](int u, int v) { return (links(u, v) & kNearEdge) != 0; };
  ErodeFrom(is_edge, depth, links, metric, options.radius, eroded);
  if (solidity.size() == 0) return eroded;
  const auto is_open = [&](int u, int v) { return solidity(u, v) < options.min_solidity; };
  ErodeFrom(is_open, depth, links, metric, options.radius / 2, eroded);
  return eroded;
}

// The pixels of the rendering within the discs around what erosion left. Erosion and dilation
// together round by up to one pixel where an edge runs obliquely.
template <class Metric>
DepthImage DilateBack(const DepthImage& depth, const Image<uint8_t>& links, const Metric& metric,
                      double radius, const MaskImage& eroded) {
  SurfaceDistance<Metric> to_eroded(links, metric);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!eroded(u, v)) continue;
      const float z = depth(u, v);
      to_eroded.AddSource(u, v, metric.Reach(radius, z) + metric.Pixel(z));
    }
  }
  to_eroded.Propagate();
  DepthImage opened(depth.width(), depth.height(), 0);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (to_eroded.Squared(u, v) != SurfaceDistance<Metric>::Pixel::kNone) {
        opened(u, v) = depth(u, v);
      }
    }
  }
  return opened;
}

template <class Metric>
DepthImage Open(const DepthImage& rendering, const PinholeCamera& camera,
                const DepthImage& solidity, const DepthOpeningOptions& options) {
  const SurfaceLinks surface(rendering, camera, options);
  const Metric metric(rendering, camera);
  const MaskImage eroded = Erode(rendering, solidity, surface.links(), metric, options);
  return DilateBack(rendering, surface.links(), metric, options.radius, eroded);
}

}  // namespace

DepthImage OpenDepth(const DepthImage& rendering, const PinholeCamera& camera,
                     const DepthImage& solidity, const DepthOpeningOptions& options) {
  if (rendering.width() != camera.width || rendering.height() != camera.height) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("depth rendering of {} x {} pixels does not fit its camera of {} x {}",
                            rendering.width(), rendering.height(), camera.width, camera.height));
  }
  assert(solidity.size() == 0 || solidity.size() == rendering.size());
  return options.on_surface ? Open<SpaceMetric>(rendering, camera, solidity, options)
                            : Open<ImageMetric>(rendering, camera, solidity, options);
}

}  // namespace curvefusion
