#pragma once

#include <vector>

#include "fusion/tracking/frame_pyramid.h"
#include "fusion/tracking/normal_equations.h"

namespace curvefusion {

/// A point of a keyframe where grey changes, and its grey.
struct GreyPoint {
  Vec3f p_keyframe;  ///< in the keyframe's depth camera
  float grey = 0;
};

/// What the photometric term knows of an earlier frame, the finest level first.
struct Keyframe {
  RigidTransform T_world_camera = RigidTransform::Identity();
  double median_depth = 0;
  double contrast = 0;  ///< grey levels: robust deviation of the finest level's points
  std::vector<std::vector<GreyPoint>> levels;
};

/// The points of a frame with a depth that lies on no depth edge and with a grey that changes by
/// more than noise does; evenly thinned to a few thousand a level. `T_color_depth` maps the depth
/// camera at the time of the depth image to the colour camera at that of the colour image.
Keyframe MakeKeyframe(const TrackingFrame& frame, const RigidTransform& T_world_camera,
                      const RigidTransform& T_color_depth);

inline constexpr float kGreyMiddle = 128;  ///< derived: half of the 256 levels

/// Gain and offset of a frame's grey against a keyframe's: grey' = (1 + gain) (grey -
/// kGreyMiddle) + kGreyMiddle + offset.
struct GreyChange {
  double gain = 0;
  double offset = 0;
};

/// A keyframe's grey as the frame shows it.
inline float Changed(float grey, const GreyChange& change) {
  return static_cast<float>((1 + change.gain) * (grey - kGreyMiddle) + kGreyMiddle + change.offset);
}

/// Mean and standard deviation of grey levels.
struct GreyStatistics {
  double mean = kGreyMiddle;
  double deviation = 0;
};

/// The change between two images of the same by their statistics alone.
GreyChange ChangeBetween(const GreyStatistics& keyframe, const GreyStatistics& frame);

/// Where the photometric term sees a keyframe's points from.
struct PhotometricView {
  RigidTransform T_model_keyframe = RigidTransform::Identity();
  RigidTransform T_model_frame = RigidTransform::Identity();
  RigidTransform T_color_depth = RigidTransform::Identity();  ///< of the frame, as in MakeKeyframe
};

/// The change by the statistics of what both see, wherever the frame is by some pixels: where
/// exposure changes, the first steps would take it for motion.
GreyChange MatchGrey(const std::vector<GreyPoint>& keyframe, const FrameLevel& frame,
                     const PhotometricView& view);

/// What the photometric term adds: unknowns are those of the geometric term, gain, offset.
struct PhotometricSums {
  static constexpr int kMinPoints = 100;  ///< chosen for eight unknowns

  NormalEquations<8> equations;
  int points = 0;        ///< of the keyframe that the frame sees
  double deviation = 0;  ///< robust standard deviation of their grey differences
};

/// Direct image alignment (Kerl et al. 2013: residuals are grey differences at points of a keyframe
/// whose depth is known), weighted by Tukey's function, whose limit follows their own robust
/// deviation.
PhotometricSums PhotometricTerm(const std::vector<GreyPoint>& keyframe, const FrameLevel& frame,
                                const PhotometricView& view, const GreyChange& change);

}  // namespace curvefusion
