#include "capture/distortion_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {

namespace {

using nlohmann::json;

constexpr std::array<const char*, 5> kCoefficients = {"k1", "k2", "p1", "p2",
                                                      "k3"};  // OpenCV's order
constexpr std::array<const char*, 11> kForeignCoefficients = {
    "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tauX", "tauY", "omega", "xi"};
constexpr std::array<const char*, 3> kModelKeys = {"model", "distortion_model", "camera_model"};
// Names of the same model, as ROS, RealSense, Kalibr and COLMAP have them, in letters only; a
// rational polynomial is refused by its further coefficients.
constexpr std::array<const char*, 10> kModels = {
    "brownconrady", "plumbbob", "radtan", "radialtangential", "opencv",
    "pinhole",      "none",     "brown",  "perspective",      "rationalpolynomial"};
// Derived: half the corner's radius is about a quarter of the image's area, less than any use
// needs.
constexpr double kMinValidShare = 0.5;
constexpr double kMaxShiftShare = 0.5;  // of the width; chosen: no lens of 110 degrees does that

[[noreturn]] void Fail(const std::string& message) { throw Error(ErrorKind::kBadInput, message); }

double Coefficient(const json& value, const std::string& where, const std::string& key) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    Fail(fmt::format("{}: '{}' is {}, a number is needed", where, key, value.dump()));
  }
  return value.get<double>();
}

constexpr const char* kSupported =
    "only Brown-Conrady with k1, k2, p1, p2, k3 is undone, and with k4, k5, k6 in a list of 8; "
    "undistort the images and leave the coefficients out";

// OpenCV's list, with the denominator of the rational model or without.
Distortion FromList(const json& list, const std::string& where) {
  if (!list.is_array() || list.size() < 4) {
    Fail(
        fmt::format("{}: 'distortion' must be a list of 4, 5 or 8 numbers: k1, k2, p1, p2, k3, "
                    "k4, k5, k6",
                    where));
  }
  std::array<double, 8> c{};
  for (size_t i = 0; i < list.size(); ++i) {
    const double value = Coefficient(list[i], where, "distortion");
    if (i < 5 || (i < c.size() && list.size() >= c.size())) {
      c[i] = value;
    } else if (value != 0) {
      Fail(fmt::format("{}: 'distortion' has {} coefficients; {}", where, list.size(), kSupported));
    }
  }
  return {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]};
}

Distortion FromKeys(const json& object, const std::string& where) {
  std::array<double, kCoefficients.size()> c{};
  for (size_t i = 0; i < c.size(); ++i) {
    const auto value = object.find(kCoefficients[i]);
    if (value != object.end()) c[i] = Coefficient(*value, where, kCoefficients[i]);
  }
  return {c[0], c[1], c[2], c[3], c[4]};
}

void RequireKnownCoefficients(const json& object, const std::string& where) {
  for (const char* key : kForeignCoefficients) {
    const auto value = object.find(key);
    if (value == object.end() || (value->is_number() && value->get<double>() == 0)) continue;
    Fail(
        fmt::format("{}: '{}' is a coefficient of another lens model; {}", where, key, kSupported));
  }
}

void RequireKnownModel(const json& object, const std::string& where) {
  for (const char* key : kModelKeys) {
    const auto value = object.find(key);
    if (value == object.end() || !value->is_string()) continue;
    std::string name;
    for (const char letter : value->get<std::string>()) {
      if (std::isalpha(static_cast<unsigned char>(letter)) != 0) {
        name += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
      }
    }
    if (std::find(kModels.begin(), kModels.end(), name) != kModels.end()) continue;
    Fail(fmt::format("{}: '{}' is {}; {}", where, key, value->dump(), kSupported));
  }
}

// The centre and offset of a camera without distortion do not depend on the model's name.
bool HasCoefficients(const json& object) {
  const auto list = object.find("distortion");
  if (list != object.end() && list->is_array()) {
    return std::any_of(list->begin(), list->end(), [](const json& value) { return value != 0; });
  }
  return std::any_of(kCoefficients.begin(), kCoefficients.end(),
                     [&](const char* key) { return object.contains(key) && object[key] != 0; });
}

// Lenses that no coefficients make a pinhole.
bool IsFisheye(const json& object) {
  return std::any_of(kModelKeys.begin(), kModelKeys.end(), [&](const char* key) {
    const auto value = object.find(key);
    if (value == object.end() || !value->is_string()) return false;
    std::string name = value->get<std::string>();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return name.find("fisheye") != std::string::npos || name.find("equi") != std::string::npos ||
           name.find("omni") != std::string::npos;
  });
}

const std::vector<std::string>& KnownKeys() {
  static const std::vector<std::string> known = {"width",
                                                 "height",
                                                 "fx",
                                                 "fy",
                                                 "cx",
                                                 "cy",
                                                 "depth_scale",
                                                 "color_camera",
                                                 "T_color_depth",
                                                 "distortion",
                                                 "k1",
                                                 "k2",
                                                 "p1",
                                                 "p2",
                                                 "k3",
                                                 "model",
                                                 "distortion_model",
                                                 "camera_model"};
  return known;
}

}  // namespace

void RequireUnfolded(const PinholeCamera& camera, const Distortion& distortion,
                     const std::string& where) {
  const double corner = CornerRadius(camera);
  if (!(distortion.ValidRadius(corner) >= kMinValidShare * corner &&
        LargestShift(camera, distortion) <= kMaxShiftShare * camera.width)) {
    Fail(fmt::format(
        "{}: the distortion k1 = {}, k2 = {}, p1 = {}, p2 = {}, k3 = {}{} folds the image "
        "over or moves pixels by half the image; the coefficients are those of OpenCV, "
        "in the order k1, k2, p1, p2, k3",
        where, distortion.k1, distortion.k2, distortion.p1, distortion.p2, distortion.k3,
        distortion.IsRational() ? fmt::format(", k4 = {}, k5 = {}, k6 = {}", distortion.k4,
                                              distortion.k5, distortion.k6)
                                : std::string()));
  }
}

Distortion ParseDistortion(const json& object, const PinholeCamera& camera,
                           const std::string& where) {
  RequireKnownCoefficients(object, where);
  if (HasCoefficients(object) || IsFisheye(object)) RequireKnownModel(object, where);
  const Distortion distortion = object.contains("distortion")
                                    ? FromList(object["distortion"], where)
                                    : FromKeys(object, where);
  RequireUnfolded(camera, distortion, where);
  return distortion;
}

void ReportUnknownKeys(const json& object, const std::string& where,
                       const FindingHandler& on_finding) {
  const std::vector<std::string>& known = KnownKeys();
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    if (std::find(kForeignCoefficients.begin(), kForeignCoefficients.end(), key) !=
        kForeignCoefficients.end()) {
      continue;
    }
    if (!value.is_number() && !value.is_structured()) continue;  // a remark in words
    on_finding({Severity::kWarning,
                fmt::format("{}: the key '{}' is not known and is ignored; did you mean {}?", where,
                            key, NearestName(key, known)),
                "unknown-key"});
  }
}

}  // namespace curvefusion
