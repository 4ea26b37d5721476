#include "experiments/simulation/limit_objects.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "experiments/simulation/curve_shapes.h"

namespace curvefusion {

namespace {

constexpr double kLength = 200;  // mm, of upright wires
constexpr double kPitch = 45;    // mm from axis to axis: far more than the paper's 17 mm
constexpr std::array<double, 7> kThicknesses = {1, 1.5, 2, 2.5, 3, 4, 6};
constexpr std::array<double, 10> kHeightLimits = {0, 5, 10, 15, 20, 30, 40, 50, 60, 80};
constexpr std::array<int, 4> kValences = {3, 4, 6, 8};

std::string Name(double value) { return fmt::format("{}", value); }

WireCurve Upright(size_t place, double diameter) {
  const double x = kPitch * static_cast<double>(place);
  return Wire({{x, 0, 0}, {x, 0, kLength}}, diameter);
}

WireCurve Tapering(size_t place, double from, double to) {
  constexpr int kPoints = 41;
  const double x = kPitch * static_cast<double>(place);
  Polyline points;
  for (const double z : Linspace(0, kLength, kPoints)) points.emplace_back(x, 0, z);
  WireCurve wire = Wire(points, (from + to) / 2);
  for (const double diameter : Linspace(from, to, kPoints)) {
    wire.diameters.push_back(diameter * kMillimetre);
  }
  return wire;
}

// Arms all around in the plane that faces the camera, in turn a little towards it and away.
void AddStar(double x, int arms, std::vector<WireCurve>& curves) {
  constexpr double kArm = 55, kThick = 5, kTilt = 0.35, kTurn = 0.25;
  for (int i = 0; i < arms; ++i) {
    const double angle = 2 * std::numbers::pi * i / arms + kTurn;
    const Vec3 direction =
        Vec3(std::cos(angle) * std::cos(kTilt), (i % 2 == 0 ? 1 : -1) * std::sin(kTilt),
             std::sin(angle) * std::cos(kTilt));
    curves.push_back(Wire({{x, 0, 0}, Vec3(x, 0, 0) + kArm * direction}, kThick));
  }
}

}  // namespace

std::vector<WireCurve> ThicknessRow() {
  std::vector<WireCurve> curves;
  for (size_t i = 0; i < kThicknesses.size(); ++i) curves.push_back(Upright(i, kThicknesses[i]));
  return curves;
}

std::vector<std::string> ThicknessPlaces() {
  std::vector<std::string> places;
  for (const double diameter : kThicknesses) places.push_back(Name(diameter));
  return places;
}

std::vector<WireCurve> RisingWires() {
  constexpr double kHalf = 140, kRow = 60, kThick = 5;
  std::vector<WireCurve> curves;
  for (const int row : {-1, 0, 1}) {
    const double up = row == 0 ? -1 : 1;  // every other one rises to the left
    curves.push_back(Wire({{-up * kHalf, row * kRow, 0}, {up * kHalf, row * kRow, 80}}, kThick));
  }
  return curves;
}

std::vector<std::string> HeightPlaces() {
  std::vector<std::string> places;
  for (size_t i = 0; i + 1 < kHeightLimits.size(); ++i) {
    places.push_back(Name((kHeightLimits[i] + kHeightLimits[i + 1]) / 2));
  }
  return places;
}

std::string HeightPlace(double height_mm) {
  for (size_t i = 0; i + 1 < kHeightLimits.size(); ++i) {
    if (height_mm >= kHeightLimits[i] && height_mm < kHeightLimits[i + 1]) {
      return HeightPlaces()[i];
    }
  }
  return "";
}

std::vector<WireCurve> Stars() {
  constexpr double kStarPitch = 140;
  std::vector<WireCurve> curves;
  for (size_t i = 0; i < kValences.size(); ++i) {
    AddStar(kStarPitch * static_cast<double>(i), kValences[i], curves);
  }
  return curves;
}

std::vector<std::string> ValencePlaces() {
  std::vector<std::string> places;
  for (const int valence : kValences) places.push_back(std::to_string(valence));
  return places;
}

std::vector<WireCurve> MixedRadii() {
  std::vector<WireCurve> curves;
  for (const double diameter : {3, 6, 9, 12}) curves.push_back(Upright(curves.size(), diameter));
  curves.push_back(Tapering(curves.size(), 3, 12));
  curves.push_back(Tapering(curves.size(), 12, 3));
  return curves;
}

std::vector<std::string> RadiusPlaces() { return {"3", "4.5", "6", "7.5", "9", "10.5", "12"}; }

}  // namespace curvefusion
