#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <utility>
#include <vector>

namespace curvefusion {

/// Which pairs of overlapping boxes are wanted; all of them as it stands.
struct BoxPairFilter {
  /// Of each box, whether it must be looked at: a pair counts if either of its boxes is marked.
  /// Empty: all are. Boxes without a mark cost little.
  std::vector<char> marks = {};
  /// Whether a pair (i < j) of boxes that overlap counts; called in parallel. Empty: all do.
  std::function<bool(int i, int j)> keep = nullptr;
};

/// All pairs (i < j, ascending) of boxes that overlap or touch and pass the filter. By a tree of
/// boxes, split at medians, in parallel: near-linear in boxes and pairs for boxes of any size, with
/// O(m log m) for the tree of the m marked boxes. Memory O(n + pairs that pass).
std::vector<std::pair<int, int>> OverlappingBoxes(const std::vector<Eigen::AlignedBox3d>& boxes,
                                                  const BoxPairFilter& filter = {});

}  // namespace curvefusion
