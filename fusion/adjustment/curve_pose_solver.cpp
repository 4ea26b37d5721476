#include "fusion/adjustment/curve_pose_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "fusion/registration/pose_correction.h"
#include "fusion/strips/strip_samples.h"
#include "kernel/angle.h"
#include "kernel/parallel.h"
#include "kernel/rigid_motion.h"

namespace curvefusion {

namespace {

using Row6 = Eigen::Matrix<double, 1, 6>;
using Row3 = Eigen::RowVector3d;

// Measured: strips are off from the true axis by .1 to .4 px in the median, single edges by up to
// .98 px (docs/lab_notebook.md#strips-found-by-their-edges).
constexpr double kStripSigmaPx = 0.5;
constexpr double kEdgeSigmaPx = 1.5;
// chosen (chair 3, legs 1, cage 2, cubeframe; 2 and 5 draw what colour tells aside): so little does
// the depth of one frame tell, as it errs on the same side of a wire in many.
constexpr double kDepthCentreSigmaPx = 8;
constexpr double kBendSigma = 0.3 * kMillimetre;  // of a second difference, steps of 3 mm
// Of a third difference. Chosen: by .03 mm the real cable's few strips no longer hold it.
constexpr double kKinkSigma = 0.1 * kMillimetre;
// Chosen: sine of the turn in a step of 3 mm, a radius of 10 mm. Without it the corners of the
// paper's cat, which contraction cuts, stay cut.
constexpr double kSharp = 0.3;
// chosen: .3 holds wrong spacings of the start (test OutliersAreHeldOff).
constexpr double kStretchSigma = 1 * kMillimetre;  // of a step's length
constexpr double kVertexSigma = 12 * kMillimetre;

// Standard deviations of translation and rotation.
struct PoseSigma {
  double translation;
  double rotation;

  SmallMotion Weights(double variance_factor) const {
    SmallMotion weights;
    weights << Vec3::Constant(1 / (translation * translation * variance_factor)),
        Vec3::Constant(1 / (rotation * rotation * variance_factor));
    return weights;
  }
};

constexpr PoseSigma kPoseSigma = {5 * kMillimetre, 0.3 * kDegree};
// Measured on eight simulated scans of an Azure Kinect and a D400: .9 to 1 mm in all, .09 degrees
// from frame to frame.
constexpr PoseSigma kJitterSigma = {0.8 * kMillimetre, 0.3 * kDegree};
constexpr PoseSigma kLinkSigma = {0.8 * kMillimetre, 0.04 * kDegree};
constexpr PoseSigma kFirstSigma = {0.2 * kMillimetre, 0.01 * kDegree};

// The normal equations of all terms: blocks of single vertices, what couples rows of vertices,
// poses, and what couples vertices with poses.
class NormalEquations {
 public:
  NormalEquations(int vertices, int frames)
      : vertex_blocks_(vertices, Mat3::Zero()),
        vertex_rhs_(Eigen::VectorXd::Zero(3 * vertices)),
        pose_matrix_(Eigen::MatrixXd::Zero(6 * frames, 6 * frames)),
        pose_rhs_(Eigen::VectorXd::Zero(6 * frames)),
        coupling_(Eigen::MatrixXd::Zero(3 * vertices, 6 * frames)) {}

  // weight (residual + by_vertex dv + by_pose dp)^2.
  void AddObservation(int vertex, int frame, const Row3& by_vertex, const Row6& by_pose,
                      double residual, double weight) {
    vertex_blocks_[vertex] += weight * by_vertex.transpose() * by_vertex;
    vertex_rhs_.segment<3>(3 * vertex) -= weight * residual * by_vertex.transpose();
    pose_matrix_.block<6, 6>(6 * frame, 6 * frame) += weight * by_pose.transpose() * by_pose;
    pose_rhs_.segment<6>(6 * frame) -= weight * residual * by_pose.transpose();
    coupling_.block<3, 6>(3 * vertex, 6 * frame) += weight * by_vertex.transpose() * by_pose;
  }

  // weight |residual + dv|^2.
  void AddVertexPrior(int vertex, const Vec3& residual, double weight) {
    vertex_blocks_[vertex] += weight * Mat3::Identity();
    vertex_rhs_.segment<3>(3 * vertex) -= weight * residual;
  }

