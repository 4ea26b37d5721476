#include "tests/graph/resolved_pieces.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "kernel/disjoint_sets.h"
#include "kernel/polyline.h"

namespace curvefusion {
namespace {

// A segment and the number of what hangs together with it.
struct Member {
  Segment segment;
  int piece;
  Eigen::AlignedBox3d box;

  double Length() const { return (segment.b - segment.a).norm(); }
  double ParameterOf(const Vec3& p) const { return ClosestParameter(segment.a, segment.b, p); }
  Vec3 At(double parameter) const { return segment.a + parameter * (segment.b - segment.a); }
  double DistanceOf(const Vec3& p) const { return (At(ParameterOf(p)) - p).norm(); }
};

std::vector<Member> MembersOf(const SegmentTable& table, const std::vector<int>& pieces) {
  std::vector<Member> members;
  for (int k = 0; k < table.point_count(); ++k) {
    if (!table.IsSegment(k)) continue;
    const Segment s = table.At(k);
    members.push_back({s, pieces[table.curve_of[k]], {s.a.cwiseMin(s.b), s.a.cwiseMax(s.b)}});
  }
  return members;
}

bool AreNear(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double distance) {
  return a.exteriorDistance(b) <= distance;
}

// Parts of a segment that others cover, in metres from its front.
class Coverage {
 public:
  // Adds the part of a segment that runs along another within a distance: all of it does where its
  // ends do, as a segment is convex. Whether that is more than a touch.
  bool Add(const Member& covered, const Member& by, double distance) {
    const double from = covered.ParameterOf(by.segment.a);
    const double to = covered.ParameterOf(by.segment.b);
    if (by.DistanceOf(covered.At(from)) > distance || by.DistanceOf(covered.At(to)) > distance)
      return false;
    const double low = std::min(from, to) * covered.Length();
    const double high = std::max(from, to) * covered.Length();
    parts_.emplace_back(low, high);
    return high - low > 2 * distance;
  }

  // The longest part of [0, length] that none covers.
  double LongestGap(double length) {
    std::sort(parts_.begin(), parts_.end());
    double gap = 0;
    double covered = 0;
    for (const auto& [low, high] : parts_) {
      gap = std::max(gap, low - covered);
      covered = std::max(covered, high);
    }
    return std::max(gap, length - covered);
  }

 private:
  std::vector<std::pair<double, double>> parts_;
};

// Which pieces of a graph and components of what it was resolved to are at the same places.
class PieceComparison {
 public:
  PieceComparison(std::vector<Member> given, std::vector<Member> resolved, double bound)
      : given_(std::move(given)), resolved_(std::move(resolved)), bound_(bound) {}

  std::string Difference() {
    std::string difference = DifferenceOfPoints();
    if (difference.empty()) difference = DifferenceOfPieces();
    return difference;
  }

 private:
  std::string DifferenceOfPoints() {
    std::vector<Coverage> given_covered(given_.size());
    std::vector<Coverage> resolved_covered(resolved_.size());
    for (size_t i = 0; i < given_.size(); ++i) {
      for (size_t j = 0; j < resolved_.size(); ++j) {
        const Member& g = given_[i];
        const Member& r = resolved_[j];
        if (!AreNear(g.box, r.box, bound_)) continue;
        resolved_covered[j].Add(r, g, bound_);
        if (!given_covered[i].Add(g, r, bound_)) continue;
        components_of_[g.piece].insert(r.piece);
        pieces_of_[r.piece].insert(g.piece);
      }
    }
    std::string difference = FirstGap(given_, given_covered, "was there before");
    if (difference.empty()) difference = FirstGap(resolved_, resolved_covered, "is there now");
    return difference;
  }

  std::string FirstGap(const std::vector<Member>& members, std::vector<Coverage>& covered,
                       const char* when) const {
    for (size_t i = 0; i < members.size(); ++i) {
      const double gap = covered[i].LongestGap(members[i].Length());
      if (gap > 2 * bound_)
        return fmt::format("{} m of a segment of {} m only {}", gap, members[i].Length(), when);
    }
    return "";
  }

  // Pieces that rounding may make one, by the lowest.
  std::map<int, int> ClassesOfPieces() const {
    std::map<int, int> classes;
    int largest = 0;
    for (const Member& g : given_) largest = std::max(largest, g.piece);
    DisjointSets sets(static_cast<size_t>(largest) + 1);
    for (const Member& g : given_)
      for (const Member& h : given_)
        if (g.piece < h.piece && AreNear(g.box, h.box, 2 * bound_) &&
            AreWithin(g.segment, h.segment, 2 * bound_))
          sets.Unite(g.piece, h.piece);
    for (const Member& g : given_) classes[g.piece] = sets.Root(g.piece);
    return classes;
  }

  std::string DifferenceOfPieces() const {
    std::map<int, int> classes = ClassesOfPieces();
    std::map<int, std::set<int>> pieces_in;
    std::map<int, std::set<int>> components_in;
    for (const auto& [piece, components] : components_of_) {
      pieces_in[classes[piece]].insert(piece);
      components_in[classes[piece]].insert(components.begin(), components.end());
    }
    for (const auto& [component, pieces] : pieces_of_)
      for (const int piece : pieces)
        if (classes[piece] != classes[*pieces.begin()])
          return fmt::format("pieces {} and {} are joined that do not meet", *pieces.begin(),
                             piece);
    for (const auto& [number, components] : components_in)
      if (components.size() > pieces_in[number].size())
        return fmt::format("{} pieces with {} became {} components", pieces_in[number].size(),
                           number, components.size());
    return "";
  }

  std::vector<Member> given_;
  std::vector<Member> resolved_;
  double bound_;
  std::map<int, std::set<int>> components_of_;  // of each piece
  std::map<int, std::set<int>> pieces_of_;      // of each component
};

}  // namespace

std::vector<int> PiecesOf(const SegmentTable& table, const std::vector<SegmentPair>& contacts) {
  DisjointSets curves(table.curves.size());
  for (const SegmentPair& pair : contacts)
    curves.Unite(table.curve_of[pair.s], table.curve_of[pair.t]);
  std::map<NodeId, int> curve_of_node;
  for (int i = 0; i < table.curve_count(); ++i)
    for (const NodeId node : table.curves[i].nodes)
      curves.Unite(i, curve_of_node.try_emplace(node, i).first->second);
  std::vector<int> pieces;
  for (int i = 0; i < table.curve_count(); ++i) pieces.push_back(curves.Root(i));
  return pieces;
}

std::string DifferenceFromPieces(const SkeletonGraph& graph,
                                 const std::vector<SegmentPair>& contacts,
                                 const SkeletonGraph& resolved, double bound) {
  const SegmentTable given(graph);
  const SegmentTable left(resolved);
  return PieceComparison(MembersOf(given, PiecesOf(given, contacts)),
                         MembersOf(left, PiecesOf(left, {})), bound)
      .Difference();
}

}  // namespace curvefusion
