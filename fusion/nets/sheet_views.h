#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "capture/sequence.h"
#include "fusion/appearance/curves_in_front.h"
#include "fusion/nets/net_sheets.h"
#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// A frame from which a sheet is seen.
struct SheetView {
  ColorImage color;
  DepthImage depth;
  RigidTransform T_camera_world;
  CurvesInFront known;  ///< wires in `color`
  double nearer = 0;    ///< metres of depth: by so much nearer ones hide the sheet
};

/// Up to 40 frames that look at a sheet not too much from the side. Depth may not show the wires of
/// the skeleton that hide it. Throws Error(kBadInput) for an image that cannot be read.
std::vector<SheetView> ViewsOfSheet(const Sequence& sequence, const SkeletonGraph& skeleton,
                                    const NetSheet& sheet);

/// What an image shows on a sheet: of every pixel of it a colour, and 1; 0 where it is hidden or
/// not in the image.
using SheetLook = Image<std::array<uint8_t, 4>>;

/// The pixels of a sheet, `step` metres apart, in the world, and which of them are known.
struct SheetPixels {
  Image<Vec3f> places;
  MaskImage known;

  SheetPixels(const NetSheet& sheet, double step);
};

/// What each of the views shows at the places, moved by so much.
std::vector<SheetLook> LookAt(const Sequence& sequence, const std::vector<SheetView>& views,
                              const SheetPixels& pixels, const Vec3& move);

/// What images agree on: the medians of their colours, and the median of how far they are from
/// those, grey levels; -1 where fewer than 5 images show a pixel.
struct SheetColours {
  std::array<Image<float>, 3> median;
  Image<float> change;
};
SheetColours ColoursOf(const std::vector<SheetLook>& looks, const MaskImage& known);

}  // namespace curvefusion
