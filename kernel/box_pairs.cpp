#include "kernel/box_pairs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "kernel/geometry.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Boxes in a leaf: few enough to compare each with each.
constexpr size_t kBoxesPerLeaf = 6;
// Leaves or boxes in a chunk of parallel work.
constexpr size_t kLeavesPerNode = 256;
constexpr int64_t kBoxesPerChunk = 4096;
// Pairs that are filtered together: few enough to stay in the nearest cache.
constexpr size_t kPairsPerBatch = 2048;

Vec3 CentreOf(const BoxTree::Box& box) {
  const Vec3 centre = 0.5 * box.min() + 0.5 * box.max();
  // A box from minus to plus infinity has no centre.
  return centre.array().isNaN().select(0.0, centre);
}

// Whether boxes overlap or touch. All six comparisons cost less than guessing which of them
// decides.
bool Overlap(const BoxTree::Box& a, const BoxTree::Box& b) {
  const double* const low_a = a.min().data();
  const double* const high_a = a.max().data();
  const double* const low_b = b.min().data();
  const double* const high_b = b.max().data();
  int overlaps = 1;
  for (int i = 0; i < 3; ++i)
    overlaps &= static_cast<int>(low_a[i] <= high_b[i]) & static_cast<int>(low_b[i] <= high_a[i]);
  return overlaps != 0;
}

// Pairs on their way through a filter.
class FilteredPairs {
 public:
  explicit FilteredPairs(const BoxTree::Filter& filter) : filter_(filter) {
    batch_.reserve(kPairsPerBatch);
  }

  void Add(int i, int j) {
    batch_.emplace_back(i, j);
    if (batch_.size() == kPairsPerBatch) Flush();
  }

  BoxTree::Pairs Take() {
    Flush();
    return std::move(passed_);
  }

 private:
  void Flush() {
    if (filter_) filter_(batch_);
    passed_.insert(passed_.end(), batch_.begin(), batch_.end());
    batch_.clear();
  }

  const BoxTree::Filter& filter_;
  BoxTree::Pairs batch_;
  BoxTree::Pairs passed_;
};

