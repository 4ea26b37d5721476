#include "apps/live/live_board.h"

#include <utility>

namespace curvefusion {

void LiveBoard::Update(const std::function<void(LiveState&)>& change) {
  const std::lock_guard lock(mutex_);
  change(state_);
}

LiveState LiveBoard::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void LiveBoard::SetCurves(std::string json) {
  const std::lock_guard lock(mutex_);
  curves_ = std::move(json);
}

std::string LiveBoard::curves() const {
  const std::lock_guard lock(mutex_);
  return curves_;
}

void LiveBoard::SetSightings(std::string json) {
  const std::lock_guard lock(mutex_);
  sightings_ = std::move(json);
}

std::string LiveBoard::sightings() const {
  const std::lock_guard lock(mutex_);
  return sightings_;
}

}  // namespace curvefusion
