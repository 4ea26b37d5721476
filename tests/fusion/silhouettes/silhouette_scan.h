#pragma once

#include <filesystem>
#include <vector>

#include "fusion/curve_graph/refuted_parts.h"
#include "fusion/curve_graph/strip_views.h"
#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// A wire of 5 mm for tests.
inline constexpr double kTestRadius = 0.0025;

/// Silhouettes of wires of 5 mm around the origin, seen by 24 cameras .6 m away, spread over 80
/// degrees and 40 degrees, or a share of that. A plate is wire-coloured all over. Depth images show
/// nothing, or something `depth` metres away everywhere.
class SilhouetteScan {
 public:
  explicit SilhouetteScan(const std::vector<Polyline>& wires,
                          const std::vector<std::vector<Vec3>>& plates = {}, double depth = 0,
                          double spread = 1);
  ~SilhouetteScan();
  SilhouetteScan(const SilhouetteScan&) = delete;
  SilhouetteScan& operator=(const SilhouetteScan&) = delete;

  const Sequence& sequence() const { return sequence_; }
  WireSilhouettes Silhouettes() const;

  /// The share of the silhouettes that show a curve.
  SharesOfCurve Shares() const;

  /// Strips of the same images in colour, dark wires before something bright, around these curves,
  /// which explain theirs, and `around`.
  StripViews Strips(const SkeletonGraph& known, const Eigen::AlignedBox3d& around = {}) const;

 private:
  std::filesystem::path folder_;
  Sequence sequence_;
  std::vector<int> frames_;
  std::vector<PosteriorImage> posteriors_;
};

/// Points every 2 mm from a to b.
Polyline TestLine(const Vec3& a, const Vec3& b);

/// Adds an edge with the radius of the test wires.
EdgeId AddTestEdge(SkeletonGraph& graph, NodeId a, NodeId b, Polyline points);
EdgeId AddTestEdge(SkeletonGraph& graph, Polyline points);

}  // namespace curvefusion
