#include <chrono>

#include "apps/live/live_source.h"
#include "capture/growing_folder.h"

namespace curvefusion {

namespace {

// Seconds from look to look into the folder, at least: less than a frame of any camera.
constexpr double kShortestStep = 0.01;
// A look takes so small a share of the time, however many files there are.
constexpr double kShareOfTime = 0.05;

class FollowedFolder : public LiveSource {
 public:
  FollowedFolder(const std::filesystem::path& folder, bool use_poses, double idle)
      : folder_(folder, use_poses), idle_(idle) {}

  std::optional<Sequence> Cameras() override {
    const bool ended = folder_.HasEnded();
    std::optional<Sequence> cameras = folder_.Cameras();
    has_end_ = ended && !cameras;  // they will not come any more
    return cameras;
  }

  std::vector<ArrivedFrame> Arrived(double now) override {
    std::vector<ArrivedFrame> arrived;
    if (now < next_look_) return arrived;
    const bool ended = folder_.HasEnded();  // asked first: what came before `end` is taken
    const auto start = std::chrono::steady_clock::now();
    for (SequenceFrame& frame : folder_.NewFrames()) arrived.push_back({std::move(frame), now});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    next_look_ = now + std::max(kShortestStep, took.count() / kShareOfTime);
    if (!arrived.empty()) last_arrival_ = now;
    has_end_ = ended;
    return arrived;
  }

  bool HasEnded(double now) override {
    return has_end_ || (last_arrival_ && now - *last_arrival_ > idle_);
  }

 private:
  GrowingFolder folder_;
  double idle_;
  double next_look_ = 0;
  std::optional<double> last_arrival_;
  bool has_end_ = false;
};

}  // namespace

std::unique_ptr<LiveSource> FollowFolder(const std::filesystem::path& folder, bool use_poses,
                                         double idle) {
  return std::make_unique<FollowedFolder>(folder, use_poses, idle);
}

}  // namespace curvefusion
