#include "capture/json_fields.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "kernel/error.h"

namespace curvefusion {

using nlohmann::json;

namespace {

[[noreturn]] void Fail(const std::string& message) { throw Error(ErrorKind::kBadInput, message); }

void AppendNumbers(const json& value, std::vector<double>& numbers) {
  if (value.is_number()) numbers.push_back(value.get<double>());
  if (!value.is_array()) return;
  for (const json& entry : value) AppendNumbers(entry, numbers);
}

}  // namespace

double JsonNumber(const json& object, const char* key, const std::string& where) {
  const auto value = object.find(key);
  if (value == object.end()) Fail(fmt::format("{}: '{}' is missing", where, key));
  if (!value->is_number()) {
    Fail(fmt::format("{}: '{}' is {}, a number is needed", where, key, value->dump()));
  }
  return value->get<double>();
}

// The size of an image; RequirePlausible refuses what is not positive.
int JsonPixels(const json& object, const char* key, const std::string& where) {
  constexpr double kMaxPixels = 65536;
  const double value = JsonNumber(object, key, where);
  if (!(std::abs(value) <= kMaxPixels)) {
    Fail(fmt::format("{}: '{}' is {}; an image has at most {} pixels a side", where, key, value,
                     kMaxPixels));
  }
  return static_cast<int>(value);
}

void RequirePlausible(const PinholeCamera& camera, const std::string& where) {
  if (camera.width <= 0 || camera.height <= 0) {
    Fail(fmt::format("{}: the image size is {}x{}; width and height must be positive", where,
                     camera.width, camera.height));
  }
  if (!(camera.fx > 0 && camera.fy > 0)) {
    Fail(fmt::format("{}: fx = {}, fy = {}; focal lengths in pixels must be positive", where,
                     camera.fx, camera.fy));
  }
  if (!camera.Contains({camera.cx, camera.cy})) {
    Fail(
        fmt::format("{}: the principal point ({}, {}) lies outside the {}x{} image; it is given in "
                    "pixels of the full image",
                    where, camera.cx, camera.cy, camera.width, camera.height));
  }
}

Eigen::Matrix4d JsonMatrix(const json& value, const std::string& where) {
  std::vector<double> numbers;
  AppendNumbers(value, numbers);
  if (numbers.size() != 16) {
    Fail(fmt::format("{}: a 4x4 matrix of 16 numbers is needed, {} are there", where,
                     numbers.size()));
  }
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
}

}  // namespace curvefusion
