#include "fusion/adjustment/color_shift.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace curvefusion {

namespace {

// Chosen, in pixels of depth images, on 17 simulated training scans whose shifts are known and on
// how well 48 lie in their place (docs/lab_notebook.md#gauge-freedom-where-the-world-lies).
constexpr double kShiftPx = 2;         // standard deviation that is expected
constexpr double kFrameShiftPx = 0.5;  // likewise, from frame to frame
constexpr double kFatteningPx = 2;     // that is expected of block matching
constexpr double kFatteningSigmaPx = 1;
constexpr double kEdgeSigmaPx = 2;      // more than it scatters, for neighbours err alike
constexpr double kCommonErrorPx = 0.2;  // of all edges, as by light from one side
constexpr double kMaxErrorPx = 2;       // farther off an edge is left out
constexpr int kRounds = 4;

// Shift and fattening.
using Unknowns = Vec3;

Unknowns Row(const StripEdge& edge) { return {-edge.normal.x(), -edge.normal.y(), 1}; }

Unknowns EstimateTogether(const std::vector<StripEdge>& edges) {
  const Unknowns expected(0, 0, kFatteningPx);
  Unknowns x = expected;
  for (int round = 0; round < kRounds; ++round) {
    const double max_error = round == 0 ? 2 * kMaxErrorPx : kMaxErrorPx;
    Mat3 matrix = Mat3::Zero();
    Unknowns rhs = Unknowns::Zero();
    int count = 0;
    for (const StripEdge& edge : edges) {
      const Unknowns row = Row(edge);
      if (std::abs(edge.beyond_px - row.dot(x)) > max_error) continue;
      matrix += row * row.transpose();
      rhs += edge.beyond_px * row;
      ++count;
    }
    const double variance = kEdgeSigmaPx * kEdgeSigmaPx + count * kCommonErrorPx * kCommonErrorPx;
    const double weight = variance / (kShiftPx * kShiftPx);
    const Unknowns weights(weight, weight, std::pow(kEdgeSigmaPx / kFatteningSigmaPx, 2));
    matrix.diagonal() += weights;
    x = matrix.llt().solve(rhs + weights.cwiseProduct(expected));
  }
  return x;
}

// The shifts of the frames besides what all share, from `result` on.
void EstimateEach(const std::vector<StripEdge>& edges, const Unknowns& together,
                  ColorShift& result) {
  const size_t frame_count = result.of_frames_px.size();
  const double weight = std::pow(kEdgeSigmaPx / kFrameShiftPx, 2);
  std::vector<Eigen::Matrix2d> matrices(frame_count, weight * Eigen::Matrix2d::Identity());
  std::vector<Vec2> rhs(frame_count, Vec2::Zero());
  for (const StripEdge& edge : edges) {
    const double error = edge.beyond_px - Row(edge).dot(together);
    const double own = -edge.normal.dot(result.of_frames_px[edge.frame]);
    if (std::abs(error - own) > kMaxErrorPx) continue;
    matrices[edge.frame] += edge.normal * edge.normal.transpose();
    rhs[edge.frame] -= error * edge.normal;
  }
  for (size_t frame = 0; frame < frame_count; ++frame) {
    const Eigen::Matrix2d inverse = matrices[frame].inverse();
    result.of_frames_px[frame] = inverse * rhs[frame];
    result.frame_sigmas_px[frame] = kEdgeSigmaPx * inverse.diagonal().cwiseSqrt();
  }
}

}  // namespace

ColorShift EstimateColorShift(const std::vector<StripEdge>& edges, int frame_count) {
  const Unknowns together = EstimateTogether(edges);
  ColorShift result;
  result.shift_px = together.head<2>();
  result.of_frames_px.assign(frame_count, Vec2::Zero());
  result.frame_sigmas_px.assign(frame_count, Vec2::Zero());
  for (int round = 0; round < 2; ++round) EstimateEach(edges, together, result);
  return result;
}

}  // namespace curvefusion