  // weight |residual + sum of by_vertex dv|^2.
  template <size_t N>
  void AddRow(const std::array<int, N>& row, const Vec3& residual,
              const std::array<Mat3, N>& by_vertex, double weight) {
    for (size_t i = 0; i < N; ++i) {
      vertex_rhs_.segment<3>(3 * row[i]) -= weight * by_vertex[i].transpose() * residual;
      for (size_t j = 0; j < N; ++j) {
        if (row[j] > row[i]) continue;
        const Mat3 block = weight * by_vertex[i].transpose() * by_vertex[j];
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < (i == j ? k + 1 : 3); ++l)
            row_entries_.emplace_back(3 * row[i] + k, 3 * row[j] + l, block(k, l));
      }
    }
  }

  // sum of weights times (residual + dp)^2.
  void AddPosePrior(int frame, const SmallMotion& residual, const SmallMotion& weights) {
    pose_matrix_.diagonal().segment<6>(6 * frame) += weights;
    pose_rhs_.segment<6>(6 * frame) -= weights.cwiseProduct(residual);
  }

  // sum of weights times (residual + dq - dp)^2 for a frame p and the next, q.
  void AddLink(int frame, const SmallMotion& residual, const SmallMotion& weights) {
    AddPosePrior(frame, -residual, weights);
    AddPosePrior(frame + 1, residual, weights);
    pose_matrix_.block<6, 6>(6 * frame, 6 * frame + 6).diagonal() -= weights;
    pose_matrix_.block<6, 6>(6 * frame + 6, 6 * frame).diagonal() -= weights;
  }

  // Solves for all changes: vertices, then poses.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> Solve() {
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> vertex_factor(VertexMatrix());
    assert(vertex_factor.info() == Eigen::Success);  // every vertex has a prior
    const auto& permutation = vertex_factor.permutationP();
    const Eigen::VectorXd reduced_rhs =
        vertex_factor.matrixL().solve(Eigen::VectorXd(permutation * vertex_rhs_));
    const Eigen::MatrixXd reduced = ReduceCoupling(vertex_factor);
    SubtractGram(reduced);
    const Eigen::VectorXd poses = pose_matrix_.selfadjointView<Eigen::Lower>().llt().solve(
        Eigen::VectorXd(pose_rhs_ - reduced.transpose() * reduced_rhs));
    const Eigen::VectorXd vertices =
        vertex_factor.solve(Eigen::VectorXd(vertex_rhs_ - coupling_ * poses));
    return {vertices, poses};
  }

 private:
  using Factor = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>;

  Eigen::SparseMatrix<double> VertexMatrix() const {
    std::vector<Eigen::Triplet<double>> lower = row_entries_;
    for (size_t v = 0; v < vertex_blocks_.size(); ++v) {
      const int first = 3 * static_cast<int>(v);
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j)
          lower.emplace_back(first + i, first + j, vertex_blocks_[v](i, j));
      }
    }
    const auto n = static_cast<Eigen::Index>(3 * vertex_blocks_.size());
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(lower.begin(), lower.end());
    return matrix;
  }

  // The columns of inverse(L) P coupling.
  Eigen::MatrixXd ReduceCoupling(const Factor& factor) const {
    Eigen::MatrixXd reduced(coupling_.rows(), coupling_.cols());
    ParallelFor(0, coupling_.cols() / 6, 1, [&](int64_t frame) {
      reduced.middleCols<6>(6 * frame) = factor.matrixL().solve(
          Eigen::MatrixXd(factor.permutationP() * coupling_.middleCols<6>(6 * frame)));
    });
    return reduced;
  }

  // Makes the lower triangle of the pose matrix its Schur complement.
  void SubtractGram(const Eigen::MatrixXd& reduced) {
    constexpr int64_t kColumns = 48;  // chosen: of eight frames, for one task
    const int64_t n = reduced.cols();
    ParallelFor(0, (n + kColumns - 1) / kColumns, 1, [&](int64_t block) {
      const int64_t first = block * kColumns;
      const int64_t count = std::min(kColumns, n - first);
      pose_matrix_.block(first, first, n - first, count).noalias() -=
          reduced.rightCols(n - first).transpose() * reduced.middleCols(first, count);
    });
  }

  std::vector<Mat3> vertex_blocks_;
  Eigen::VectorXd vertex_rhs_;
  std::vector<Eigen::Triplet<double>> row_entries_;  // lower triangle
  Eigen::MatrixXd pose_matrix_;
  Eigen::VectorXd pose_rhs_;
  Eigen::MatrixXd coupling_;
};

// A camera that sees strips; poses are the depth camera's.
struct StripCamera {
  const PinholeCamera& camera;
  RigidTransform T_camera_depth;
};

StripCamera ColorCamera(const CurvePoseProblem& problem) {
  return {problem.color_camera, problem.T_color_depth};
}

