#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "capture/sequence.h"
#include "fusion/appearance/curves_in_front.h"
#include "fusion/curve_graph/depth_profile.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/point_grid.h"

namespace curvefusion {

/// How much the colours of points beside a curve change from image to image: mean distances from
/// their medians, in grey levels.
struct ColourChange {
  double least = 0;  ///< in the direction around the curve in which they change least
  double most = 0;   ///< in that in which they change most; 0 = not known
};

/// What lies on some curve, as wide as its colour shows.
class OnCurves {
 public:
  /// Of places that are dense along all curves (world frame), which must outlive it.
  explicit OnCurves(const std::vector<CurvePlace>& places);

  bool Contains(const Vec3& point) const;

 private:
  const std::vector<CurvePlace>& places_;
  double reach_ = 0;  // metres, of the thickest curve
  PointGrid grid_;
};

/// The colours of points beside a curve in many images. Where a surface goes on beside the curve,
/// they are those of the surface from wherever it is seen; past a wire every image shows another
/// part of what is behind.
class ColourBeside {
 public:
  static constexpr double kPlaceStep = 0.004;  ///< metres from place to place; chosen

  /// `places` of the curve (world frame), of which every second one is looked at.
  explicit ColourBeside(const std::vector<CurvePlace>& places);

  /// Leaves out what lies beside this curve on another one, whose colour stays as a surface's does.
  void LeaveOut(const OnCurves& curves);

  /// Adds an image that has at each pixel the mean of those around it, but for what curves `hide`.
  void Look(const ColorImage& smoothed, const PinholeCamera& camera,
            const RigidTransform& T_camera_world, const CurvesInFront& hide);

  ColourChange Change() const;

 private:
  static constexpr int kDirections = 12;  // around the curve; chosen: steps of 30 degrees
  static constexpr int kDistances = 3;    // derived: those of kDistance

  struct Point {
    Vec3 position;
    bool is_on_curve = false;  // another one
    std::vector<Rgb> colours;  // of the images that show it
  };
  struct Place {
    CurvePlace on_curve;
    std::vector<Rgb> own;  // colours at the curve
    std::array<std::array<Point, kDistances>, kDirections> beside;
  };

  bool HasCurvesBeside() const;
  std::optional<double> ChangeIn(size_t direction, const Eigen::Array3d& own) const;

  std::vector<Place> places_;
};

/// The mean of the 3 x 3 pixels around each.
ColorImage Smoothed(const ColorImage& image);

/// Lines of 32 mm on the surfaces that some of the depth images show, as places 4 mm apart (world
/// frame): what colours beside them change tells how well poses and colours tell a surface.
/// Throws Error(kBadInput) for an image that cannot be decoded.
std::vector<std::vector<CurvePlace>> LinesOnSurfaces(const Sequence& sequence);

}  // namespace curvefusion
