#pragma once

#include <filesystem>
#include <vector>

#include "kernel/camera.h"
#include "kernel/image.h"

namespace curvefusion {

/// A straight wire for rendered tests.
struct RenderedWire {
  Vec3 front;
  Vec3 back;
  double diameter = 0;
  Rgb color{};  ///< at full light
};

/// What a pinhole camera sees of wires before a smooth greyish background: 5x5 rays a pixel, wires
/// darker to one side by a third, then a Gaussian blur (pixels, standard deviation).
ColorImage RenderWires(const std::vector<RenderedWire>& wires, const PinholeCamera& camera,
                       const RigidTransform& T_world_camera, double blur_px);

/// What a depth camera measures of the same wires (metres): their axes, and the wall at 1 m, with
/// wires wider than they are by `fattening_px` on both sides.
DepthImage RenderWireDepth(const std::vector<RenderedWire>& wires, const PinholeCamera& camera,
                           const RigidTransform& T_world_camera, double fattening_px);

/// An upright strip of a colour between x = left and right (pixels, fractional, pixel centres at
/// integers) on a flat background, blurred.
ColorImage DrawStrip(int width, int height, double left, double right, const Rgb& strip,
                     const Rgb& background, double blur_px);

/// Writes an image in the format of the path's extension.
void WriteImage(const std::filesystem::path& path, ColorImage image);

}  // namespace curvefusion