// See StripResidual.
double ResidualIn(const StripCamera& by, const CurvePoseState& state,
                  const StripObservation& strip) {
  const Vec3 p =
      by.T_camera_depth * (state.T_camera_world[strip.frame] * state.positions[strip.vertex]);
  if (p.z() < PinholeCamera::kNearest) return std::numeric_limits<double>::quiet_NaN();
  return strip.normal.dot(strip.pixel - by.camera.Project(p));
}

void AddStrips(const StripCamera& by, const CurvePoseState& state,
               const std::vector<StripObservation>& strips, double sigma_px, double huber_px,
               NormalEquations& equations) {
  for (const StripObservation& strip : strips) {
    const double residual = ResidualIn(by, state, strip);
    if (std::isnan(residual)) continue;
    const RigidTransform& T_camera_world = state.T_camera_world[strip.frame];
    const Vec3 p_camera = T_camera_world * state.positions[strip.vertex];
    const Row3 by_point = -strip.normal.transpose() *
                          ProjectionJacobian(by.camera, by.T_camera_depth * p_camera) *
                          by.T_camera_depth.linear();
    Row6 by_pose;
    by_pose << by_point, -by_point * CrossMatrix(p_camera);
    const double robust = std::min(1.0, huber_px / std::max(1e-12, std::abs(residual)));
    equations.AddObservation(strip.vertex, strip.frame, by_point * T_camera_world.linear(), by_pose,
                             residual, robust / (sigma_px * sigma_px));
  }
}

void AddDepths(const CurvePoseProblem& problem, const CurvePoseState& state,
               NormalEquations& equations) {
  for (const AxisDepthObservation& seen : problem.depths) {
    const RigidTransform& T_camera_world = state.T_camera_world[seen.frame];
    const Vec3 p_camera = T_camera_world * state.positions[seen.vertex];
    const double residual = p_camera.z() - seen.depth;
    const Row3 by_point = Row3::UnitZ();
    Row6 by_pose;
    by_pose << by_point, -by_point * CrossMatrix(p_camera);
    const double robust = std::min(1.0, 2 * seen.sigma / std::max(1e-12, std::abs(residual)));
    equations.AddObservation(seen.vertex, seen.frame, by_point * T_camera_world.linear(), by_pose,
                             residual, robust / (seen.sigma * seen.sigma));
  }
}

Mat3 Along(const Vec3& tangent) {
  const Vec3 t = tangent.normalized();
  return t * t.transpose();
}

bool IsSharp(const Vec3& before, const Vec3& behind) {
  return before.cross(behind).norm() > kSharp * before.norm() * behind.norm();
}

// Adds the second difference of three vertices, across the curve. A vertex that slides along the
// curve, here the parabola through the three, does not bend it: otherwise bends would relax by
// pulling free ends back. At sharp corners a parabola tells no tangents.
void AddBend(const std::array<int, 3>& row, const std::vector<Vec3>& positions,
             NormalEquations& equations) {
  const Vec3& a = positions[row[0]];
  const Vec3& b = positions[row[1]];
  const Vec3& c = positions[row[2]];
  const Mat3 one = Mat3::Identity();
  const double weight = 1 / (kBendSigma * kBendSigma);
  const Vec3 ab = b - a, bc = c - b;
  if (IsSharp(ab, bc)) {
    equations.AddRow<3>(row, bc - ab, {one, -2 * one, one}, weight);
    return;
  }
  const Mat3 across = one - Along(c - a);
  const Mat3 by_a = across * (one - Along(-3 * a + 4 * b - c));
  const Mat3 by_c = across * (one - Along(a - 4 * b + 3 * c));
  const Mat3 by_b = -(by_a + by_c);  // moving all three alike bends nothing
  equations.AddRow<3>(row, across * (bc - ab), {by_a, by_b, by_c}, weight);
}

// Adds the third difference of four vertices, across the curve: how much its bend changes, which
// is nothing along straight wires and circles. Corners are left as they are.
void AddKink(const std::array<int, 4>& row, const std::vector<Vec3>& positions,
             NormalEquations& equations) {
  const Vec3& a = positions[row[0]];
  const Vec3& b = positions[row[1]];
  const Vec3& c = positions[row[2]];
  const Vec3& d = positions[row[3]];
  const Vec3 ab = b - a, bc = c - b, cd = d - c;
  if (IsSharp(ab, bc) || IsSharp(bc, cd)) return;
  const Mat3 across = Mat3::Identity() - Along(d - a);
  equations.AddRow<4>(row, across * (cd - 2 * bc + ab), {-across, 3 * across, -3 * across, across},
                      1 / (kKinkSigma * kKinkSigma));
}

