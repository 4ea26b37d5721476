#include "kernel/box_pairs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "kernel/geometry.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

using Box = Eigen::AlignedBox3d;
using Pairs = std::vector<std::pair<int, int>>;

// Boxes in a leaf: few enough to compare each with each.
constexpr size_t kBoxesPerLeaf = 6;
// Leaves or boxes in a chunk of parallel work.
constexpr int64_t kLeavesPerChunk = 256;
constexpr int64_t kBoxesPerChunk = 4096;

struct Entry {
  Vec3 centre;
  int box;
};

Vec3 CentreOf(const Box& box) {
  const Vec3 centre = 0.5 * box.min() + 0.5 * box.max();
  // A box from minus to plus infinity has no centre.
  return centre.array().isNaN().select(0.0, centre);
}

int LongestAxis(const Entry* first, const Entry* last) {
  Box box;
  for (; first != last; ++first) box.extend(first->centre);
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  return axis;
}

// A balanced binary tree of boxes. The children of node i are 2 i and 2 i + 1, the root is 1; leaf
// k is node leaves + k.
class BoxTree {
 public:
  // Of those boxes that are named.
  BoxTree(const std::vector<Box>& boxes, const std::vector<int>& named) {
    while (kBoxesPerLeaf * leaves_ < named.size()) leaves_ *= 2;
    entries_.reserve(named.size());
    for (const int i : named) entries_.push_back({CentreOf(boxes[i]), i});
    Sort(0, leaves_);
    boxes_.reserve(named.size());
    for (const Entry& entry : entries_) boxes_.push_back(boxes[entry.box]);
    BoundNodes();
  }

  int64_t leaf_count() const { return static_cast<int64_t>(leaves_); }

  // Calls visit(i, j) for the pairs of the boxes of a leaf with each other and with those behind
  // it.
  template <class Visit>
  void VisitPairsOf(int64_t leaf, const Visit& visit) const {
    const auto own = static_cast<size_t>(leaf);
    VisitLeaves(own, nodes_[leaves_ + own], [&](size_t other) {
      for (size_t a = FirstOf(own); a < FirstOf(own + 1); ++a)
        VisitLeaf(other, leaf == static_cast<int64_t>(other) ? a + 1 : FirstOf(other), boxes_[a],
                  [&](int j) { visit(entries_[a].box, j); });
    });
  }

  // Calls visit(j) for the boxes that overlap a box.
  template <class Visit>
  void VisitOverlapping(const Box& box, const Visit& visit) const {
    VisitLeaves(0, box, [&](size_t leaf) { VisitLeaf(leaf, FirstOf(leaf), box, visit); });
  }

 private:
  // Leaves share the entries evenly.
  size_t FirstOf(size_t leaf) const { return leaf * entries_.size() / leaves_; }

  // Sorts entries into leaves, from one level of the tree to the next.
  void Sort(size_t first_leaf, size_t last_leaf) {
    if (last_leaf - first_leaf < 2) return;
    const size_t middle_leaf = (first_leaf + last_leaf) / 2;
    Entry* first = entries_.data() + FirstOf(first_leaf);
    Entry* middle = entries_.data() + FirstOf(middle_leaf);
    Entry* last = entries_.data() + FirstOf(last_leaf);
    const int axis = LongestAxis(first, last);
    std::nth_element(first, middle, last, [axis](const Entry& a, const Entry& b) {
      return a.centre[axis] < b.centre[axis];
    });
    Sort(first_leaf, middle_leaf);
    Sort(middle_leaf, last_leaf);
  }

  void BoundNodes() {
    nodes_.resize(2 * leaves_);
    for (size_t leaf = 0; leaf < leaves_; ++leaf)
      for (size_t i = FirstOf(leaf); i < FirstOf(leaf + 1); ++i)
        nodes_[leaves_ + leaf].extend(boxes_[i]);
    for (size_t i = leaves_ - 1; i > 0; --i) nodes_[i] = nodes_[2 * i].merged(nodes_[2 * i + 1]);
  }

  // Calls visit(leaf) for the leaves from a first one on that overlap a box.
  template <class Visit>
  void VisitLeaves(size_t first_leaf, const Box& box, const Visit& visit) const {
    std::array<size_t, 64> open;  // one node for each level at most, and two of the last
    size_t count = 0;
    open[count++] = 1;
    while (count > 0) {
      const size_t i = open[--count];
      if (!box.intersects(nodes_[i])) continue;
      if (i >= leaves_) {
        visit(i - leaves_);
        continue;
      }
      open[count++] = 2 * i + 1;
      if (LastLeafBelow(2 * i) >= first_leaf) open[count++] = 2 * i;
    }
  }

  size_t LastLeafBelow(size_t node) const {
    const int levels = std::countl_zero(node) - std::countl_zero(leaves_);
    return ((node + 1) << levels) - 1 - leaves_;
  }

  // The boxes of a leaf from a position on.
  template <class Visit>
  void VisitLeaf(size_t leaf, size_t first, const Box& box, const Visit& visit) const {
    if (!box.intersects(nodes_[leaves_ + leaf])) return;
    for (size_t i = first; i < FirstOf(leaf + 1); ++i)
      if (box.intersects(boxes_[i])) visit(entries_[i].box);
  }

  size_t leaves_ = 1;           // a power of two
  std::vector<Entry> entries_;  // in the order of the leaves
  std::vector<Box> boxes_;      // in the same order
  std::vector<Box> nodes_;
};

// Calls add(index, part) for all indices in parallel, with one part for each chunk of them, and
// appends all parts, one after the other.
template <class Add>
void AppendInParallel(int64_t count, int64_t grain, const Add& add, Pairs& pairs) {
  std::vector<Pairs> parts((count + grain - 1) / grain);
  ParallelChunks(0, count, grain, [&](int64_t first, int64_t last) {
    for (int64_t i = first; i < last; ++i) add(i, parts[first / grain]);
  });
  for (const Pairs& part : parts) pairs.insert(pairs.end(), part.begin(), part.end());
}

}  // namespace

Pairs OverlappingBoxes(const std::vector<Box>& boxes, const BoxPairFilter& filter) {
  std::vector<int> marked, others;
  for (size_t i = 0; i < boxes.size(); ++i)
    (filter.marks.empty() || filter.marks[i] ? marked : others).push_back(static_cast<int>(i));
  Pairs pairs;
  if (marked.empty()) return pairs;
  const auto add = [&filter](int i, int j, Pairs& part) {
    if (i > j) std::swap(i, j);
    if (!filter.keep || filter.keep(i, j)) part.emplace_back(i, j);
  };
  const BoxTree tree(boxes, marked);
  AppendInParallel(
      tree.leaf_count(), kLeavesPerChunk,
      [&](int64_t leaf, Pairs& part) {
        tree.VisitPairsOf(leaf, [&](int i, int j) { add(i, j, part); });
      },
      pairs);
  AppendInParallel(
      static_cast<int64_t>(others.size()), kBoxesPerChunk,
      [&](int64_t k, Pairs& part) {
        const int i = others[static_cast<size_t>(k)];
        tree.VisitOverlapping(boxes[i], [&](int j) { add(i, j, part); });
      },
      pairs);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace curvefusion
