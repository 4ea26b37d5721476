#include "capture/content/suitability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kernel/angle.h"

namespace curvefusion {

namespace {

// Reports under the name of the folder.
class Reporter {
 public:
  Reporter(const Sequence& sequence, const FindingHandler& on_finding)
      : folder_(sequence.folder.string()), on_finding_(on_finding) {}

  void Warn(const char* cause, const std::string& message) const {
    on_finding_({Severity::kWarning, folder_ + ": " + message, cause});
  }

 private:
  std::string folder_;
  const FindingHandler& on_finding_;
};

// Chosen: the narrowest and widest depth cameras are the Artec Spider (22 degrees as simulated) and
// the Azure Kinect's wide mode (120 degrees).
constexpr double kMinView = 20 * kDegree;
constexpr double kMaxView = 125 * kDegree;
// Of the image's size. Measured: at most .03 of it on ten scans; chosen: cropped images have more.
constexpr double kMaxOffCentre = 0.12;
// Measured: at most .0005 on ten scans; chosen: images squeezed from 4:3 to 5:4 have .067.
constexpr double kMaxAspectError = 0.03;

std::string SizeThatFits(const PinholeCamera& camera) {
  return fmt::format("a centre of ({:g}, {:g}) belongs to images of about {:.0f}x{:.0f}", camera.cx,
                     camera.cy, 2 * camera.cx + 1, 2 * camera.cy + 1);
}

void ReportCamera(const PinholeCamera& camera, const char* kind, const Reporter& reporter) {
  constexpr const char* kCost =
      "; points would lie in wrong places and frames not fit each other: give the intrinsics for "
      "images of this size";
  const double view = 2 * std::atan(0.5 * camera.width / camera.fx);
  const double off_x = std::abs(camera.cx - 0.5 * (camera.width - 1)) / camera.width;
  const double off_y = std::abs(camera.cy - 0.5 * (camera.height - 1)) / camera.height;
  if (std::max(off_x, off_y) > kMaxOffCentre) {
    reporter.Warn("intrinsics-implausible",
                  fmt::format("the {} camera's centre lies far off the middle of its {}x{} images: "
                              "{}{}",
                              kind, camera.width, camera.height, SizeThatFits(camera), kCost));
  } else if (view < kMinView || view > kMaxView) {
    reporter.Warn("intrinsics-implausible",
                  fmt::format("the {} camera's fx = {:g} for images {} px wide is a field of view "
                              "of {:.0f} degrees; depth cameras have 20 to 120{}",
                              kind, camera.fx, camera.width, view / kDegree, kCost));
  } else if (std::abs(camera.fx / camera.fy - 1) > kMaxAspectError) {
    reporter.Warn(
        "intrinsics-implausible",
        fmt::format("the {} camera's fx = {:g} and fy = {:g} differ by {:.0f} %; pixels "
                    "are square unless the images were stretched{}",
                    kind, camera.fx, camera.fy, 100 * std::abs(camera.fx / camera.fy - 1), kCost));
  }
}

bool AreSame(const PinholeCamera& a, const PinholeCamera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy;
}

void ReportDistortion(const PinholeCamera& camera, const Distortion& distortion, const char* kind,
                      const Reporter& reporter) {
  if (distortion.IsZero()) return;
  reporter.Warn("distortion-undone",
                fmt::format("the {} images are taken for distorted, by up to {:.1f} px, and "
                            "straightened when they are read; if the camera's driver has done so "
                            "already, leave the coefficients out of the intrinsics",
                            kind, LargestShift(camera, distortion)));
}

constexpr int kMinFrames = 12;  // chosen: half of the mug's 24 frames

// Chosen: less than hands tremble within a second (SENSORS: 4 mm, half a degree).
constexpr double kStandingExtent = 0.005;
constexpr double kStandingAngle = 1 * kDegree;
// Derived: at .7 m and f 580 half a pixel is .6 mm, from which 8 degrees make 4 mm along the ray.
constexpr double kMinParallax = 8 * kDegree;

struct Motion {
  double extent = 0;    // metres, the diagonal of the box of the camera's positions
  double turn = 0;      // radians, the largest angle to the first view
  double parallax = 0;  // radians, between directions from which the middle of the scene is seen
};

Motion MeasureMotion(const Sequence& sequence, double depth) {
  Motion motion;
  Eigen::AlignedBox3d box;
  Vec3 middle = Vec3::Zero();
  const RigidTransform& first = sequence.frames.front().T_world_camera;
  for (const SequenceFrame& frame : sequence.frames) {
    const RigidTransform& T = frame.T_world_camera;
    box.extend(Vec3(T.translation()));
    middle += T * Vec3(0, 0, depth) / sequence.frame_count();
    motion.turn =
        std::max(motion.turn, Eigen::AngleAxisd(first.linear().transpose() * T.linear()).angle());
  }
  motion.extent = box.diagonal().norm();
  std::vector<Vec3> directions;
  Vec3 mean = Vec3::Zero();
  for (const SequenceFrame& frame : sequence.frames) {
    directions.push_back((frame.T_world_camera.translation() - middle).normalized());
    mean += directions.back();
  }
  for (const Vec3& direction : directions) {
    const double cosine = std::clamp(direction.dot(mean.normalized()), -1.0, 1.0);
    motion.parallax = std::max(motion.parallax, 2 * std::acos(cosine));
  }
  return motion;
}

void ReportPath(const Sequence& sequence, double depth, const Reporter& reporter) {
  if (sequence.frame_count() < kMinFrames) {
    reporter.Warn("too-few-frames",
                  fmt::format("{} frames; wires must be seen in several to be told from noise, so "
                              "parts will be missing: take {} or more",
                              sequence.frame_count(), 5 * kMinFrames));
  }
  if (sequence.frame_count() < 2 || !(depth > 0) || !sequence.has_poses) return;
  const Motion motion = MeasureMotion(sequence, depth);
  if (motion.extent < kStandingExtent && motion.turn < kStandingAngle) {
    reporter.Warn("static-camera",
                  fmt::format("the camera stands still (all positions within {:.1f} mm): nothing "
                              "is seen from a second side, wires behind others and their depth "
                              "stay unknown; move it around the object, or check the poses",
                              motion.extent / kMillimetre));
  } else if (motion.parallax < kMinParallax) {
    reporter.Warn("path-too-short",
                  fmt::format("the views differ by {:.1f} degrees only (camera path within {:.0f} "
                              "mm, {:.2f} m away): wires' places along the view are known to "
                              "several mm only and those behind others are missing; move around "
                              "the object",
                              motion.parallax / kDegree, motion.extent / kMillimetre, depth));
  }
}

// Metres, of the nearest tenth of the depths. Derived: farther off, a wire of 5 mm covers less than
// 2.4 px of a camera of f 580, and a Kinect finds no depth on it.
constexpr double kMaxNearDepth = 1.2;
constexpr double kWire = 0.005;
// Metres. Chosen: nobody stands so far from all things that he scans.
constexpr double kRoomDepth = 2;
// Measured: .76 to .95 on ten scans; chosen: objects before a background out of range have less.
constexpr double kMinValidity = 0.15;

void ReportDepth(const Sequence& sequence, const DepthSurvey& depth, const Reporter& reporter) {
  if (depth.near > kMaxNearDepth) {
    reporter.Warn("too-far",
                  fmt::format("nine tenths of the depths are beyond {:.2f} m, where a wire of 5 mm "
                              "covers {:.1f} px: thin wires have no depth there and will be "
                              "missing; go to within 0.5 to 0.7 m{}",
                              depth.near, sequence.depth_camera.fx * kWire / depth.near,
                              depth.near > kRoomDepth
                                  ? ", or if you were nearer than that, correct the unit of depth "
                                    "(depth_scale, 1000 for mm)"
                                  : ""));
  }
  if (depth.validity > 0 && depth.validity < kMinValidity) {
    reporter.Warn("depth-sparse",
                  fmt::format("only {:.1f} % of the depth pixels are measured: wires and the "
                              "surfaces behind them will be missing; are the images registered "
                              "and the object within the sensor's range?",
                              100 * depth.validity));
  }
}

// Grey levels. Measured: medians of 55 to 140 on ten scans; chosen: below 20 the steps of 8 bits
// and noise of 3 levels are as large as the contrast of wires.
constexpr double kDark = 20;
// Measured: at most .085; chosen: a third of the image without contrast.
constexpr double kOverExposed = 0.33;
// Measured: none on ten scans, .25 on TUM fr1_rpy.
constexpr double kMaxBlurredShare = 0.25;

void ReportColour(const ColourSurvey& colour, const Reporter& reporter) {
  if (colour.frames == 0) return;
  if (colour.brightness < kDark) {
    reporter.Warn("too-dark",
                  fmt::format("the colour images are dark (median grey level {:.0f} of 255): "
                              "diameters cannot be measured and thin wires not verified; add light "
                              "or exposure",
                              colour.brightness));
  } else if (colour.bright_share > kOverExposed) {
    reporter.Warn("over-exposed",
                  fmt::format("{:.0f} % of the colour images are over-exposed: wires do not show "
                              "there, diameters and thin wires will be missing; reduce exposure",
                              100 * colour.bright_share));
  } else if (colour.IsFeatureless()) {
    reporter.Warn("no-colour",
                  "the colour images show nothing (one grey level all over): a reconstruction goes "
                  "on with depth alone, without diameters");
  } else if (colour.IsGrey()) {
    reporter.Warn("no-colour",
                  "the colour images are grey: wires cannot be told by their colour, so diameters "
                  "and thin wires may be missing");
  }
  if (colour.blurred_share > kMaxBlurredShare) {
    reporter.Warn("motion-blur",
                  fmt::format("{:.0f} % of the colour images are blurred (less than {:.0f} % as "
                              "sharp as the sharpest): diameters come out too large and thin wires "
                              "are missed; move slower or add light",
                              100 * colour.blurred_share, 60.0));
  }
}

}  // namespace

void ReportSuitability(const Sequence& sequence, const DepthSurvey& depth,
                       const ColourSurvey& colour, const FindingHandler& on_finding) {
  const Reporter reporter(sequence, on_finding);
  if (sequence.has_depth) {
    ReportCamera(sequence.depth_camera, "depth", reporter);
    ReportDistortion(sequence.depth_camera, sequence.depth_distortion, "depth", reporter);
  }
  if (!sequence.has_depth || !AreSame(sequence.depth_camera, sequence.color_camera)) {
    ReportCamera(sequence.color_camera, "colour", reporter);
    ReportDistortion(sequence.color_camera, sequence.color_distortion, "colour", reporter);
  }
  ReportPath(sequence, depth.median, reporter);
  if (sequence.has_depth) ReportDepth(sequence, depth, reporter);
  ReportColour(colour, reporter);
}

}  // namespace curvefusion
