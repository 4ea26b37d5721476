#include "graph/contraction/branch_tracing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "graph/contraction/branch_joining.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// Walks along the samples that have a direction. Each sample is used once.
class BranchTracer {
 public:
  BranchTracer(const ContractedSamples& samples, const BranchTracingOptions& options)
      : samples_(samples),
        options_(options),
        index_(samples.positions),
        minimum_cosine_(std::cos(options.maximum_bend)),
        is_used_(samples.size(), 0),
        is_branch_(samples.size(), 0) {}

  // All branches, in the order of the directionality of the samples they start from.
  std::vector<Branch> TraceAll();

  // The samples that belong to none of them.
  std::vector<Vec3> OtherSamples() const;

 private:
  bool IsDirected(int i) const {
    return samples_.directionality[i] >= options_.branch_directionality;
  }
  std::vector<int> Seeds() const;
  Branch TraceFrom(int seed);
  Vec3 Walk(Vec3 heading, size_t absorbed_by_seed, Polyline& points);
  Vec3 Tip(const Vec3& position, const Vec3& heading, size_t first, size_t last) const;
  int Next(const Vec3& position, const Vec3& heading);
  Vec3 Absorb(int sample);

  const ContractedSamples& samples_;
  const BranchTracingOptions& options_;
  PointIndex index_;
  double minimum_cosine_;
  std::vector<char> is_used_;
  std::vector<char> is_branch_;
  std::vector<int> taken_;  // samples of the branch being traced
  std::vector<int> neighbours_;
};

std::vector<int> BranchTracer::Seeds() const {
  std::vector<int> seeds;
  for (int i = 0; i < static_cast<int>(samples_.size()); ++i) {
    if (IsDirected(i)) seeds.push_back(i);
  }
  std::stable_sort(seeds.begin(), seeds.end(), [this](int a, int b) {
    return samples_.directionality[a] > samples_.directionality[b];
  });
  return seeds;
}

std::vector<Branch> BranchTracer::TraceAll() {
  std::vector<Branch> branches;
  for (const int seed : Seeds()) {
    if (is_used_[seed]) continue;
    taken_.clear();
    Branch branch = TraceFrom(seed);
    if (static_cast<int>(taken_.size()) < options_.minimum_samples || branch.points.size() < 2)
      continue;
    for (const int i : taken_) is_branch_[i] = 1;
    branches.push_back(std::move(branch));
  }
  return branches;
}

std::vector<Vec3> BranchTracer::OtherSamples() const {
  std::vector<Vec3> others;
  for (size_t i = 0; i < samples_.size(); ++i) {
    if (!is_branch_[i]) others.push_back(samples_.positions[i]);
  }
  return others;
}

Branch BranchTracer::TraceFrom(int seed) {
  Branch branch{{Absorb(seed)}, {}};
  const size_t absorbed_by_seed = taken_.size();
  branch.tips[0] = Walk(-samples_.directions[seed], absorbed_by_seed, branch.points);
  std::reverse(branch.points.begin(), branch.points.end());
  branch.tips[1] = Walk(samples_.directions[seed], absorbed_by_seed, branch.points);
  return branch;
}

// Goes on from the last of the points, which holds the first `absorbed_by_seed` samples at the
// start of a branch. Returns the tip.
Vec3 BranchTracer::Walk(Vec3 heading, size_t absorbed_by_seed, Polyline& points) {
  Vec3 position = points.back();
  size_t first = 0, last = absorbed_by_seed;  // the samples of the last point
  for (int next = Next(position, heading); next >= 0; next = Next(position, heading)) {
    first = taken_.size();
    const Vec3 reached = Absorb(next);
    last = taken_.size();
    const Vec3& axis = samples_.directions[next];
    const Vec3 step = (reached - position).normalized();
    heading = (step + (axis.dot(heading) < 0 ? -1.0 : 1.0) * axis).normalized();
    position = reached;
    points.push_back(position);
  }
  return Tip(position, heading, first, last);
}

// The farthest of some samples taken.
Vec3 BranchTracer::Tip(const Vec3& position, const Vec3& heading, size_t first, size_t last) const {
  Vec3 tip = position;
  for (size_t k = first; k < last; ++k) {
    const Vec3& sample = samples_.positions[taken_[k]];
    if ((sample - tip).dot(heading) > 0) tip = sample;
  }
  return tip;
}

// The nearest unused sample ahead; -1 where there is none, or where it has no direction or another
// one: there the branch ends and a junction begins.
int BranchTracer::Next(const Vec3& position, const Vec3& heading) {
  index_.WithinRadius(position, options_.step_reach * samples_.spacing, neighbours_);
  int nearest = -1;
  double nearest_distance = std::numeric_limits<double>::infinity();
  for (const int i : neighbours_) {
    if (is_used_[i]) continue;
    const Vec3 step = samples_.positions[i] - position;
    const double distance = step.norm();
    if (distance >= nearest_distance || step.dot(heading) < minimum_cosine_ * distance) continue;
    nearest = i;
    nearest_distance = distance;
  }
  if (nearest < 0 || !IsDirected(nearest)) return -1;
  return std::abs(samples_.directions[nearest].dot(heading)) < minimum_cosine_ ? -1 : nearest;
}

// Takes the unused samples around one and returns their mean.
Vec3 BranchTracer::Absorb(int sample) {
  index_.WithinRadius(samples_.positions[sample], samples_.spacing, neighbours_);
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (const int i : neighbours_) {
    if (is_used_[i] || !IsDirected(i)) continue;
    is_used_[i] = 1;
    taken_.push_back(i);
    sum += samples_.positions[i];
    ++count;
  }
  return sum / count;
}

}  // namespace

void VisitOptions(BranchTracingOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"branch_directionality", "", 0.5, 1.0,
                 "A sample belongs to a branch from this share of its neighbourhood's variance "
                 "along one direction. Huang et al. 2013, 4.2."},
                options.branch_directionality);
  visitor.Visit({"maximum_bend", "rad", 0.1, 1.5,
                 "A branch ends where it would turn by more within one step. Huang et al. 2013, "
                 "4.2 have 0.45."},
                options.maximum_bend);
  visitor.Visit({"step_reach", "spacings", 1, 10,
                 "The next sample of a branch is no farther away. Choice of this implementation."},
                options.step_reach);
  visitor.Visit({"join_reach", "spacings", 1, 20,
                 "The end of a branch is joined to a junction or a branch that is no farther away. "
                 "Choice of this implementation."},
                options.join_reach);
  visitor.Visit({"junction_link", "spacings", 0.1, 10,
                 "Samples outside branches are one junction when they are linked by steps no "
                 "longer than this. CurveFusion 4.2 without a number."},
                options.junction_link);
  visitor.Visit({"minimum_samples", "samples", 2, 1000,
                 "A branch has at least so many samples. Huang et al. 2013, 4.2."},
                options.minimum_samples);
}

SkeletonGraph TraceBranches(const ContractedSamples& samples, const BranchTracingOptions& options) {
  BranchTracer tracer(samples, options);
  std::vector<Branch> branches = tracer.TraceAll();
  return JoinBranches(std::move(branches), tracer.OtherSamples(), samples.spacing, options);
}

}  // namespace curvefusion
