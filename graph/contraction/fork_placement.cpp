#include "graph/contraction/fork_placement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace curvefusion {

namespace {

// Chosen: lines fitted to wires that part at 25 degrees meet 10 to 20 mm too far out. Parabolas
// take their place at angles up to 40 degrees, where they fit and the stretches are long enough.
constexpr double kMaxAngle = 0.7;    // radians
constexpr double kMaxRms = 0.002;    // metres
constexpr double kLeastFit = 0.015;  // metres
constexpr double kStep = 0.0005;     // metres along parabolas

// A parabola by arc length over kScale, fitted to points.
struct Parabola {
  Mat3 coefficients;  // one column a power
  double rms = 0;

  static Vec3 Powers(double arc_length) {
    constexpr double kScale = 0.05;  // metres; derived: fork_fit_length
    const double t = arc_length / kScale;
    return {1, t, t * t};
  }
  Vec3 At(double arc_length) const { return coefficients * Powers(arc_length); }
};

struct Sample {
  double arc_length;
  Vec3 position;
};

// The clear points of a branch by their way from the junction, times `sign`.
void AddSamples(const ClearBranch& branch, double sign, std::vector<Sample>& samples) {
  const std::vector<double> arc_length = CumulativeLength(branch.points);
  for (size_t i = branch.first; i < branch.last; ++i) {
    samples.push_back({sign * arc_length[i], branch.points[i]});
  }
}

Parabola Fit(const std::vector<Sample>& samples) {
  Mat3 normal = Mat3::Zero();
  Mat3 right = Mat3::Zero();
  for (const Sample& sample : samples) {
    const Vec3 powers = Parabola::Powers(sample.arc_length);
    normal += powers * powers.transpose();
    right += powers * sample.position.transpose();
  }
  Parabola fit{normal.ldlt().solve(right).transpose(), 0};
  double squares = 0;
  for (const Sample& sample : samples) {
    squares += (fit.At(sample.arc_length) - sample.position).squaredNorm();
  }
  fit.rms = std::sqrt(squares / static_cast<double>(samples.size()));
  return fit;
}

double StretchLength(const ClearBranch& branch) {
  const std::vector<double> arc_length = CumulativeLength(branch.points);
  return arc_length[branch.last - 1] - arc_length[branch.first];
}

Vec3 Heading(const ClearBranch& branch) {
  return (branch.points[branch.last - 1] - branch.points[branch.first]).normalized();
}

// The branch that forks off the straight pair of the two others, the last of the three indices.
std::optional<std::array<int, 3>> FindFork(const std::vector<ClearBranch>& branches) {
  std::array<int, 3> best{0, 1, 2};
  double straightest = std::numeric_limits<double>::infinity();
  for (const std::array<int, 3>& order :
       {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{0, 2, 1}, std::array<int, 3>{1, 2, 0}}) {
    const double cosine = Heading(branches[order[0]]).dot(Heading(branches[order[1]]));
    if (cosine >= straightest) continue;
    straightest = cosine;
    best = order;
  }
  const Vec3 fork = Heading(branches[best[2]]);
  const double sharpest =
      std::max(fork.dot(Heading(branches[best[0]])), fork.dot(Heading(branches[best[1]])));
  if (straightest > -std::cos(kMaxAngle) || sharpest < std::cos(kMaxAngle)) return std::nullopt;
  return best;
}

// Both wires are one ridge on this side of the fork, which lies between them and bends away from
// either as far as the fork may be off; nothing where that leaves too little.
ClearBranch BeyondBlend(const ClearBranch& common, double reach) {
  const std::vector<double> arc_length = CumulativeLength(common.points);
  ClearBranch beyond = common;
  while (beyond.first + 3 < beyond.last && arc_length[beyond.first] < reach) ++beyond.first;
  return beyond.last >= beyond.first + 3 && StretchLength(beyond) >= kLeastFit ? beyond : common;
}

// Where two curves come nearest to each other, over steps of their arc lengths.
struct Meeting {
  double on_fork = 0;
  double on_through = 0;
  double distance = std::numeric_limits<double>::infinity();
};

Meeting NearestApproach(const Parabola& fork, double fork_end, const Parabola& through,
                        double reach) {
  Meeting nearest;
  for (double t = -reach; t <= fork_end; t += kStep) {
    const Vec3 p = fork.At(t);
    for (double u = -reach; u <= reach; u += kStep) {
      const double distance = (through.At(u) - p).norm();
      if (distance < nearest.distance) nearest = {t, u, distance};
    }
  }
  return nearest;
}

}  // namespace

std::optional<Vec3> ForkPosition(const std::vector<ClearBranch>& branches, double reach,
                                 double max_miss) {
  if (branches.size() != 3) return std::nullopt;
  for (const ClearBranch& branch : branches) {
    if (branch.last < branch.first + 3 || StretchLength(branch) < kLeastFit) return std::nullopt;
  }
  const auto order = FindFork(branches);
  if (!order) return std::nullopt;
  const ClearBranch& forking = branches[(*order)[2]];
  const double fork_end = CumulativeLength(forking.points)[forking.first];
  std::vector<Sample> on_fork, on_through;
  AddSamples(forking, 1, on_fork);
  const bool first_is_common = Heading(forking).dot(Heading(branches[(*order)[0]])) < 0;
  AddSamples(first_is_common ? BeyondBlend(branches[(*order)[0]], reach) : branches[(*order)[0]], 1,
             on_through);
  AddSamples(first_is_common ? branches[(*order)[1]] : BeyondBlend(branches[(*order)[1]], reach),
             -1, on_through);
  const Parabola fork = Fit(on_fork);
  const Parabola through = Fit(on_through);
  if (std::max(fork.rms, through.rms) > kMaxRms) return std::nullopt;
  const Meeting meeting = NearestApproach(fork, fork_end, through, reach);
  const bool is_inside = meeting.on_fork > -reach + kStep && meeting.on_fork < fork_end - kStep &&
                         std::abs(meeting.on_through) < reach - kStep;
  const bool is_sound = fork_end - meeting.on_fork <= StretchLength(forking);
  if (!is_inside || !is_sound || meeting.distance > max_miss) return std::nullopt;
  return through.At(meeting.on_through);
}

}  // namespace curvefusion
