#include "experiments/studies/limit_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "experiments/metrics/curve_metrics.h"
#include "experiments/simulation/limit_objects.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

constexpr double kFound = 5 * kMillimetre;  // as F5
constexpr double kHubReach = 20 * kMillimetre;
constexpr int kJunction = 3;  // curve ends that meet

// The share of the true samples with each name that lies within 5 mm of the result.
std::map<std::string, double> RecallBy(const std::function<std::string(size_t)>& name_of,
                                       const std::vector<std::string>& names,
                                       const SkeletonSamples& truth, const SkeletonGraph& result) {
  const std::vector<Vec3> found = SampleSkeleton(result).positions;
  const std::vector<double> distances = found.empty() ? std::vector<double>(truth.size(), HUGE_VAL)
                                                      : DistancesTo(truth.positions, found);
  std::map<std::string, double> shares;
  for (const std::string& name : names) {
    double all = 0, near = 0;
    for (size_t i = 0; i < truth.size(); ++i) {
      if (name_of(i) != name) continue;
      all += truth.lengths[i];
      near += distances[i] <= kFound ? truth.lengths[i] : 0;
    }
    if (all > 0) shares[name] = near / all;
  }
  return shares;
}

std::string NearestPlace(double value, const std::vector<std::string>& places) {
  return *std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
    return std::abs(std::stod(a) - value) < std::abs(std::stod(b) - value);
  });
}

double TableHeight(const SkeletonSamples& truth) {
  double least = HUGE_VAL;
  for (size_t i = 0; i < truth.size(); ++i) {
    least = std::min(least, truth.positions[i].z() - truth.radii[i]);
  }
  return least;
}

// Valences of the result's junctions about a true one.
std::vector<int> ValencesNear(const SkeletonGraph& result, const Vec3& hub) {
  std::vector<int> valences;
  for (const NodeId node : result.Nodes()) {
    const int valence = result.Degree(node);
    if (valence < kJunction) continue;
    if ((result.position(node) - hub).norm() <= kHubReach) valences.push_back(valence);
  }
  return valences;
}

std::map<std::string, double> OfHubs(
    const SkeletonGraph& result, const SkeletonGraph& truth,
    const std::function<double(const std::vector<int>&, int)>& figure) {
  std::map<std::string, double> values;
  for (const NodeId node : truth.Nodes()) {
    const int valence = truth.Degree(node);
    if (valence < kJunction) continue;
    values[fmt::format("{}", valence)] =
        figure(ValencesNear(result, truth.position(node)), valence);
  }
  return values;
}

}  // namespace

std::map<std::string, double> RecallByThickness(const SkeletonGraph& result,
                                                const SkeletonGraph& truth) {
  const SkeletonSamples samples = SampleSkeleton(truth);
  const std::vector<std::string> places = ThicknessPlaces();
  return RecallBy(
      [&](size_t i) { return NearestPlace(2 * samples.radii[i] / kMillimetre, places); }, places,
      samples, result);
}

std::map<std::string, double> RecallByHeight(const SkeletonGraph& result,
                                             const SkeletonGraph& truth) {
  const SkeletonSamples samples = SampleSkeleton(truth);
  const double table = TableHeight(samples);
  return RecallBy(
      [&](size_t i) { return HeightPlace((samples.positions[i].z() - table) / kMillimetre); },
      HeightPlaces(), samples, result);
}

std::map<std::string, double> JunctionsAtHubs(const SkeletonGraph& result,
                                              const SkeletonGraph& truth) {
  return OfHubs(result, truth, [](const std::vector<int>& valences, int) {
    return static_cast<double>(valences.size());
  });
}

std::map<std::string, double> WholeHubs(const SkeletonGraph& result, const SkeletonGraph& truth) {
  return OfHubs(result, truth, [](const std::vector<int>& valences, int true_valence) {
    return valences == std::vector<int>{true_valence} ? 1.0 : 0.0;
  });
}

std::map<std::string, double> DiameterByTruth(const SkeletonGraph& result,
                                              const SkeletonGraph& truth) {
  const SkeletonSamples samples = SampleSkeleton(result);
  const SkeletonSamples wires = SampleSkeleton(truth);
  const PointIndex index(wires.positions);
  const std::vector<std::string> places = RadiusPlaces();
  std::map<std::string, double> sums, lengths;
  for (size_t i = 0; i < samples.size(); ++i) {
    const int nearest = index.Nearest(samples.positions[i]);
    if (nearest < 0 || samples.radii[i] <= 0) continue;
    if ((wires.positions[nearest] - samples.positions[i]).norm() > kCurveReach) continue;
    const std::string place = NearestPlace(2 * wires.radii[nearest] / kMillimetre, places);
    sums[place] += samples.lengths[i] * 2 * samples.radii[i] / kMillimetre;
    lengths[place] += samples.lengths[i];
  }
  for (auto& [place, sum] : sums) sum /= lengths[place];
  return sums;
}

}  // namespace curvefusion
