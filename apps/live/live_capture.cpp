#include "apps/live/live_capture.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "apps/live/frame_queue.h"
#include "apps/live/live_json.h"
#include "fusion/live/live_reconstruction.h"
#include "fusion/tracking/camera_tracker.h"
#include "graph/graph_figures.h"
#include "graph/io/graph_io.h"
#include "kernel/atomic_file.h"
#include "kernel/cancellation.h"

namespace curvefusion {

namespace {

// Derived: so many frames come while a bundle of 30 is worked on, where that takes no longer than
// its frames.
constexpr size_t kMostWaiting = 30;
constexpr double kRateWindow = 2;  // seconds over which the frame rate is counted
constexpr std::chrono::milliseconds kStep(4);

// Gives frames their poses where the source gives none: by tracking the camera.
class LivePoses {
 public:
  explicit LivePoses(const Sequence& cameras) : single_(cameras) {
    single_.frames.clear();
    if (!cameras.has_poses) {
      tracker_.emplace(CamerasOf(cameras), TrackingOptions(), RigidTransform::Identity());
    }
  }

  // Sets the frame's pose, unless it has one. False where the camera was lost. A frame of 640x480
  // takes a tenth of a second of processor time. Throws Error(kBadInput) for an image that cannot
  // be read.
  bool Place(SequenceFrame& frame) {
    if (!tracker_) return true;
    single_.frames = {frame};
    const TrackedFrame tracked = tracker_->Track(MakeTrackingFrame(
        frame, LoadDepth(single_, 0), LoadColor(single_, 0), CamerasOf(single_), {}));
    frame.T_world_camera = tracked.T_world_camera;
    return tracked.is_tracked;
  }

 private:
  Sequence single_;  // the frame that is placed
  std::optional<CameraTracker> tracker_;
};

// This thread takes frames as they come; another works on them, one after the other.
class Capture {
 public:
  Capture(LiveSource& source, const LiveCapture& setup, LiveBoard& board)
      : source_(source), setup_(setup), board_(board) {}

  // Where the capture fails, the frames that wait are left out.
  ~Capture() {
    queue_.Close();
    while (queue_.Pop()) {
    }
  }

  CaptureEnd Run() {
    CaptureEnd end;
    while (!(end.by_user = setup_.wants_end()) && !HasEnded()) {
      if (!cameras_) FindCameras();
      if (cameras_) TakeArrived(end);
      Step();
    }
    queue_.Close();
    while (work_.valid()) Step();
    return end;
  }

 private:
  double Now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  bool HasEnded() { return source_.HasEnded(Now()); }

  void FindCameras() {
    cameras_ = source_.Cameras();
    if (!cameras_) return;
    board_.Update([&](LiveState& state) { state.camera = cameras_->depth_camera; });
    work_ = std::async(std::launch::async, [this] { Work(); });
  }

  void TakeArrived(CaptureEnd& end) {
    for (ArrivedFrame& frame : source_.Arrived(Now())) {
      if (!first_arrival_) first_arrival_ = frame.arrival;
      end.last_arrived = frame.frame.name;
      const RigidTransform T_world_camera = frame.frame.T_world_camera;
      const bool dropped = queue_.Push(std::move(frame));
      if (!dropped) kept_at_.push_back(Now());
      board_.Update([&](LiveState& state) {
        state.phase = LivePhase::kScanning;
        ++state.arrived;
        state.dropped += dropped ? 1 : 0;
        if (cameras_->has_poses) state.T_world_camera = T_world_camera;
      });
    }
  }

  // Waits for a moment. Throws what the work has thrown.
  void Step() {
    ThrowIfCancelled();
    if (!work_.valid()) {
      std::this_thread::sleep_for(kStep);
    } else if (work_.wait_for(kStep) == std::future_status::ready) {
      work_.get();
    }
    ShowProgress();
  }

  void ShowProgress() {
    const double now = Now();
    while (!kept_at_.empty() && kept_at_.front() < now - kRateWindow) kept_at_.pop_front();
    board_.Update([&](LiveState& state) {
      if (!first_arrival_) return;
      state.seconds = now - *first_arrival_;
      const double window = std::min(kRateWindow, std::max(state.seconds, 0.1));
      state.frame_rate = static_cast<double>(kept_at_.size()) / window;
    });
    setup_.on_step(now);
  }

  // On the thread that works, as what follows.
  void Work() {
    LivePoses poses(*cameras_);
    LiveReconstruction live(*cameras_, setup_.options);
    while (std::optional<ArrivedFrame> next = queue_.Pop()) {
      SequenceFrame& frame = next->frame;
      if (!poses.Place(frame)) {
        board_.Update([](LiveState& state) { ++state.lost; });
        continue;
      }
      const bool bundle_ended = live.AddFrame(frame);
      board_.Update([&](LiveState& state) {
        ++state.used;
        state.volume_bytes = live.volume_bytes();
        state.cost = live.cost();
        if (!cameras_->has_poses) state.T_world_camera = frame.T_world_camera;
      });
      if (bundle_ended) ShowSnapshot(live, next->arrival);
    }
  }

  void ShowSnapshot(LiveReconstruction& live, double last_arrival) {
    const LiveSnapshot snapshot = live.Snapshot();
    const GraphFigures figures = MeasureGraph(snapshot.graph);
    const int number = board_.state().snapshot.number + 1;
    board_.SetCurves(CurvesJson(snapshot, number, live.sample()).dump());
    WriteSkeleton(setup_.folder / kSnapshotFile, snapshot.graph);
    board_.Update([&](LiveState& state) {
      SnapshotFigures& shown = state.snapshot;
      shown.number = number;
      shown.seconds_behind = Now() - last_arrival;
      shown.most_behind = std::max(shown.most_behind, shown.seconds_behind);
      shown.curves = figures.edges;
      shown.free_ends = figures.free_ends;
      shown.length = figures.length;
    });
    board_.SetSightings(SightingsJson(snapshot).dump());
    WriteState(board_, setup_.folder);
  }

  LiveSource& source_;
  const LiveCapture& setup_;
  LiveBoard& board_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Sequence> cameras_;
  std::optional<double> first_arrival_;
  std::deque<double> kept_at_;  // frames that cost no other one, within the window of the rate
  FrameQueue queue_{kMostWaiting};
  std::future<void> work_;  // last: waits for its thread, which uses the rest
};

}  // namespace

CaptureEnd CaptureLive(LiveSource& source, const LiveCapture& capture, LiveBoard& board) {
  return Capture(source, capture, board).Run();
}

void WriteState(const LiveBoard& board, const std::filesystem::path& folder) {
  nlohmann::ordered_json json = StateJson(board.state());
  json["curves"] = nlohmann::ordered_json::parse(board.sightings());
  WriteStreamAtomically(folder / kStateFile,
                        [&](std::ostream& stream) { stream << json.dump(1) << '\n'; });
}

}  // namespace curvefusion
