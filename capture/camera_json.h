#pragma once

#include <nlohmann/json.hpp>

#include "kernel/camera.h"

namespace curvefusion {

/// A camera as intrinsics.json holds it.
inline nlohmann::ordered_json CameraJson(const PinholeCamera& camera) {
  return {{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
          {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
}

/// The four rows of a motion's matrix.
inline nlohmann::ordered_json RowsJson(const RigidTransform& T) {
  nlohmann::ordered_json rows;
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector4d values = T.matrix().row(row);
    rows.push_back({values[0], values[1], values[2], values[3]});
  }
  return rows;
}

}  // namespace curvefusion
