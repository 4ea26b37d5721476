#pragma once

#include <cstddef>
#include <vector>

#include "capture/content/edge_distance.h"
#include "capture/sequence.h"

namespace curvefusion {

/// Focal length, centre (px) and offset to the depth camera (metres) of a colour camera.
using ColourParameters = Eigen::Matrix<double, 5, 1>;
enum ColourParameter { kF, kCx, kCy, kTx, kTy };

/// A place on a depth edge, in the orientation of the colour camera.
struct EdgePoint {
  Vec3 position;
  int direction = 0;  ///< EdgeDistance::DirectionOf its normal
  int frame = 0;      ///< in EdgeEvidence::distances
};

/// Depth edges of some frames, and the distances to the edges of their colour images.
struct EdgeEvidence {
  PinholeCamera given_camera;
  RigidTransform T_color_depth;  ///< given
  std::vector<EdgePoint> points;
  std::vector<EdgeDistance> distances;  ///< by frame
  double scale = 1;                     ///< pixels of the image in one of a 640 px wide image

  ColourParameters Given() const;
  /// Height over width of a pixel in focal lengths, fy / fx.
  double aspect() const { return given_camera.fy / given_camera.fx; }
  /// Depth of a point in the colour camera.
  double Depth(const EdgePoint& point) const;
  /// Where a colour camera sees a point.
  Vec2 Project(const ColourParameters& x, const EdgePoint& point) const;
};

/// Indices of points.
using EdgeSelection = std::vector<size_t>;

/// Of at most `max_frames` evenly spread frames, in parallel; images that cannot be read and frames
/// without depth edges are left out.
EdgeEvidence GatherEdgeEvidence(const Sequence& sequence, int max_frames, int points_per_frame);

/// exp(-d^2 / 2 sigma^2).
double Closeness(double distance, double sigma);

/// The mean closeness of points to colour edges. Points outside the image do not count as long as
/// seven tenths are inside.
double EdgeShare(const EdgeEvidence& evidence, const ColourParameters& x,
                 const EdgeSelection& selection, double sigma);

/// The mean distance of all points to colour edges, in pixels of a 640 px wide image.
double MeanEdgeDistance(const EdgeEvidence& evidence, const ColourParameters& x);

/// How far apart two cameras see the points in the mean, in pixels of a 640 px wide image.
double Displacement(const EdgeEvidence& evidence, const ColourParameters& a,
                    const ColourParameters& b);

/// The median depth of the points in metres. Precondition: there are some.
double MedianEdgeDepth(const EdgeEvidence& evidence);

}  // namespace curvefusion
