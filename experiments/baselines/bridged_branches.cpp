#include "experiments/baselines/bridged_branches.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// Huang et al. 2013, 4.2.
constexpr double kLeastDirectionality = 0.9;
constexpr double kLeastCosine = 0.9;
constexpr size_t kLeastSamples = 5;

constexpr int kNone = -1;

struct Branch {
  std::vector<int> samples;
  std::array<int, 2> joined = {kNone, kNone};  // samples of branches that front and back run into
};

class BranchGrower {
 public:
  BranchGrower(const ContractedSamples& samples, double radius)
      : samples_(samples),
        radius_(radius),
        index_(samples.positions),
        owner_(samples.size(), kNone),
        anchor_(samples.size(), kNone) {}

  void GrowBranches() {
    std::vector<int> seeds(samples_.size());
    std::iota(seeds.begin(), seeds.end(), 0);
    std::stable_sort(seeds.begin(), seeds.end(), [this](int a, int b) {
      return samples_.directionality[a] > samples_.directionality[b];
    });
    for (const int seed : seeds) {
      if (!IsDirected(seed)) break;
      if (owner_[seed] == kNone) GrowFrom(seed);
    }
  }

  // Ends that another one has run into have found their neighbour.
  void BridgeGaps() {
    std::vector<char> is_met(samples_.size(), 0);
    for (Branch& branch : branches_) {
      for (int& joined : branch.joined) {
        std::reverse(branch.samples.begin(), branch.samples.end());
        const int last = branch.samples.back();
        if (is_met[last]) continue;
        const Vec3& before = samples_.positions[*(branch.samples.end() - 2)];
        joined = GoOn((samples_.positions[last] - before).normalized(), 0, branch);
        if (joined != kNone) is_met[joined] = 1;
      }
    }
  }

  void AddTo(SkeletonGraph& graph) const {
    std::map<int, NodeId> nodes;
    const auto add_node = [&](int sample) {
      if (sample == kNone || nodes.count(sample) > 0) return;
      nodes[sample] = graph.AddNode(samples_.positions[sample]);
    };
    for (const Branch& branch : branches_) {
      for (const int sample :
           {branch.samples.front(), branch.samples.back(), branch.joined[0], branch.joined[1]}) {
        add_node(sample);
      }
    }
    for (const Branch& branch : branches_) AddEdges(PathOf(branch), nodes, graph);
    graph.DissolveDegree2Nodes();
  }

 private:
  bool IsDirected(int i) const { return samples_.directionality[i] >= kLeastDirectionality; }

  void GrowFrom(int seed) {
    Branch& branch = branches_.emplace_back();
    branch.samples = {seed};
    Take(seed, Number(branch));
    GoOn(-samples_.directions[seed], kLeastDirectionality, branch);
    std::reverse(branch.samples.begin(), branch.samples.end());
    GoOn(samples_.directions[seed], kLeastDirectionality, branch);
    if (branch.samples.size() >= kLeastSamples) return;
    std::replace(owner_.begin(), owner_.end(), Number(branch), kNone);
    branches_.pop_back();
  }

  // Lengthens a branch at its back; returns the sample of a branch that it runs into, or kNone.
  int GoOn(Vec3 heading, double least_directionality, Branch& branch) {
    while (true) {
      const int last = branch.samples.back();
      const int next = NearestAhead(last, heading, branch);
      if (next == kNone) return kNone;
      if (owner_[next] != kNone) return anchor_[next];
      if (samples_.directionality[next] < least_directionality) return kNone;
      heading = (samples_.positions[next] - samples_.positions[last]).normalized();
      branch.samples.push_back(next);
      Take(next, Number(branch));
    }
  }

  // Of the branch itself only the other end can be ahead: there it closes to a loop.
  int NearestAhead(int last, const Vec3& heading, const Branch& branch) {
    index_.WithinRadius(samples_.positions[last], radius_, neighbours_);
    int nearest = kNone;
    double nearest_distance = std::numeric_limits<double>::infinity();
    for (const int i : neighbours_) {
      const bool is_own = owner_[i] == Number(branch);
      if (is_own && (i != branch.samples.front() || branch.samples.size() < kLeastSamples))
        continue;
      const Vec3 step = samples_.positions[i] - samples_.positions[last];
      const double distance = step.norm();
      if (distance >= nearest_distance || step.dot(heading) < kLeastCosine * distance) continue;
      nearest = i;
      nearest_distance = distance;
    }
    return nearest;
  }

  // A sample, and what lies beside it, for a branch.
  void Take(int sample, int branch) {
    index_.WithinRadius(samples_.positions[sample], samples_.spacing, neighbours_);
    for (const int i : neighbours_) {
      if (owner_[i] != kNone) continue;
      owner_[i] = branch;
      anchor_[i] = sample;
    }
    owner_[sample] = branch;
    anchor_[sample] = sample;
  }

  int Number(const Branch& branch) const { return static_cast<int>(&branch - branches_.data()); }

  static std::vector<int> PathOf(const Branch& branch) {
    std::vector<int> path = branch.samples;
    if (branch.joined[0] != kNone) path.insert(path.begin(), branch.joined[0]);
    if (branch.joined[1] != kNone) path.push_back(branch.joined[1]);
    return path;
  }

  // An edge between each two nodes along a path.
  void AddEdges(const std::vector<int>& path, const std::map<int, NodeId>& nodes,
                SkeletonGraph& graph) const {
    SkeletonEdge edge;
    edge.nodes[0] = nodes.at(path.front());
    for (size_t i = 0; i < path.size(); ++i) {
      edge.points.push_back(samples_.positions[path[i]]);
      const auto node = nodes.find(path[i]);
      if (i == 0 || node == nodes.end()) continue;
      edge.nodes[1] = node->second;
      graph.AddEdge(edge);
      edge.points.assign(1, samples_.positions[path[i]]);
      edge.nodes[0] = node->second;
    }
  }

  const ContractedSamples& samples_;
  double radius_;
  PointIndex index_;
  std::vector<int> owner_;   // of each sample: the branch that has taken it
  std::vector<int> anchor_;  // and beside which of the branch's samples
  std::vector<Branch> branches_;
  std::vector<int> neighbours_;
};

}  // namespace

void AddBridgedBranches(const ContractedSamples& samples, double radius, SkeletonGraph& graph) {
  BranchGrower grower(samples, radius);
  grower.GrowBranches();
  grower.BridgeGaps();
  grower.AddTo(graph);
}

}  // namespace curvefusion
