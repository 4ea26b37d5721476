#include "apps/run_account.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/angle.h"
#include "kernel/geometry.h"

namespace curvefusion {

namespace {

// Grey levels between the largest and the least of R, G and B: 0 in grey images; measured 23 to 31
// on average in cubeframe, lampshade, cable and kitchen. Chosen near the former.
constexpr double kGreyChroma = 4;

// 34,017
std::string Grouped(int64_t number) {
  std::string text = std::to_string(number);
  for (auto i = static_cast<std::ptrdiff_t>(text.size()) - 3; i > 0; i -= 3) {
    text.insert(static_cast<size_t>(i), 1, ',');
  }
  return text;
}

// A rule and what it took of what came to it.
struct Loss {
  double taken = 0;
  std::string sentence;
};

Loss LargestLoss(const std::vector<Loss>& losses) {
  return *std::max_element(losses.begin(), losses.end(),
                           [](const Loss& a, const Loss& b) { return a.taken < b.taken; });
}

std::string LostPoints(const PointFunnel& points) {
  const auto loss = [&](int64_t taken, const char* how) {
    return Loss{static_cast<double>(taken), fmt::format("{} of {} candidates {}", Grouped(taken),
                                                        Grouped(points.merged_points), how)};
  };
  const char* unverified = points.chroma < kGreyChroma
                               ? "fell to the colour check; the images are nearly grey"
                               : "fell to the colour check: no edges in the colour images where "
                                 "they end; are colour and depth taken together?";
  return LargestLoss({loss(points.too_few_frames,
                           "were seen in too few images one after another; move slower, or check "
                           "the poses"),
                      loss(points.small_clusters, "stood in clusters too small for a thin part"),
                      loss(points.unverified, unverified),
                      loss(points.isolated, "stood far from all others")})
      .sentence;
}

std::string LostCurves(const CurveFunnel& curves) {
  const auto loss = [&](double taken, const char* how) {
    return Loss{taken,
                fmt::format("{:.2f} of {:.2f} m of curve {}", taken, curves.contracted, how)};
  };
  return LargestLoss(
             {loss(curves.unproven.surface, "were the edges of surfaces"),
              loss(curves.unproven.thick, "were thicker than wires are"),
              loss(curves.unproven.looked_past, "lie where the depth images see what is behind"),
              loss(curves.unproven.unproven,
                   "could not be told to be wires (evidence.min_probability)"),
              loss(curves.looked_past, "lie where the colour images show what is behind")})
      .sentence;
}

std::string Percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

}  // namespace

std::string TrustLines(const Trust& trust) {
  const std::string residual =
      trust.adjusted
          ? fmt::format(", curves {:.2f} px beside their strips in colour ({:.2f} before)",
                        trust.residual_px, trust.residual_before_px)
          : ", not adjusted to colour";
  return fmt::format(
      "  evidence  diameter measured on {} of the length, seen in depth on {}, in colour on {}, "
      "from {:.0f} degrees of directions\n"
      "  poses     moved by {:.1f} mm and {:.2f} degrees (median), {:.1f} mm at most{}\n",
      Percent(trust.measured_share), Percent(trust.depth_share), Percent(trust.colour_share),
      trust.view_angle / kDegree, trust.pose_shift / kMillimetre, trust.pose_turn / kDegree,
      trust.max_pose_shift / kMillimetre, residual);
}

std::string UncertainLine(const UnprovenLengths& lengths) {
  constexpr double kShown = 0.005;  // metres: what two decimals show
  std::string reasons;
  const auto add = [&](double length, const char* reason) {
    if (length < kShown) return;
    reasons += fmt::format("{}{:.2f} m {}", reasons.empty() ? "" : ", ", length, reason);
  };
  add(lengths.surface, "edges of surfaces");
  add(lengths.thick, "too thick");
  add(lengths.looked_past, "where depth sees what is behind");
  add(lengths.unproven, "without enough evidence");
  if (reasons.empty()) return "";
  return fmt::format("  left out  {:.2f} m that are no proven wires: {}\n", lengths.Sum(), reasons);
}

std::string WhyNothing(const Funnel& funnel) {
  const PointFunnel& points = funnel.points;
  if (points.depth_pixels == 0) return "no depth image has a depth";
  if (points.thin_pixels == 0) {
    return fmt::format("none of {} depth pixels lies in front of the large surfaces",
                       Grouped(points.depth_pixels));
  }
  if (points.gated_pixels == 0) {
    return fmt::format(
        "all of {} pixels in front of large surfaces have the colour of what is "
        "behind them",
        Grouped(points.thin_pixels));
  }
  if (points.points == 0) return LostPoints(points);
  if (funnel.curves.contracted <= 0) {
    return fmt::format("{} points remained of {} candidates, but they lie along no curve",
                       Grouped(points.points), Grouped(points.merged_points));
  }
  return LostCurves(funnel.curves);
}

std::string WhyNothing(const Reconstruction& reconstruction) {
  if (reconstruction.sequence.has_depth) return WhyNothing(reconstruction.funnel);
  return "the colour images agree on no curve that what they show beside it proves to be a wire";
}

}  // namespace curvefusion
