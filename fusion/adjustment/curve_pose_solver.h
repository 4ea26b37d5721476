#pragma once

#include <array>
#include <vector>

#include "kernel/camera.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// A strip seen in a colour image: the curve passes through the line across `pixel`.
struct StripObservation {
  int frame = 0;   ///< among the frames of the problem
  int vertex = 0;  ///< of the curves
  Vec2 pixel;      ///< centre of the strip
  Vec2 normal;     ///< unit; the strip says nothing along it
};

/// Where a depth image saw the axis of a wire.
struct AxisDepthObservation {
  int frame = 0;
  int vertex = 0;
  double depth = 0;  ///< along the optical axis, metres
  double sigma = 0;  ///< metres
};

/// The unknowns: where the curves and the depth cameras are.
struct CurvePoseState {
  std::vector<Vec3> positions;                 ///< vertices of the curves
  std::vector<RigidTransform> T_camera_world;  ///< of each frame
};

/// How the errors of given poses behave: a tracker by images drifts; one that holds to surfaces
/// errs in each frame for itself, by little.
enum class PoseErrors { kDrift, kJitter };

/// Bundle adjustment of curves and poses.
struct CurvePoseProblem {
  PinholeCamera color_camera;
  RigidTransform T_color_depth = RigidTransform::Identity();
  CurvePoseState start;                       ///< what priors pull towards
  std::vector<std::array<int, 3>> rows;       ///< vertices in a row on smooth curves
  bool evens_bends = false;                   ///< whether third differences count
  std::vector<RigidTransform> T_world_given;  ///< the tracker's pose of each frame
  PoseErrors pose_errors = PoseErrors::kDrift;
  /// Frames of the video between a frame of the problem and the next, one fewer than frames; empty
  /// where views are not of a video, and where poses do not drift.
  std::vector<double> gaps;
  std::vector<StripObservation> strips;
  std::vector<StripObservation> edges;  ///< strips found by their edges, less precisely
  std::vector<AxisDepthObservation> depths;
  PinholeCamera depth_camera;
  /// The middles of what depth images show of wires: pixels of the depth camera.
  std::vector<StripObservation> depth_centres;
};

/// Distance of a strip's centre from the projected curve along the strip's normal, pixels; NaN
/// where the vertex is behind the camera.
double StripResidual(const CurvePoseProblem& problem, const CurvePoseState& state,
                     const StripObservation& strip);

/// One Gauss-Newton step from `state` for the sum of squares of strips (sigma .5 px, by their edges
/// 1.5 px, Huber beyond `huber_px`), depths and their middles (8 px), second differences of
/// vertices in a row across the curve (.3 mm; where bends are evened, third ones as well, .1 mm),
/// changes of distances of neighbours in rows (1 mm), distances from the start (vertices 12 mm;
/// poses 5 mm and .3 degrees, .8 mm and .3 degrees where they jitter) and, in a video, changes of
/// a pose's correction from frame to frame (.8 mm and .04 degrees times the square root of the
/// gap), whose first frame is held. Vertices are eliminated by a sparse factorisation; the dense
/// Schur complement of the 6 unknowns of each frame remains. Cost: vertices times frames squared.
CurvePoseState ImproveCurvesAndPoses(const CurvePoseProblem& problem, const CurvePoseState& state,
                                     double huber_px);

}  // namespace curvefusion