// Calls add(index, pairs) for all indices in parallel, chunk by chunk of them; what passes the
// filter, ascending.
template <class Add>
BoxTree::Pairs CollectInParallel(int64_t count, int64_t grain, const BoxTree::Filter& filter,
                                 const Add& add) {
  std::vector<BoxTree::Pairs> parts((count + grain - 1) / grain);
  ParallelChunks(0, count, grain, [&](int64_t first, int64_t last) {
    FilteredPairs pairs(filter);
    for (int64_t i = first; i < last; ++i) add(static_cast<size_t>(i), pairs);
    parts[first / grain] = pairs.Take();
  });
  size_t passed = 0;
  for (const BoxTree::Pairs& part : parts) passed += part.size();
  BoxTree::Pairs pairs;
  pairs.reserve(passed);
  for (const BoxTree::Pairs& part : parts) pairs.insert(pairs.end(), part.begin(), part.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

// A box while the tree is sorted, by its centre seen from that of the first box: where rounding
// puts it decides nothing but the shape of the tree.
struct BoxTree::Entry {
  Vec3f centre;
  int box;
};

BoxTree::BoxTree(const std::vector<Box>& boxes) {
  while (kBoxesPerLeaf * leaves_ < boxes.size()) leaves_ *= 2;
  std::vector<Entry> entries;
  entries.reserve(boxes.size());
  for (size_t i = 0; i < boxes.size(); ++i)
    entries.push_back(
        {(CentreOf(boxes[i]) - CentreOf(boxes[0])).cast<float>(), static_cast<int>(i)});
  numbers_.resize(boxes.size());
  Sort(entries, 0, leaves_);
  boxes_.reserve(boxes.size());
  for (size_t i = 0; i < entries.size(); ++i) {
    numbers_[i] = entries[i].box;
    boxes_.push_back(boxes[entries[i].box]);
  }
  BoundNodes();
}

// Leaves share the entries evenly.
size_t BoxTree::FirstOf(size_t leaf) const {
  return (leaf * numbers_.size()) >> std::countr_zero(leaves_);
}

// Sorts entries into leaves, from one level of the tree to the next.
void BoxTree::Sort(std::vector<Entry>& entries, size_t first_leaf, size_t last_leaf) const {
  if (last_leaf - first_leaf < 2) return;
  const size_t middle_leaf = (first_leaf + last_leaf) / 2;
  Entry* first = entries.data() + FirstOf(first_leaf);
  Entry* middle = entries.data() + FirstOf(middle_leaf);
  Entry* last = entries.data() + FirstOf(last_leaf);
  Eigen::AlignedBox3f centres;
  for (const Entry* entry = first; entry != last; ++entry) centres.extend(entry->centre);
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  std::nth_element(first, middle, last, [axis](const Entry& a, const Entry& b) {
    return a.centre[axis] < b.centre[axis];
  });
  Sort(entries, first_leaf, middle_leaf);
  Sort(entries, middle_leaf, last_leaf);
}

void BoxTree::BoundNodes() {
  nodes_.resize(2 * leaves_);
  for (size_t leaf = 0; leaf < leaves_; ++leaf)
    for (size_t i = FirstOf(leaf); i < FirstOf(leaf + 1); ++i)
      nodes_[leaves_ + leaf].extend(boxes_[i]);
  for (size_t i = leaves_ - 1; i > 0; --i) nodes_[i] = nodes_[2 * i].merged(nodes_[2 * i + 1]);
}

// Calls visit(i, j) for the pairs of boxes below a node that overlap.
template <class Visit>
void BoxTree::VisitPairsWithin(size_t node, const Visit& visit) const {
  if (node < leaves_) {
    VisitPairsWithin(2 * node, visit);
    VisitPairsWithin(2 * node + 1, visit);
    VisitPairsBetween(2 * node, 2 * node + 1, visit);
    return;
  }
  const size_t leaf = node - leaves_;
  for (size_t a = FirstOf(leaf); a < FirstOf(leaf + 1); ++a)
    VisitLeaf(leaf, a + 1, boxes_[a], [&](int j) { visit(numbers_[a], j); });
}

// Calls visit(i, j) for the boxes i below one node and j below another that overlap.
template <class Visit>
void BoxTree::VisitPairsBetween(size_t a, size_t b, const Visit& visit) const {
  if (!Overlap(nodes_[a], nodes_[b])) return;
  if (a < leaves_ && std::bit_width(a) <= std::bit_width(b)) {
    VisitPairsBetween(2 * a, b, visit);
    VisitPairsBetween(2 * a + 1, b, visit);
  } else if (b < leaves_) {
    VisitPairsBetween(a, 2 * b, visit);
    VisitPairsBetween(a, 2 * b + 1, visit);
  } else {
    const size_t leaf = a - leaves_;
    for (size_t i = FirstOf(leaf); i < FirstOf(leaf + 1); ++i)
      VisitLeaf(b - leaves_, FirstOf(b - leaves_), boxes_[i],
                [&](int j) { visit(numbers_[i], j); });
  }
}

// Calls visit(i) for the boxes that overlap another one.
template <class Visit>
void BoxTree::VisitOverlapping(const Box& box, const Visit& visit) const {
  std::array<size_t, 64> open;  // one node for each level at most, and two of the last
  size_t count = 0;
  open[count++] = 1;
  while (count > 0) {
    const size_t node = open[--count];
    if (!Overlap(box, nodes_[node])) continue;
    if (node >= leaves_) {
      VisitLeaf(node - leaves_, FirstOf(node - leaves_), box, visit);
    } else {
      open[count++] = 2 * node + 1;
      open[count++] = 2 * node;
    }
  }
}

// Calls visit(i) for the boxes of a leaf from a position on that overlap a box.
template <class Visit>
void BoxTree::VisitLeaf(size_t leaf, size_t first, const Box& box, const Visit& visit) const {
  for (size_t i = first; i < FirstOf(leaf + 1); ++i)
    if (Overlap(box, boxes_[i])) visit(numbers_[i]);
}

BoxTree::Pairs BoxTree::OverlappingPairs(const Filter& filter) const {
  // In parallel over the nodes of one level, each with those behind it: the right brothers of the
  // nodes on the way up that are left ones.
  const size_t nodes = std::max<size_t>(1, leaves_ / kLeavesPerNode);
  const auto add = [&](size_t number, FilteredPairs& pairs) {
    const auto visit = [&](int i, int j) { pairs.Add(std::min(i, j), std::max(i, j)); };
    const size_t node = nodes + number;
    VisitPairsWithin(node, visit);
    for (size_t above = node; above > 1; above /= 2)
      if (above % 2 == 0) VisitPairsBetween(node, above + 1, visit);
  };
  return CollectInParallel(static_cast<int64_t>(nodes), 1, filter, add);
}

BoxTree::Pairs BoxTree::OverlappingPairs(const std::vector<Box>& others,
                                         const Filter& filter) const {
  const auto add = [&](size_t other, FilteredPairs& pairs) {
    VisitOverlapping(others[other], [&](int i) { pairs.Add(i, static_cast<int>(other)); });
  };
  return CollectInParallel(static_cast<int64_t>(others.size()), kBoxesPerChunk, filter, add);
}

BoxTree::Pairs OverlappingBoxes(const std::vector<BoxTree::Box>& boxes) {
  return BoxTree(boxes).OverlappingPairs();
}

}  // namespace curvefusion
