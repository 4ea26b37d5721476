#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "fusion/live/live_reconstruction.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"

namespace curvefusion {

enum class LivePhase {
  kWaiting,         ///< for the first frame
  kScanning,        ///< frames come
  kReconstructing,  ///< the capture has ended, the batch runs
  kDone,            ///< its result is there
};

/// The last snapshot in figures.
struct SnapshotFigures {
  int number = 0;             ///< counted from 1; 0 = there is none
  double seconds_behind = 0;  ///< from the arrival of its last frame until it was shown
  double most_behind = 0;     ///< of all snapshots
  int curves = 0;
  int free_ends = 0;
  double length = 0;  ///< metres
};

/// How a live run goes.
struct LiveState {
  LivePhase phase = LivePhase::kWaiting;
  double seconds = 0;  ///< since the first frame
  int arrived = 0;     ///< frames
  int used = 0;
  int dropped = 0;        ///< as there was no time for them
  int lost = 0;           ///< that the tracker could not place
  double frame_rate = 0;  ///< frames a second that were kept, of the last seconds
  LiveCost cost;
  size_t volume_bytes = 0;  ///< of the model of large surfaces
  SnapshotFigures snapshot;
  std::optional<RigidTransform> T_world_camera;  ///< of the last used frame
  PinholeCamera camera;                          ///< of depth images
};

/// What the threads of a live run show each other and the browser.
class LiveBoard {
 public:
  void Update(const std::function<void(LiveState&)>& change) {
    const std::lock_guard lock(mutex_);
    change(state_);
  }
  LiveState state() const { return Locked(state_); }

  /// The curves of the last snapshot as JSON (CurvesJson).
  void SetCurves(std::string json) {
    const std::lock_guard lock(mutex_);
    curves_ = std::move(json);
  }
  std::string curves() const { return Locked(curves_); }

  /// What each of these curves rests on, as JSON (SightingsJson).
  void SetSightings(std::string json) {
    const std::lock_guard lock(mutex_);
    sightings_ = std::move(json);
  }
  std::string sightings() const { return Locked(sightings_); }

 private:
  template <class Value>
  Value Locked(const Value& value) const {
    const std::lock_guard lock(mutex_);
    return value;
  }

  mutable std::mutex mutex_;
  LiveState state_;
  std::string curves_ = "null";
  std::string sightings_ = "[]";
};

}  // namespace curvefusion
