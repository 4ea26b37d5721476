#include "kernel/box_pairs.h"

#include <algorithm>
#include <array>
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
// Leaves in a chunk of parallel work, and boxes of a part of the tree that is built in one piece.
constexpr int64_t kLeavesPerChunk = 256;

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
  BoxTree(const std::vector<Box>& boxes, const BoxPairFilter& filter) : filter_(filter) {
    while (kBoxesPerLeaf * leaves_ < boxes.size()) leaves_ *= 2;
    entries_.reserve(boxes.size());
    for (size_t i = 0; i < boxes.size(); ++i)
      entries_.push_back({CentreOf(boxes[i]), static_cast<int>(i)});
    Sort(0, leaves_);
    boxes_.reserve(boxes.size());
    for (const Entry& entry : entries_) boxes_.push_back(boxes[entry.box]);
    BoundNodes();
  }

  Pairs FindPairs() const {
    const auto leaves = static_cast<int64_t>(leaves_);
    std::vector<Pairs> parts((leaves + kLeavesPerChunk - 1) / kLeavesPerChunk);
    ParallelChunks(0, leaves, kLeavesPerChunk, [&](int64_t first, int64_t last) {
      for (int64_t leaf = first; leaf < last; ++leaf)
        AddPairsOf(static_cast<size_t>(leaf), parts[first / kLeavesPerChunk]);
    });
    Pairs pairs;
    for (const Pairs& part : parts) pairs.insert(pairs.end(), part.begin(), part.end());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

 private:
  struct Node {
    Box box;
    bool is_marked = false;
  };

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

  bool IsMarked(size_t position) const {
    return filter_.marks.empty() || filter_.marks[entries_[position].box] != 0;
  }

  void BoundNodes() {
    nodes_.resize(2 * leaves_);
    for (size_t leaf = 0; leaf < leaves_; ++leaf) {
      Node& node = nodes_[leaves_ + leaf];
      for (size_t i = FirstOf(leaf); i < FirstOf(leaf + 1); ++i) {
        node.box.extend(boxes_[i]);
        node.is_marked = node.is_marked || IsMarked(i);
      }
    }
    for (size_t i = leaves_ - 1; i > 0; --i) {
      nodes_[i].box = nodes_[2 * i].box.merged(nodes_[2 * i + 1].box);
      nodes_[i].is_marked = nodes_[2 * i].is_marked || nodes_[2 * i + 1].is_marked;
    }
  }

  // The pairs of a leaf with itself and with those behind it.
  void AddPairsOf(size_t leaf, Pairs& pairs) const {
    const Node& own = nodes_[leaves_ + leaf];
    std::array<size_t, 64> open;  // one node for each level at most, and the last two
    size_t count = 0;
    open[count++] = 1;
    while (count > 0) {
      const size_t i = open[--count];
      const Node& node = nodes_[i];
      if (!(own.is_marked || node.is_marked) || !own.box.intersects(node.box)) continue;
      if (i >= leaves_) {
        AddPairsBetween(leaf, i - leaves_, pairs);
        continue;
      }
      open[count++] = 2 * i + 1;
      if (LastLeafBelow(2 * i) >= leaf) open[count++] = 2 * i;
    }
  }

  size_t LastLeafBelow(size_t node) const {
    while (node < leaves_) node = 2 * node + 1;
    return node - leaves_;
  }

  void AddPairsBetween(size_t leaf, size_t other, Pairs& pairs) const {
    for (size_t a = FirstOf(leaf); a < FirstOf(leaf + 1); ++a) {
      if (!boxes_[a].intersects(nodes_[leaves_ + other].box)) continue;
      for (size_t b = leaf == other ? a + 1 : FirstOf(other); b < FirstOf(other + 1); ++b) {
        if (!boxes_[a].intersects(boxes_[b]) || !(IsMarked(a) || IsMarked(b))) continue;
        const auto [i, j] = std::minmax(entries_[a].box, entries_[b].box);
        if (!filter_.keep || filter_.keep(i, j)) pairs.emplace_back(i, j);
      }
    }
  }

  const BoxPairFilter& filter_;
  size_t leaves_ = 1;           // a power of two
  std::vector<Entry> entries_;  // in the order of the leaves
  std::vector<Box> boxes_;      // in the same order
  std::vector<Node> nodes_;
};

}  // namespace

Pairs OverlappingBoxes(const std::vector<Box>& boxes, const BoxPairFilter& filter) {
  if (boxes.size() < 2) return {};
  return BoxTree(boxes, filter).FindPairs();
}

}  // namespace curvefusion
