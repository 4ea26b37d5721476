#pragma once

#include "capture/sequence.h"

namespace curvefusion {

struct ColourCameraOptions {
  int frames = 24;             ///< looked at, evenly spread
  int points_per_frame = 500;  ///< of depth edges
};

/// How well the edges of depth lie on edges of colour, and the colour camera for which they do.
/// Pixels are those of a 640 px wide colour image.
struct ColourCameraFit {
  int frames = 0;  ///< that show depth edges
  int points = 0;  ///< of depth edges
  bool measured =
      false;  ///< enough depth edges and colour edges were there; otherwise all below is 0
  double given_px = 0;   ///< mean distance of depth edges to colour edges, those above 20 px as 20
  double fitted_px = 0;  ///< the same for the fitted camera
  double given_share = 0;  ///< of depth edges on a colour edge, by a Gaussian of 3 px
  double fitted_share = 0;
  double held_out_gain = 0;  ///< fitted over given share on frames the fit has not seen, the lesser
  double displacement_px = 0;  ///< between given and fitted, mean over the points
  double disagreement_px = 0;  ///< the same between fits to the even and to the odd frames
  double median_depth = 0;     ///< metres, of the depth edges
  PinholeCamera color_camera;  ///< fitted; its rotation to the depth camera is the given one
  RigidTransform T_color_depth = RigidTransform::Identity();
  double f_error = 0, cx_error = 0, cy_error = 0, tx_error = 0, ty_error = 0;  ///< standard errors

  /// Whether the images are displaced by so much, so surely, that the fitted camera is the better.
  bool IsMisregistered() const;
};

/// Fits focal length, centre and offset of the colour camera to depth edges and colour edges
/// (oriented chamfer matching, coarse to fine, with a broad prior around the given camera), over
/// all frames and over two halves of them. Frames whose images cannot be read are left out. About
/// 0.2 s on two cores.
ColourCameraFit FitColourCamera(const Sequence& sequence, const ColourCameraOptions& options);

}  // namespace curvefusion
