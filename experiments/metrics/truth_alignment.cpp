#include "experiments/metrics/truth_alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "experiments/metrics/alignment_starts.h"
#include "experiments/metrics/curve_metrics.h"
#include "experiments/metrics/explained_share.h"
#include "kernel/parallel.h"
#include "kernel/rigid_motion.h"

namespace curvefusion {
namespace {

constexpr int64_t kGrain = 256;  // points per chunk of a parallel loop

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat36 = Eigen::Matrix<double, 3, 6>;

// A motion and how much of the truth it explains.
struct Candidate {
  RigidTransform T_truth_result = RigidTransform::Identity();
  double explained = 0;
};

// What one pair adds to the normal equations.
struct PairTerm {
  double weight = 0;  // 0 = no pair
  Mat36 jacobian;
  Vec3 residual;
};

class Aligner {
 public:
  Aligner(const AlignmentPoints& result, const AlignmentPoints& truth)
      : tangents_(result.tangents),
        result_(result.positions),
        truth_(Thinned(truth, kScored)),
        fitted_(Thinned(truth_, kFitted)),
        spread_(SpreadOfPoints(truth_.positions)) {}

  const ExplainingPoints& result() const { return result_; }
  const std::vector<Vec3>& truth() const { return truth_.positions; }

  // The best motion on the way from a start.
  Candidate Refined(const RigidTransform& start) const {
    // Each holds what the one before leaves. Chosen: the first is half of the spacing of wires that
    // the paper shows apart, the last some times the noise of good results.
    constexpr std::array<double, 4> kGates = {20 * kMillimetre, 10 * kMillimetre, 5 * kMillimetre,
                                              2.5 * kMillimetre};
    Candidate best{start, Explained(start)};
    RigidTransform T = start;
    for (const double gate : kGates) {
      Descend(gate, T);
      if (!IsWithinReach(T)) break;
      const double explained = Explained(T);
      if (explained > best.explained) best = {T, explained};
    }
    return best;
  }

 private:
  static constexpr size_t kScored = 20000;  // of the truth's points: 20 m at 1 mm
  static constexpr size_t kFitted = 1000;   // pairs: 6 unknowns are exact to 1/30 of their noise

  double Explained(const RigidTransform& T) const {
    return result_.ShareOf(truth_.positions, T, kCurveReach);
  }

  // Whether it moves the truth by no more than as far again as the farthest start.
  bool IsWithinReach(const RigidTransform& T) const {
    double squares = 0;
    for (const Vec3& p : fitted_.positions) squares += (T * p - p).squaredNorm();
    const double count = static_cast<double>(fitted_.positions.size());
    return std::sqrt(squares / count) < 2 * kSearchReach;
  }

  // Of distances across the true curve: samples lie anywhere along it.
  PairTerm TermOf(size_t i, double gate, const RigidTransform& T) const {
    constexpr double kLeastCosine = 0.7;  // 45 degrees: other curves at a junction are no partners
    PairTerm term;
    const Vec3& p = fitted_.positions[i];
    const int partner = result_.Nearest(T.inverse() * p, gate);
    if (partner < 0) return term;
    Mat3 across = Mat3::Identity();
    if (!fitted_.tangents.empty() && !tangents_.empty()) {
      const Vec3& tangent = fitted_.tangents[i];
      const double cosine = tangent.dot(T.linear() * tangents_[partner]);
      if (std::abs(cosine) < kLeastCosine) return term;
      across -= tangent * tangent.transpose();
    }
    const Vec3 moved = T * result_[partner];
    term.jacobian << across * CrossMatrix(moved - spread_.center) / -spread_.radius, across;
    term.residual = across * (p - moved);
    const double outside = std::min(1.0, (p - moved).squaredNorm() / (gate * gate));
    term.weight = (1 - outside) * (1 - outside);  // Tukey
    return term;
  }

  // The Gauss-Newton step: a turn about the centre, times the radius, and a shift; none where there
  // are hardly any pairs. Damped, so that what the pairs do not determine stays.
  std::optional<Vec6> Step(double gate, const RigidTransform& T) const {
    constexpr int kFewestPairs = 6;
    constexpr double kDamping = 1e-3;  // of the mean eigenvalue
    std::vector<PairTerm> terms(fitted_.positions.size());
    ParallelFor(0, static_cast<int64_t>(terms.size()), kGrain,
                [&](int64_t i) { terms[i] = TermOf(static_cast<size_t>(i), gate, T); });
    Mat6 normal = Mat6::Zero();
    Vec6 right = Vec6::Zero();
    int pairs = 0;
    for (const PairTerm& term : terms) {
      if (term.weight <= 0) continue;
      ++pairs;
      normal += term.weight * term.jacobian.transpose() * term.jacobian;
      right += term.weight * term.jacobian.transpose() * term.residual;
    }
    if (pairs < kFewestPairs) return std::nullopt;
    normal.diagonal().array() += kDamping * normal.trace() / 6;
    return normal.ldlt().solve(right);
  }

  // Iterates closest points within a gate until they come to rest.
  void Descend(double gate, RigidTransform& T) const {
    constexpr int kIterations = 15;
    constexpr double kAtRest = 1e-5;  // metres: a hundredth of the finest threshold
    for (int iteration = 0; iteration < kIterations; ++iteration) {
      const std::optional<Vec6> step = Step(gate, T);
      if (!step) return;
      T = TurnAbout(spread_.center, step->head<3>() / spread_.radius) * T;
      T.pretranslate(step->tail<3>());
      if (step->norm() < kAtRest) return;
    }
  }

  const std::vector<Vec3>& tangents_;
  ExplainingPoints result_;
  AlignmentPoints truth_;
  AlignmentPoints fitted_;
  PointSpread spread_;
};

}  // namespace

RigidTransform AlignToTruth(const AlignmentPoints& result, const AlignmentPoints& truth) {
  constexpr size_t kFewestPoints = 11;
  // How much more of the truth another start must explain. Chosen: more than noise makes of two
  // equal optima, less than what drift beyond the first gate costs.
  constexpr double kMargin = 0.05;
  if (result.positions.size() < kFewestPoints || truth.positions.empty()) {
    return RigidTransform::Identity();
  }
  const Aligner aligner(result, truth);
  Candidate best = aligner.Refined(RigidTransform::Identity());
  const double least = best.explained + kMargin;
  if (least >= 1) return best.T_truth_result;
  for (const RigidTransform& start : AlignmentStarts(aligner.result(), aligner.truth())) {
    const Candidate candidate = aligner.Refined(start);
    if (candidate.explained > std::max(least, best.explained)) best = candidate;
  }
  return best.T_truth_result;
}

}  // namespace curvefusion
