#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "capture/sequence.h"
#include "graph/skeleton_graph.h"
#include "kernel/image.h"

namespace curvefusion {

/// The frames that report.html shows, ascending: of each of `count` equal stretches of the sequence
/// the one that sees most of the graph, among at most ten evenly spread ones.
std::vector<int> ShownFrames(const SkeletonGraph& graph, const Sequence& sequence, int count);

/// A colour image, at most 640 pixels wide, and the camera that took it.
struct PageFrame {
  std::string name;
  std::string image;     ///< a data URL
  PinholeCamera camera;  ///< of this image
  RigidTransform T_camera_world;
};

/// Throws Error(kBadInput) for an image that cannot be decoded.
PageFrame MakePageFrame(const Sequence& sequence, int frame);

/// `name`, `image`, `width`, `height`, `fx`, `fy`, `cx`, `cy`, `T_camera_world` (three rows of
/// four, millimetres).
nlohmann::ordered_json FrameJson(const PageFrame& frame);

/// A picture as a data URL with a JPEG of at most this width; empty for an empty picture.
std::string JpegUrl(const ColorImage& picture, int max_width);

}  // namespace curvefusion
