#include "fusion/trust.h"

#include <fmt/format.h>

#include "fusion/curve_graph/wire_proof.h"
#include "kernel/angle.h"

namespace curvefusion {

namespace {

// Of the length of curves from colour alone that lies near a strip. Chosen: a wire cube has .67, a
// table's legs of which nothing came out right .05 (docs/lab_notebook.md).
constexpr double kMinColourShare = 0.2;
// Of that length, how much has a measured diameter. Chosen on 11 scans by phones and time of
// flight: .56 and more where .73 and more of the curves are within 5 mm, .31 where less than half
// is.
constexpr double kMinMeasuredShare = 0.5;
// Chosen: the four shared scans, cut short where the camera has turned by 18 and 22 degrees, have
// an F2 lower by .02 to .12 and .02 to .08 than whole; by 26 and 30 mostly by less
// (docs/lab_notebook.md).
constexpr double kFewSides = 25 * kDegree;

}  // namespace

std::vector<std::string> Doubts(const Trust& trust) {
  std::vector<std::string> doubts;
  if (IsHardlyWire(trust.wire_length, trust.length)) {
    doubts.push_back(fmt::format(
        "do not trust this result: by what the images show, only about {:.0f} % of its length is "
        "wire. Scan the object from nearer and from more sides ({:.2f} m of curve, a diameter was "
        "measured on {:.0f} %)",
        100 * trust.wire_length / trust.length, trust.length, 100 * trust.measured_share));
  }
  if (trust.length > 0 && trust.measured_share == 0) {
    doubts.push_back(
        "do not trust this result: no colour image shows how thick anything of it is, as images of "
        "wires do. Scan the object from nearer, in more light");
  }
  if (trust.length > 0 && trust.from_colour && trust.colour_share < kMinColourShare) {
    doubts.push_back(fmt::format(
        "do not trust this result: its curves come from the colour images alone, and these show a "
        "strip along {:.0f} % of them only. Scan from more sides, in more light",
        100 * trust.colour_share));
  } else if (trust.from_colour && trust.measured_share > 0 &&
             trust.measured_share < kMinMeasuredShare) {
    doubts.push_back(fmt::format(
        "do not trust this result: its curves come from the colour images alone, and on {:.0f} % "
        "of them only these show how thick they are. Scan from nearer, in more light",
        100 * trust.measured_share));
  }
  return doubts;
}

std::string PlacesWarning(const Trust& trust) {
  if (!trust.is_judged() || trust.adjusted) return {};
  constexpr double kLargeShift = 3 * kMillimetre;  // chosen: what else the places are off by
  const std::string advice =
      trust.pose_shift > kLargeShift
          ? fmt::format(
                ". Poses were moved by {:.0f} mm: scan again, slower (or, where the scan "
                "came with poses, try --track)",
                trust.pose_shift / kMillimetre)
          : "";
  return "colour was not used to correct where the curves lie: places are as exact as depth and "
         "camera poses, some millimetres" +
         advice;
}

std::string ViewWarning(const Trust& trust) {
  if (!trust.is_judged() || trust.view_angle >= kFewSides) return {};
  return fmt::format(
      "the camera saw the object from {:.0f} degrees of directions only: wires that run towards "
      "it, or stand behind others, may be missing or out of place. Scan on, to the sides and from "
      "above",
      trust.view_angle / kDegree);
}

}  // namespace curvefusion
