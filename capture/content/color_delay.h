#pragma once

#include <optional>

#include "capture/content/depth_agreement.h"

namespace curvefusion {

/// By how many frames the colour images come late.
struct ColorDelay {
  int frames = 0;    ///< the colour image of frame i + frames shows what the depth of i does
  double given = 0;  ///< cost as given: mean grey difference of what both frames show, over that
                     ///< without any motion
  double then = 0;   ///< likewise, with the colour images moved by `frames`
  double share = 0;  ///< of the pairs of frames that agree
};

/// Compares colour images of frames three apart where depth and poses (which must fit) say that
/// they show the same point, with colour taken up to ten frames earlier or later. None where
/// nothing but the colour as given is surely better: a camera that moves steadily, or no texture.
std::optional<ColorDelay> FindColorDelay(const DepthViews& views, const Thumbnails& thumbnails,
                                         const RigidTransform& T_color_depth,
                                         const FramePoses& poses);

}  // namespace curvefusion
