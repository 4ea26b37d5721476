#include "fusion/curve_graph/candidate_proof.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "fusion/curve_graph/refuted_parts.h"
#include "fusion/curve_graph/stretch_evidence.h"
#include "fusion/curve_graph/wire_proof.h"
#include "graph/edge_parts.h"

namespace curvefusion {

namespace {

// Chosen on training scans chair (the paper's, seed 4) and rack 2 (docs/lab_notebook.md): true
// stretches have .5 and .036 in the median, false ones 0 and .014.
constexpr double kMinColourLogOdds = 0.2;
constexpr double kMinMiddleEvidence = 0.03;  // of an image that shows a strip
constexpr double kMinLooks = 8;              // images that no other curve explains, in the mean
constexpr double kMinSupport = 0.6;          // share of these that show a strip
constexpr double kMinPiece = 0.012;          // metres; the shortest spur

// What images tell of points [first, last] of a curve, sums over the points.
struct Support {
  double looked = 0, seen = 0, middle_evidence = 0;
};

Support SupportOf(const StripViews& views, const Polyline& points, const EdgePart& part) {
  Support support;
  for (size_t i = part.first; i <= part.last; ++i) {
    const Vec3& before = points[i > 0 ? i - 1 : 0];
    const Vec3& behind = points[std::min(i + 1, points.size() - 1)];
    const StripAgreement look = views.Along(points[i], (behind - before).normalized());
    support.looked += look.looked;
    support.seen += look.seen;
    support.middle_evidence += look.middle_evidence;
  }
  return support;
}

bool IsMostlyFree(const StripViews& views, const Polyline& points, const EdgePart& part) {
  size_t free = 0;
  for (size_t i = part.first; i <= part.last; ++i) free += views.IsFree(points[i]);
  return 2 * free > part.last - part.first + 1;
}

bool IsOpen(const StripViews& views, const StretchEvidence& stretch, const Polyline& points) {
  if (IsMostlyFree(views, points, stretch.part)) return true;
  if (ColourLogOdds(stretch) <= kMinColourLogOdds) return false;
  const Support support = SupportOf(views, points, stretch.part);
  return support.middle_evidence > kMinMiddleEvidence * support.seen;
}

void KeepOpenStretches(const Sequence& sequence, const StripViews& views, SkeletonGraph& curves) {
  std::map<EdgeId, std::vector<EdgePart>> kept;
  for (const EdgeId id : curves.Edges()) kept[id];
  for (const StretchEvidence& stretch : CollectEvidence(curves, {}, sequence, 0)) {
    if (!IsOpen(views, stretch, curves.edge(stretch.edge).points)) continue;
    std::vector<EdgePart>& parts = kept[stretch.edge];
    if (!parts.empty() && parts.back().last == stretch.part.first) {
      parts.back().last = stretch.part.last;
    } else {
      parts.push_back(stretch.part);
    }
  }
  for (const auto& [id, parts] : kept) KeepParts(id, parts, kMinPiece, curves);
  curves.RemoveIsolatedNodes();
}

void ExplainAway(double radius, StripViews& views, SkeletonGraph& curves) {
  const auto support_of = [&](EdgeId id) {
    const Polyline& points = curves.edge(id).points;
    return SupportOf(views, points, {0, points.size() - 1});
  };
  std::vector<std::pair<double, EdgeId>> by_evidence;
  for (const EdgeId id : curves.Edges())
    by_evidence.emplace_back(-support_of(id).middle_evidence, id);
  std::sort(by_evidence.begin(), by_evidence.end());
  for (const auto& [evidence, id] : by_evidence) {
    const Support support = support_of(id);
    const Polyline& points = curves.edge(id).points;
    const bool is_supported = support.looked >= kMinLooks * static_cast<double>(points.size()) &&
                              support.seen >= kMinSupport * support.looked &&
                              support.middle_evidence > 0;
    if (is_supported) {
      views.Explain(points, std::vector<double>(points.size(), radius));
    } else {
      curves.RemoveEdge(id);
    }
  }
  curves.RemoveIsolatedNodes();
}

}  // namespace

void KeepProvenCandidates(const Sequence& sequence, double radius, StripViews& views,
                          SkeletonGraph& curves) {
  DropRefutedParts([&views](const Polyline& points) { return views.SharesAlong(points); },
                   kMinStripShare, {}, curves);
  if (curves.empty()) return;
  KeepOpenStretches(sequence, views, curves);
  ExplainAway(radius, views, curves);
}

}  // namespace curvefusion
