#include "fusion/curve_graph/candidate_proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "fusion/curve_graph/refuted_parts.h"
#include "fusion/curve_graph/stretch_evidence.h"
#include "fusion/curve_graph/wire_proof.h"
#include "graph/edge_parts.h"
#include "kernel/point_grid.h"

namespace curvefusion {

namespace {

// Fitted: logistic regression over 2,461 stretches that lines of sight proposed in 24 training
// scans, 23 m of them wires and 58 m none (docs/wires_from_colour.md#coefficients).
constexpr double kBias = -1.76;
constexpr double kMiddles = 4.2;      // of how near strips' middles are, an image that shows one
constexpr double kFree = 7.1;         // more of it with free space behind
constexpr double kColour = 0.58;      // of the colours beside
constexpr double kPlaces = 1.53;      // of the logarithm of places a millimetre
constexpr double kFewPlaces = 0.05;   // chosen: a millimetre, added, as there may be none
constexpr double kNearPlace = 0.003;  // chosen: metres; what snapping moves curves by
// What is painted on a surface has sharp middles too. Chosen on training scans chair (the paper's,
// seed 4) and rack 2 (docs/lab_notebook.md): true stretches have .5 in the median, false ones 0.
constexpr double kMinColourLogOdds = 0.2;
constexpr double kMinSupport = 0.6;  // share of images that show a strip
// Of a wire that hangs together with no other: its places with free space behind them, and
// evidence of middles times metres. Chosen on 25 training scans (docs/lab_notebook.md).
constexpr double kMinFreeAlone = 0.9;
constexpr double kMinMiddleEvidenceAlone = 0.2;

// What images tell of a part of a curve, sums over its points.
struct Support {
  double looked = 0, seen = 0, middle_evidence = 0;
};

Support SupportOf(const std::vector<StripAgreement>& along, const EdgePart& part) {
  Support support;
  for (size_t i = part.first; i <= part.last; ++i) {
    support.looked += along[i].looked;
    support.seen += along[i].seen;
    support.middle_evidence += along[i].middle_evidence;
  }
  return support;
}

double FreeShare(const StripViews& views, const Polyline& points, const EdgePart& part) {
  return ShareOf(points, part, [&](const Vec3& p) { return views.IsFree(p); });
}

// How many places lie near a stretch, a millimetre.
double PlacesNear(const PointGrid& places, const Polyline& points, const EdgePart& part) {
  std::set<int> near;
  for (size_t i = part.first; i <= part.last; ++i) {
    places.ForEachWithin(points[i], kNearPlace,
                         [&near](int index, const Vec3&) { near.insert(index); });
  }
  return static_cast<double>(near.size()) / (1e3 * std::max(Length(points, part), kNearPlace));
}

// That a stretch is a wire.
double LogOdds(const CandidateStretch& stretch) {
  return kBias + (stretch.is_free ? kMiddles + kFree : kMiddles) * stretch.middle_evidence +
         kColour * stretch.colour_log_odds + kPlaces * std::log(stretch.found_places + kFewPlaces);
}

CandidateStretch Judged(const StretchEvidence& evidence, const std::vector<StripAgreement>& along,
                        const StripViews& views, const PointGrid& places, const Polyline& points) {
  const EdgePart& part = evidence.part;
  const Support support = SupportOf(along, part);
  CandidateStretch stretch;
  stretch.places = {points[part.first], points[(part.first + part.last) / 2], points[part.last]};
  stretch.length = Length(points, part);
  if (support.seen > 0)
    stretch.middle_evidence =
        support.middle_evidence / (StripAgreement::kCorrelation * support.seen);
  stretch.is_free = FreeShare(views, points, part) > 0.5;
  stretch.colour_log_odds = ColourLogOdds(evidence);
  stretch.found_places = PlacesNear(places, points, part);
  return stretch;
}

// Returns all stretches.
std::vector<CandidateStretch> KeepLikelyStretches(const Sequence& sequence,
                                                  const SkeletonGraph& known,
                                                  const std::vector<Vec3>& found,
                                                  const StripViews& views, SkeletonGraph& curves) {
  const PointGrid places(found, kNearPlace);
  std::map<EdgeId, std::vector<StripAgreement>> along;
  std::map<EdgeId, std::vector<EdgePart>> kept;
  for (const EdgeId id : curves.Edges()) {
    along[id] = views.AgreementsAlong(curves.edge(id).points);
    kept[id];
  }
  std::vector<CandidateStretch> stretches;
  for (const StretchEvidence& evidence : CollectEvidence(curves, {}, sequence, 0, known)) {
    const EdgeId id = evidence.edge;
    const CandidateStretch& stretch = stretches.emplace_back(
        Judged(evidence, along.at(id), views, places, curves.edge(id).points));
    const bool is_open = stretch.is_free || stretch.colour_log_odds > kMinColourLogOdds;
    if (!is_open || LogOdds(stretch) < 0) continue;
    std::vector<EdgePart>& parts = kept[id];
    if (!parts.empty() && parts.back().last == evidence.part.first) {
      parts.back().last = evidence.part.last;
    } else {
      parts.push_back(evidence.part);
    }
  }
  for (const auto& [id, parts] : kept) KeepParts(id, parts, kMinPiece, curves);
  curves.RemoveIsolatedNodes();
  return stretches;
}

// Whether a curve is a wire even where it hangs together with nothing.
bool StandsAlone(const Support& support, const StripViews& views, const Polyline& points) {
  const auto count = static_cast<double>(points.size());
  return support.middle_evidence / count * Length(points) >= kMinMiddleEvidenceAlone &&
         FreeShare(views, points, {0, points.size() - 1}) >= kMinFreeAlone;
}

// Returns the points of curves that stand alone.
std::vector<Vec3> ExplainAway(double radius, StripViews& views, SkeletonGraph& curves) {
  const auto support_of = [&](EdgeId id) {
    const Polyline& points = curves.edge(id).points;
    return SupportOf(views.AgreementsAlong(points), {0, points.size() - 1});
  };
  std::vector<Vec3> alone;
  std::vector<std::pair<double, EdgeId>> by_evidence;
  for (const EdgeId id : curves.Edges())
    by_evidence.emplace_back(-support_of(id).middle_evidence, id);
  std::sort(by_evidence.begin(), by_evidence.end());
  for (const auto& [evidence, id] : by_evidence) {
    const Support support = support_of(id);
    const Polyline& points = curves.edge(id).points;
    const bool is_supported =
        support.looked >= StripAgreement::kMinLooks * static_cast<double>(points.size()) &&
        support.seen >= kMinSupport * support.looked && support.middle_evidence > 0;
    if (is_supported) {
      if (StandsAlone(support, views, points))
        alone.insert(alone.end(), points.begin(), points.end());
      views.Explain(points, std::vector<double>(points.size(), radius));
    } else {
      curves.RemoveEdge(id);
    }
  }
  curves.RemoveIsolatedNodes();
  return alone;
}

}  // namespace

std::string StretchesCsv(const std::vector<CandidateStretch>& stretches) {
  std::string csv =
      "x0,y0,z0,x1,y1,z1,x2,y2,z2,length,middle_evidence,is_free,colour_log_odds,found_places\n";
  for (const CandidateStretch& stretch : stretches) {
    for (const Vec3& p : stretch.places)
      csv += fmt::format("{:.5f},{:.5f},{:.5f},", p.x(), p.y(), p.z());
    csv +=
        fmt::format("{:.4f},{:.4f},{:d},{:.4f},{:.3f}\n", stretch.length, stretch.middle_evidence,
                    stretch.is_free, stretch.colour_log_odds, stretch.found_places);
  }
  return csv;
}

CandidateProof KeepProvenCandidates(const Sequence& sequence, const SkeletonGraph& known,
                                    const std::vector<Vec3>& places, double radius,
                                    StripViews& views, SkeletonGraph& curves) {
  DropRefutedParts([&views](const Polyline& points) { return views.SharesAlong(points); },
                   kMinStripShare, {}, curves);
  if (curves.empty()) return {};
  CandidateProof proof;
  proof.stretches = KeepLikelyStretches(sequence, known, places, views, curves);
  proof.stand_alone = ExplainAway(radius, views, curves);
  return proof;
}

}  // namespace curvefusion
