#include "fusion/curve_graph/selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "graph/connected_parts.h"

namespace curvefusion {

namespace {

constexpr double kMaxScore = 4;          // chosen: of one stretch; no more of it is calibrated
constexpr double kChangeCost = 2;        // chosen: a change along an edge needs a stretch of 88 %
constexpr double kPartCost = kMaxScore;  // chosen: a part of its own needs a certain stretch
// Chosen: a doubtful one and one where no image shows a strip need .2 m that are certain. Of 44
// such parts without strips in training scans 43 were no wires, worth 14 at most (docs/proof.md).
constexpr double kLargePartCost = 20;
// A part is not doubtful with so many metres of so likely a wire. Chosen: parts of rooms that are
// hardly wire have none, the mesh of a chair 1.5 m (docs/proof.md).
constexpr double kLikelyWire = 0.7;
constexpr double kLikelyLength = 0.3;

// Stretches [first, last) of an edge.
struct Run {
  size_t first = 0, last = 0;
  bool is_kept = false;
};

// The labels of most score less changes (Viterbi).
std::vector<bool> BestLabels(const std::vector<double>& scores) {
  std::vector<std::array<int, 2>> from;
  std::array<double, 2> best = {0, 0};  // score of no wire, wire
  for (const double score : scores) {
    std::array<double, 2> next;
    std::array<int, 2> came;
    for (int label = 0; label < 2; ++label) {
      const bool changes = best[1 - label] - kChangeCost > best[label];
      came[label] = changes ? 1 - label : label;
      next[label] = best[came[label]] - (changes ? kChangeCost : 0) + (label == 1 ? score : 0);
    }
    best = next;
    from.push_back(came);
  }
  int label = best[1] >= best[0] ? 1 : 0;
  std::vector<bool> labels(scores.size());
  for (size_t i = scores.size(); i-- > 0; label = from[i][label]) labels[i] = label == 1;
  return labels;
}

std::vector<Run> RunsOf(const std::vector<bool>& labels) {
  std::vector<Run> runs;
  for (size_t i = 0; i < labels.size(); ++i) {
    if (runs.empty() || runs.back().is_kept != labels[i]) runs.push_back({i, i, labels[i]});
    runs.back().last = i + 1;
  }
  return runs;
}

void AddLength(const StretchEvidence& stretch, Doubt doubt, UnprovenLengths& lengths) {
  switch (doubt) {
    case Doubt::kSurface:
      lengths.surface += stretch.length;
      break;
    case Doubt::kThick:
      lengths.thick += stretch.length;
      break;
    case Doubt::kLookedPast:
      lengths.looked_past += stretch.length;
      break;
    case Doubt::kUnproven:
      lengths.unproven += stretch.length;
      break;
  }
}

class Selector {
 public:
  Selector(const std::vector<StretchEvidence>& evidence, const std::vector<WireProof>& proofs,
           const ProofLimits& limits)
      : evidence_(evidence),
        proofs_(proofs),
        usual_(LogOdds(limits.usual)),
        doubtful_(LogOdds(limits.doubtful)),
        is_doubtful_(evidence.size()),
        kept_(evidence.size(), true) {
    for (size_t i = 0; i < evidence.size(); ++i) stretches_of_[evidence[i].edge].push_back(i);
  }

  void DecideAlongEdges() {
    for (const auto& [edge, stretches] : stretches_of_) {
      std::vector<double> scores;
      for (const size_t i : stretches) scores.push_back(Score(i));
      const std::vector<bool> labels = BestLabels(scores);
      for (size_t k = 0; k < stretches.size(); ++k) kept_[stretches[k]] = labels[k];
    }
  }

  // Cuts the edges; what is kept is known by the edges it lies on then.
  void Cut(SkeletonGraph& skeleton, UncertainCurves& uncertain) {
    std::map<EdgeId, std::vector<size_t>> stretches_after_cut;
    for (const auto& [id, stretches] : stretches_of_) {
      std::vector<bool> labels;
      for (const size_t i : stretches) labels.push_back(kept_[i]);
      const std::vector<Run> runs = RunsOf(labels);
      if (runs.size() == 1 && runs[0].is_kept) {
        stretches_after_cut[id] = stretches;
      } else {
        CutEdge(id, stretches, runs, skeleton, uncertain, stretches_after_cut);
      }
    }
    stretches_of_ = std::move(stretches_after_cut);
    skeleton.RemoveIsolatedNodes();
  }

  // Finds doubtful parts, which are all where the whole is doubtful; whether there are any.
  bool FindDoubtful(const SkeletonGraph& skeleton) {
    bool is_any = false;
    std::vector<std::vector<EdgeId>> parts = ConnectedEdges(skeleton);
    parts.push_back(skeleton.Edges());
    for (const std::vector<EdgeId>& part : parts) {
      if (!IsDoubtful(part)) continue;
      is_any = true;
      for (const EdgeId id : part) {
        for (const size_t i : stretches_of_.at(id)) is_doubtful_[i] = true;
      }
    }
    return is_any;
  }

  // Metres of what is left that are wire, as far as the proofs can be believed.
  double ExpectedWire() const {
    double length = 0;
    for (const auto& [edge, stretches] : stretches_of_) {
      for (const size_t i : stretches) {
        length += Probability(proofs_[i].log_odds) * evidence_[i].length;
      }
    }
    return length;
  }

