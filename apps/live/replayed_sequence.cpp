#include <algorithm>
#include <utility>

#include "apps/live/live_source.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Frames a second: that of most depth cameras.
constexpr double kUsualRate = 30;
// Seconds from frame to frame: stamps farther apart are numbers of frames, not times.
constexpr double kLongestStep = 0.6;

// Seconds from the first frame to each, as the stamps say; empty where they are no times.
std::vector<double> StampedTimes(const Sequence& sequence) {
  std::vector<double> times, steps;
  for (const SequenceFrame& frame : sequence.frames) {
    if (!times.empty())
      steps.push_back(frame.timestamp - sequence.frames.front().timestamp - times.back());
    times.push_back(frame.timestamp - sequence.frames.front().timestamp);
  }
  const bool ascending = std::is_sorted(times.begin(), times.end());
  if (steps.empty() || !ascending || Median(std::move(steps)) > kLongestStep) return {};
  return times;
}

std::vector<double> TimesAt(double rate, int frames) {
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) times.push_back(i / rate);
  return times;
}

class Replay : public LiveSource {
 public:
  Replay(Sequence sequence, double rate) : sequence_(std::move(sequence)) {
    if (rate == 0) times_ = StampedTimes(sequence_);
    if (times_.empty()) times_ = TimesAt(rate > 0 ? rate : kUsualRate, sequence_.frame_count());
  }

  std::optional<Sequence> Cameras() override {
    Sequence cameras = sequence_;
    cameras.frames.clear();
    return cameras;
  }

  std::vector<ArrivedFrame> Arrived(double now) override {
    if (!start_) start_ = now;
    std::vector<ArrivedFrame> arrived;
    while (!HasEnded(now) && *start_ + times_[next_] <= now) {
      arrived.push_back({sequence_.frames[next_], *start_ + times_[next_]});
      ++next_;
    }
    return arrived;
  }

  bool HasEnded(double) override { return next_ == times_.size(); }

 private:
  Sequence sequence_;
  std::vector<double> times_;
  std::optional<double> start_;
  size_t next_ = 0;
};

}  // namespace

std::unique_ptr<LiveSource> ReplayOf(Sequence sequence, double rate) {
  return std::make_unique<Replay>(std::move(sequence), rate);
}

}  // namespace curvefusion
