#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace curvefusion {

/// A tree of boxes for questions about which of them overlap or touch; split at medians, so boxes
/// may be of any size. Building takes O(n log n), an answer is near-linear in boxes asked for and
/// pairs, and found in parallel.
class BoxTree {
 public:
  using Box = Eigen::AlignedBox3d;
  using Pairs = std::vector<std::pair<int, int>>;
  /// Takes those away that do not count from some pairs of boxes that overlap; called in parallel,
  /// for all pairs some thousand at a time. None: all count.
  using Filter = std::function<void(Pairs& pairs)>;

  explicit BoxTree(const std::vector<Box>& boxes = {});

  /// All pairs (i < j, ascending) of boxes that overlap and pass the filter.
  Pairs OverlappingPairs(const Filter& filter = nullptr) const;

  /// All pairs (i, j), ascending, of a box i of the tree and a box j of others that overlap and
  /// pass the filter.
  Pairs OverlappingPairs(const std::vector<Box>& others, const Filter& filter = nullptr) const;

 private:
  struct Entry;
  void Sort(std::vector<Entry>& entries, size_t first_leaf, size_t last_leaf) const;
  void BoundNodes();
  size_t FirstOf(size_t leaf) const;
  template <class Visit>
  void VisitPairsWithin(size_t node, const Visit& visit) const;
  template <class Visit>
  void VisitPairsBetween(size_t a, size_t b, const Visit& visit) const;
  template <class Visit>
  void VisitOverlapping(const Box& box, const Visit& visit) const;
  template <class Visit>
  void VisitLeaf(size_t leaf, size_t first, const Box& box, const Visit& visit) const;

  size_t leaves_ = 1;         // a power of two
  std::vector<int> numbers_;  // of boxes, in the order of the leaves
  std::vector<Box> boxes_;    // in the same order
  std::vector<Box> nodes_;  // the children of node i are 2 i and 2 i + 1, the root is 1; leaf k is
                            // node leaves_ + k
};

/// All pairs (i < j, ascending) of boxes that overlap or touch, by a BoxTree.
BoxTree::Pairs OverlappingBoxes(const std::vector<BoxTree::Box>& boxes);

}  // namespace curvefusion