  // For later proofs of what is left.
  void RememberRefuted(UncertainCurves& uncertain) const {
    std::vector<bool> is_left(evidence_.size());
    std::set<int> parts_left;
    for (const auto& [edge, stretches] : stretches_of_) {
      for (const size_t i : stretches) {
        is_left[i] = true;
        parts_left.insert(proofs_[i].part);
      }
    }
    for (size_t i = 0; i < evidence_.size(); ++i) {
      if (is_left[i] || parts_left.count(proofs_[i].part) == 0) continue;
      uncertain.beside_kept.push_back(
          {evidence_[i].middle, evidence_[i].length, proofs_[i].own_log_odds});
    }
  }

  // Parts that are too little to be told.
  void DropSmallParts(SkeletonGraph& skeleton, UncertainCurves& uncertain) {
    for (const std::vector<EdgeId>& part : ConnectedEdges(skeleton)) {
      double score = 0;
      bool is_measured = false, is_doubtful = false;
      for (const EdgeId id : part) {
        for (const size_t i : stretches_of_.at(id)) {
          score += Score(i);
          is_measured |= evidence_[i].strips > 0;
          is_doubtful |= is_doubtful_[i];
        }
      }
      if (score >= (is_measured && !is_doubtful ? kPartCost : kLargePartCost)) continue;
      for (const EdgeId id : part) {
        MoveOut(skeleton.TakeEdge(id), stretches_of_.at(id), uncertain);
        stretches_of_.erase(id);
      }
    }
    skeleton.RemoveIsolatedNodes();
  }

 private:
  static double LogOdds(double probability) { return std::log(probability / (1 - probability)); }

  double Score(size_t i) const {
    const double threshold = is_doubtful_[i] ? doubtful_ : usual_;
    return std::clamp(proofs_[i].log_odds - threshold, -kMaxScore, kMaxScore);
  }

  bool IsDoubtful(const std::vector<EdgeId>& part) const {
    double length = 0, wire = 0, likely = 0;
    for (const EdgeId id : part) {
      for (const size_t i : stretches_of_.at(id)) {
        const double probability = Probability(proofs_[i].log_odds);
        length += evidence_[i].length;
        wire += probability * evidence_[i].length;
        if (probability >= kLikelyWire) likely += evidence_[i].length;
      }
    }
    return IsHardlyWire(wire, length) && likely < kLikelyLength;
  }

  void MoveOut(SkeletonEdge edge, const std::vector<size_t>& stretches,
               UncertainCurves& uncertain) const {
    for (const size_t i : stretches) {
      AddLength(evidence_[i], proofs_[i].doubt, uncertain.lengths);
    }
    const bool is_closed = edge.points.front() == edge.points.back();
    edge.nodes[0] = uncertain.graph.AddNode(edge.points.front());
    edge.nodes[1] = is_closed ? edge.nodes[0] : uncertain.graph.AddNode(edge.points.back());
    uncertain.graph.AddEdge(std::move(edge));
  }

  void CutEdge(EdgeId id, const std::vector<size_t>& stretches, const std::vector<Run>& runs,
               SkeletonGraph& skeleton, UncertainCurves& uncertain,
               std::map<EdgeId, std::vector<size_t>>& stretches_after_cut) {
    const SkeletonEdge edge = skeleton.TakeEdge(id);
    const size_t begin = evidence_[stretches.front()].part.first;  // of an edge that was cut before
    for (const Run& run : runs) {
      const std::vector<size_t> of_run(stretches.begin() + static_cast<std::ptrdiff_t>(run.first),
                                       stretches.begin() + static_cast<std::ptrdiff_t>(run.last));
      const size_t first = evidence_[of_run.front()].part.first - begin;
      const size_t last = evidence_[of_run.back()].part.last - begin;
      if (!run.is_kept) {
        MoveOut(PartOf(edge, first, last, {}), of_run, uncertain);
        continue;
      }
      const NodeId front = first == 0 ? edge.nodes[0] : skeleton.AddNode(edge.points[first]);
      const NodeId back =
          last + 1 == edge.points.size() ? edge.nodes[1] : skeleton.AddNode(edge.points[last]);
      const EdgeId kept = skeleton.AddEdge(PartOf(edge, first, last, {front, back}));
      stretches_after_cut[kept] = of_run;
    }
  }

  const std::vector<StretchEvidence>& evidence_;
  const std::vector<WireProof>& proofs_;
  double usual_, doubtful_;        // limits, as log-odds
  std::vector<bool> is_doubtful_;  // of every stretch, whether its part was
  std::vector<bool> kept_;
  std::map<EdgeId, std::vector<size_t>> stretches_of_;  // of the edges that are left
};

}  // namespace

double KeepProven(const std::vector<StretchEvidence>& evidence,
                  const std::vector<WireProof>& proofs, const ProofLimits& limits,
                  SkeletonGraph& skeleton, UncertainCurves& uncertain) {
  Selector selector(evidence, proofs, limits);
  if (limits.usual > 0) {
    const auto select = [&] {
      selector.DecideAlongEdges();
      selector.Cut(skeleton, uncertain);
    };
    select();
    if (limits.doubtful > limits.usual && selector.FindDoubtful(skeleton)) select();
    selector.DropSmallParts(skeleton, uncertain);
    selector.RememberRefuted(uncertain);
    skeleton.DissolveDegree2Nodes();
  }
  return selector.ExpectedWire();
}

}  // namespace curvefusion
