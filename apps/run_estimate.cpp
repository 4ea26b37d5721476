#include "apps/run_estimate.h"

#include <algorithm>

namespace curvefusion {

namespace {

// Seconds before the speed of this machine is known well enough: a volume of 24 frames takes .35.
constexpr double kEarliest = 0.25;
// Once so much of a stage is done its own speed is known, chosen on the scans of
// docs/results_details.md.
constexpr double kSureShare = 0.1;
// Chosen: so many planned seconds of a stage weigh as much as all other stages together.
constexpr double kDoubt = 0.25;

}  // namespace

void RunEstimate::Plan(const std::vector<PlannedStage>& stages) { plan_ = stages; }

double RunEstimate::Cost() const {
  return is_planned_ && next_ <= plan_.size() ? plan_[next_ - 1].cost : 0;
}

void RunEstimate::Begin(const std::string& stage, double now) {
  if (!stage_.empty()) {
    for (Spent* spent : {&all_, &of_name_[stage_]}) {
      spent->planned += Cost();
      spent->taken += now - start_;
    }
  }
  stage_ = stage;
  start_ = steps_start_ = now;
  const auto from = plan_.begin() + static_cast<std::ptrdiff_t>(std::min(next_, plan_.size()));
  const auto planned = std::find_if(
      from, plan_.end(), [&](const PlannedStage& candidate) { return candidate.name == stage; });
  is_planned_ = planned != plan_.end();
  if (is_planned_) next_ = static_cast<size_t>(planned - plan_.begin()) + 1;
}

void RunEstimate::Report(const std::string& stage, int64_t done, int64_t total, double now) {
  if (stage != stage_ || done < done_) Begin(stage, now);
  if (done == 0) steps_start_ = now;
  done_ = done;
  share_ = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 0;
}

double RunEstimate::Rate(double now) const {
  const double running = share_ > 0 ? now - start_ : 0;
  const double planned = all_.planned + share_ * Cost();
  return planned > 0 && all_.taken + running >= kEarliest ? (all_.taken + running) / planned : 0;
}

// What took longer than planned for this scan does so again.
double RunEstimate::RateOf(const std::string& stage, double rate) const {
  const auto found = of_name_.find(stage);
  if (found == of_name_.end()) return rate;
  return (found->second.taken + kDoubt * rate) / (found->second.planned + kDoubt);
}

std::optional<double> RunEstimate::SecondsLeft(double now) const {
  const double rate = Rate(now);
  if (rate <= 0) return std::nullopt;
  double ahead = 0;
  for (size_t i = next_; i < plan_.size(); ++i) {
    ahead += plan_[i].cost * RateOf(plan_[i].name, rate);
  }
  const double elapsed = now - start_;
  const double as_planned = Cost() * RateOf(stage_, rate);
  if (share_ <= 0) return ahead + std::max(0.0, as_planned - elapsed);
  const double by_itself = (now - steps_start_) * (1 - share_) / share_;
  const double trust = std::min(1.0, share_ / kSureShare);
  return ahead + trust * by_itself + (1 - trust) * (1 - share_) * as_planned;
}

}  // namespace curvefusion