// Adds the change of the distance between two neighbours: what holds vertices along the curve.
void AddStretch(int from, int to, const CurvePoseProblem& problem, const CurvePoseState& state,
                NormalEquations& equations) {
  const Vec3 d = state.positions[to] - state.positions[from];
  const double start = (problem.start.positions[to] - problem.start.positions[from]).norm();
  const Mat3 along = Along(d);
  equations.AddRow<3>({from, to, to}, d - start * d.normalized(), {-along, along, Mat3::Zero()},
                      1 / (kStretchSigma * kStretchSigma));
}

// The pairs of neighbours in rows, once each.
std::set<std::pair<int, int>> Neighbours(const std::vector<std::array<int, 3>>& rows) {
  std::set<std::pair<int, int>> pairs;
  for (const auto& [a, b, c] : rows) {
    pairs.insert({std::min(a, b), std::max(a, b)});
    pairs.insert({std::min(b, c), std::max(b, c)});
  }
  return pairs;
}

void AddCurvePriors(const CurvePoseProblem& problem, const CurvePoseState& state,
                    NormalEquations& equations) {
  for (size_t v = 0; v < state.positions.size(); ++v) {
    equations.AddVertexPrior(static_cast<int>(v), state.positions[v] - problem.start.positions[v],
                             1 / (kVertexSigma * kVertexSigma));
  }
  for (const std::array<int, 3>& row : problem.rows) AddBend(row, state.positions, equations);
  for (size_t i = 0; problem.evens_bends && i + 1 < problem.rows.size(); ++i) {
    const auto& [a, b, c] = problem.rows[i];
    const auto& [next_a, next_b, d] = problem.rows[i + 1];
    if (next_a == b && next_b == c) AddKink({a, b, c, d}, state.positions, equations);
  }
  for (const auto& [from, to] : Neighbours(problem.rows))
    AddStretch(from, to, problem, state, equations);
}

void AddPosePriors(const CurvePoseProblem& problem, const CurvePoseState& state,
                   NormalEquations& equations) {
  const size_t frames = state.T_camera_world.size();
  const bool jitters = problem.pose_errors == PoseErrors::kJitter;
  std::vector<SmallMotion> corrections;
  for (size_t f = 0; f < frames; ++f) {
    corrections.push_back(SmallMotionOf(state.T_camera_world[f] * problem.T_world_given[f]));
    const SmallMotion start =
        SmallMotionOf(problem.start.T_camera_world[f] * problem.T_world_given[f]);
    const PoseSigma& sigma = jitters                           ? kJitterSigma
                             : f == 0 && !problem.gaps.empty() ? kFirstSigma
                                                               : kPoseSigma;
    equations.AddPosePrior(static_cast<int>(f), corrections[f] - start, sigma.Weights(1));
  }
  for (size_t f = 0; f < problem.gaps.size(); ++f) {
    equations.AddLink(static_cast<int>(f), corrections[f + 1] - corrections[f],
                      kLinkSigma.Weights(problem.gaps[f]));
  }
}

}  // namespace

double StripResidual(const CurvePoseProblem& problem, const CurvePoseState& state,
                     const StripObservation& strip) {
  return ResidualIn(ColorCamera(problem), state, strip);
}

CurvePoseState ImproveCurvesAndPoses(const CurvePoseProblem& problem, const CurvePoseState& state,
                                     double huber_px) {
  assert(problem.gaps.empty() || problem.gaps.size() + 1 == state.T_camera_world.size());
  NormalEquations equations(static_cast<int>(state.positions.size()),
                            static_cast<int>(state.T_camera_world.size()));
  AddStrips(ColorCamera(problem), state, problem.strips, kStripSigmaPx, huber_px, equations);
  AddStrips(ColorCamera(problem), state, problem.edges, kEdgeSigmaPx, huber_px, equations);
  AddStrips({problem.depth_camera, RigidTransform::Identity()}, state, problem.depth_centres,
            kDepthCentreSigmaPx, kDepthCentreSigmaPx, equations);
  AddDepths(problem, state, equations);
  AddCurvePriors(problem, state, equations);
  AddPosePriors(problem, state, equations);
  const auto [vertices, poses] = equations.Solve();
  CurvePoseState improved = state;
  for (size_t v = 0; v < improved.positions.size(); ++v) {
    improved.positions[v] += vertices.segment<3>(3 * static_cast<Eigen::Index>(v));
  }
  for (size_t f = 0; f < improved.T_camera_world.size(); ++f) {
    RigidTransform& T_camera_world = improved.T_camera_world[f];
    T_camera_world =
        RigidTransformOf(poses.segment<6>(6 * static_cast<Eigen::Index>(f))) * T_camera_world;
  }
  return improved;
}

}  // namespace curvefusion
