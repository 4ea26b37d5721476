#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "kernel/camera.h"

namespace curvefusion {

/// Fields of JSON files that describe cameras. All throw Error(kBadInput) that names `where`, the
/// key and the value.

/// The number under a key.
double JsonNumber(const nlohmann::json& object, const char* key, const std::string& where);

/// The side of an image under a key, at most 65,536 pixels.
int JsonPixels(const nlohmann::json& object, const char* key, const std::string& where);

/// A 4x4 matrix: 16 numbers row by row, nested or not.
Eigen::Matrix4d JsonMatrix(const nlohmann::json& value, const std::string& where);

/// Refuses a camera whose size or focal lengths are not positive, or whose principal point lies
/// outside the image.
void RequirePlausible(const PinholeCamera& camera, const std::string& where);

}  // namespace curvefusion
