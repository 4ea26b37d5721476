#include "apps/live/live_capture.h"

#include <chrono>
#include <ctime>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "apps/live/latest_worker.h"
#include "apps/live/live_json.h"
#include "apps/live/live_poses.h"
#include "fusion/live/live_reconstruction.h"
#include "graph/graph_figures.h"
#include "graph/io/graph_io.h"
#include "kernel/atomic_file.h"
#include "kernel/cancellation.h"

namespace curvefusion {

namespace {

// Seconds that a frame may wait. Chosen: with the time of a bundle and its snapshot, what is shown
// is to be no more than 1.5 s old.
constexpr double kMostWaiting = 1;
constexpr double kRateWindow = 2;  // seconds over which the frame rate is counted
constexpr std::chrono::milliseconds kNap(4);

double ProcessorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// What a snapshot is made from.
struct SnapshotJob {
  LiveEvidence evidence;
  Sequence sample;
  double last_arrival = 0;  // of its frames
};

class Capture {
 public:
  Capture(LiveSource& source, const LiveCapture& setup, LiveBoard& board)
      : source_(source),
        setup_(setup),
        board_(board),
        snapshots_([this](SnapshotJob job) { ShowSnapshot(job); }) {}

  CaptureEnd Run() {
    CaptureEnd end;
    while (!(end.by_user = setup_.wants_end()) && !IsDone()) {
      ThrowIfCancelled();
      if (!cameras_) FindCameras();
      if (cameras_) TakeArrived(end);
      if (waiting_.empty()) {
        std::this_thread::sleep_for(kNap);
      } else {
        TakeNext();
      }
      ShowProgress();
    }
    snapshots_.Wait();
    ShowProgress();
    return end;
  }

 private:
  double Now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  bool IsDone() { return cameras_ && waiting_.empty() && source_.HasEnded(Now()); }

  void FindCameras() {
    cameras_ = source_.Cameras();
    if (!cameras_) return;
    live_.emplace(*cameras_, setup_.options);
    poses_.emplace(*cameras_);
    board_.Update([&](LiveState& state) { state.camera = cameras_->depth_camera; });
  }

  void TakeArrived(CaptureEnd& end) {
    for (ArrivedFrame& frame : source_.Arrived(Now())) {
      if (!first_arrival_) {
        first_arrival_ = frame.arrival;
        processor_start_ = ProcessorSeconds();
      }
      end.last_arrived = frame.frame.name;
      waiting_.push_back(std::move(frame));
      board_.Update([](LiveState& state) {
        state.phase = LivePhase::kScanning;
        ++state.arrived;
      });
    }
  }

  void TakeNext() {
    ArrivedFrame next = std::move(waiting_.front());
    waiting_.pop_front();
    if (Now() - next.arrival > kMostWaiting) {
      board_.Update([](LiveState& state) { ++state.dropped; });
      return;
    }
    if (!poses_->Place(next.frame)) {
      board_.Update([](LiveState& state) { ++state.lost; });
      return;
    }
    if (live_->AddFrame(next.frame)) {
      snapshots_.Offer({live_->evidence(), live_->sample(), next.arrival});
    }
    used_at_.push_back(Now());
    board_.Update([&](LiveState& state) {
      ++state.used;
      state.T_world_camera = next.frame.T_world_camera;
      state.volume_bytes = live_->volume_bytes();
    });
  }

  void ShowProgress() {
    const double now = Now();
    while (!used_at_.empty() && used_at_.front() < now - kRateWindow) used_at_.pop_front();
    board_.Update([&](LiveState& state) {
      if (!first_arrival_) return;
      state.seconds = now - *first_arrival_;
      const double window = std::min(kRateWindow, std::max(state.seconds, 0.1));
      state.frame_rate = static_cast<double>(used_at_.size()) / window;
      state.processor_ms = 1000 * (ProcessorSeconds() - processor_start_) / std::max(1, state.used);
    });
    setup_.on_step(now);
  }

  // On the thread of the snapshots.
  void ShowSnapshot(const SnapshotJob& job) {
    const LiveSnapshot snapshot = MakeSnapshot(job.evidence, setup_.options);
    const GraphFigures figures = MeasureGraph(snapshot.graph);
    const int number = board_.state().snapshot.number + 1;
    board_.SetCurves(CurvesJson(snapshot, number, job.sample).dump());
    WriteSkeleton(setup_.folder / kSnapshotFile, snapshot.graph);
    board_.Update([&](LiveState& state) {
      SnapshotFigures& shown = state.snapshot;
      shown.number = number;
      shown.seconds_behind = Now() - job.last_arrival;
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
  std::optional<LiveReconstruction> live_;
  std::optional<LivePoses> poses_;
  std::deque<ArrivedFrame> waiting_;
  std::deque<double> used_at_;
  std::optional<double> first_arrival_;
  double processor_start_ = 0;
  LatestWorker<SnapshotJob> snapshots_;  // last: its thread uses the rest
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
