#include "fusion/adjustment/curve_pose_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fusion/registration/pose_correction.h"
#include "kernel/polyline.h"

namespace curvefusion {
namespace {

constexpr int kFrames = 12;

// Three curves about the origin, seen by cameras on an arc half a metre away.
std::vector<Polyline> TrueCurves() {
  std::vector<Polyline> curves(3);
  for (int i = 0; i <= 40; ++i) {
    const double s = 0.003 * i - 0.06;
    curves[0].emplace_back(s, 0.02 * std::sin(20 * s), 0);
    curves[1].emplace_back(0.03 * std::cos(15 * s), s, 0.04);
    curves[2].emplace_back(s, s, -0.04 + 0.5 * s);
  }
  return curves;
}

RigidTransform TruePose(int frame) {
  const double angle = 0.1 * (frame - kFrames / 2);
  RigidTransform T_world_camera = RigidTransform::Identity();
  T_world_camera.linear() = (Eigen::AngleAxisd(angle, Vec3::UnitY()) *
                             Eigen::AngleAxisd(0.1 * std::sin(frame), Vec3::UnitX()))
                                .toRotationMatrix();
  T_world_camera.translation() = T_world_camera.linear() * Vec3(0, 0, -0.5);
  return T_world_camera;
}

SmallMotion Drift(int frame) {
  SmallMotion drift = SmallMotion::Zero();
  if (frame == 0) return drift;
  const double t = 0.3 * frame;
  drift << 0.002 * std::sin(t), 0.002 * std::sin(1.7 * t), 0.001 * t, 0.003 * std::sin(t),
      0.002 * t / 3, 0.003 * std::sin(2 * t);
  return drift;
}

// A problem whose observations are exact, and whose start is off.
class CurvePoseSolverTest : public testing::Test {
 protected:
  CurvePoseSolverTest() {
    problem_.color_camera = {640, 480, 580, 580, 319.5, 239.5};
    problem_.T_color_depth.translation() = Vec3(0.025, 0, 0);
    for (const Polyline& curve : TrueCurves()) {
      const int first = static_cast<int>(truth_.positions.size());
      for (size_t i = 0; i < curve.size(); ++i) {
        truth_.positions.push_back(curve[i]);
        if (i < 2) continue;
        const int last = first + static_cast<int>(i);
        problem_.rows.push_back({last - 2, last - 1, last});
      }
    }
    for (int f = 0; f < kFrames; ++f) {
      truth_.T_camera_world.push_back(TruePose(f).inverse());
      problem_.T_world_given.push_back(TruePose(f) * RigidTransformOf(Drift(f)));
      if (f > 0) problem_.gaps.push_back(3);
    }
    problem_.start = truth_;
    for (size_t v = 0; v < truth_.positions.size(); ++v) {
      const double s = 0.2 * static_cast<double>(v);
      problem_.start.positions[v] += 0.002 * Vec3(std::sin(s), std::cos(s), std::sin(0.4 * s));
    }
    for (int f = 0; f < kFrames; ++f) {
      problem_.start.T_camera_world[f] = problem_.T_world_given[f].inverse();
    }
    Observe();
  }

  void Observe() {
    for (int f = 0; f < kFrames; ++f) {
      for (size_t v = 1; v + 1 < truth_.positions.size(); ++v) {
        const auto pixel = [&](size_t i) {
          return problem_.color_camera.Project(problem_.T_color_depth *
                                               (truth_.T_camera_world[f] * truth_.positions[i]));
        };
        const Vec2 along = (pixel(v + 1) - pixel(v - 1)).normalized();
        problem_.strips.push_back({f, static_cast<int>(v), pixel(v), Vec2(-along.y(), along.x())});
      }
    }
  }

  CurvePoseState Solve(int steps) const {
    CurvePoseState state = problem_.start;
    for (int i = 0; i < steps; ++i) state = ImproveCurvesAndPoses(problem_, state, 4);
    return state;
  }

  double RmsResidual(const CurvePoseState& state) const {
    double sum = 0;
    for (const StripObservation& strip : problem_.strips) {
      sum += std::pow(StripResidual(problem_, state, strip), 2);
    }
    return std::sqrt(sum / static_cast<double>(problem_.strips.size()));
  }

  // Mean distance of vertices from the true curves (they may slide along them).
  double MeanDistance(const CurvePoseState& state) const {
    double sum = 0;
    for (const Vec3& position : state.positions) {
      double nearest = 1;
      for (const Polyline& curve : TrueCurves()) {
        nearest = std::min(nearest, Project(curve, position).distance);
      }
      sum += nearest;
    }
    return sum / static_cast<double>(state.positions.size());
  }

  // Of the motions from each frame but the first to the next: translations, metres.
  static double RmsStepError(const CurvePoseState& state) {
    double sum = 0;
    for (size_t f = 2; f < kFrames; ++f) {
      const RigidTransform step = state.T_camera_world[f] * state.T_camera_world[f - 1].inverse();
      const int frame = static_cast<int>(f);
      const RigidTransform true_step = TruePose(frame).inverse() * TruePose(frame - 1);
      sum += (step.translation() - true_step.translation()).squaredNorm();
    }
    return std::sqrt(sum / (kFrames - 2));
  }

  CurvePoseProblem problem_;
  CurvePoseState truth_;
};

// A curve of which colour images show no strip, 3 mm beside its place.
TEST_F(CurvePoseSolverTest, DepthHoldsWhatNoStripShows) {
  const int first = static_cast<int>(TrueCurves()[0].size());
  const int last = first + static_cast<int>(TrueCurves()[1].size());
  const auto is_unseen = [&](int vertex) { return vertex >= first && vertex < last; };
  problem_.start = truth_;
  for (int v = first; v < last; ++v) problem_.start.positions[v].x() += 0.003;
  problem_.depth_camera = problem_.color_camera;
  for (const StripObservation& strip : problem_.strips) {
    if (!is_unseen(strip.vertex)) continue;
    const Vec3 p_depth = truth_.T_camera_world[strip.frame] * truth_.positions[strip.vertex];
    const Vec2 pixel = problem_.depth_camera.Project(p_depth);
    problem_.depth_centres.push_back({strip.frame, strip.vertex, pixel, strip.normal});
  }
  std::erase_if(problem_.strips, [&](const auto& strip) { return is_unseen(strip.vertex); });
  const auto error = [&] {
    const CurvePoseState state = Solve(6);
    double sum = 0;
    for (int v = first; v < last; ++v) sum += state.positions[v].x() - truth_.positions[v].x();
    return std::abs(sum) / (last - first);
  };
  EXPECT_LT(error(), 0.001);
  problem_.depth_centres.clear();
  EXPECT_GT(error(), 0.002);
}

TEST_F(CurvePoseSolverTest, RecoversCurvesAndPoses) {
  ASSERT_GT(RmsResidual(problem_.start), 1);
  const CurvePoseState state = Solve(5);
  EXPECT_LT(RmsResidual(state), 0.05);  // smoothing holds against the bends of the curves
  // A fifth of the start. Priors hold a little back: all cameras but the first may turn together
  // about the object, and each may trade turning for moving, which hardly changes the images.
  EXPECT_LT(MeanDistance(state), 0.0004);
  EXPECT_LT(RmsStepError(state), 0.5 * RmsStepError(problem_.start));
}

// Root mean square of the third differences along the curves.
double Unevenness(const CurvePoseProblem& problem, const std::vector<Vec3>& positions) {
  double sum = 0;
  int count = 0;
  for (const auto& [a, b, c] : problem.rows) {
    if (c + 1 == static_cast<int>(positions.size())) continue;
    const Vec3 third = positions[c + 1] - 3 * positions[c] + 3 * positions[b] - positions[a];
    if (third.norm() > 0.01) continue;  // the next curve
    sum += third.squaredNorm();
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST_F(CurvePoseSolverTest, EvenBendsFollowNoiseLess) {
  for (size_t i = 0; i < problem_.strips.size(); ++i) {
    StripObservation& strip = problem_.strips[i];
    strip.pixel += 2 * std::sin(7.3 * static_cast<double>(i)) * strip.normal;
  }
  const CurvePoseState uneven = Solve(5);
  problem_.evens_bends = true;
  const CurvePoseState even = Solve(5);
  EXPECT_LT(Unevenness(problem_, even.positions), 0.7 * Unevenness(problem_, uneven.positions));
  EXPECT_LE(MeanDistance(even), MeanDistance(uneven));
}

// Strips hold a bent curve across, nothing holds its free ends along it.
TEST(ImproveCurvesAndPoses, BentCurvesWithFreeEndsKeepTheirLength) {
  constexpr double kBendRadius = 0.02;
  constexpr int kVertices = 30;
  CurvePoseProblem problem;
  problem.color_camera = problem.depth_camera = {640, 480, 580, 580, 319.5, 239.5};
  const auto at = [](int v) -> Vec3 {
    const double angle = 0.003 / kBendRadius * v;
    return {kBendRadius * std::cos(angle), kBendRadius * std::sin(angle), 0};
  };
  for (int v = 0; v < kVertices; ++v) {
    problem.start.positions.push_back(at(v));
    if (v >= 2) problem.rows.push_back({v - 2, v - 1, v});
  }
  for (int f = 0; f < kFrames; ++f) {
    problem.T_world_given.push_back(TruePose(f));
    problem.start.T_camera_world.push_back(TruePose(f).inverse());
    const auto pixel = [&](int v) {
      return problem.color_camera.Project(problem.start.T_camera_world[f] * at(v));
    };
    for (int v = 0; v < kVertices; ++v) {
      const Vec2 along = (pixel(v + 1) - pixel(v - 1)).normalized();
      problem.strips.push_back({f, v, pixel(v), Vec2(-along.y(), along.x())});
    }
  }
  CurvePoseState state = problem.start;
  for (int i = 0; i < 6; ++i) state = ImproveCurvesAndPoses(problem, state, 4);
  // Of 87 mm. The pull is of second order; plain second differences leave 66 mm.
  EXPECT_GT(Length(state.positions), 0.95 * Length(problem.start.positions));
}

TEST_F(CurvePoseSolverTest, DepthHoldsCurvesAlongTheRay) {
  // All views from one place: colour says nothing about distance.
  for (int f = 0; f < kFrames; ++f) {
    truth_.T_camera_world[f] = TruePose(kFrames / 2).inverse();
    problem_.T_world_given[f] = TruePose(kFrames / 2);
  }
  problem_.start = truth_;
  for (Vec3& position : problem_.start.positions) position *= 1.02;  // about the camera, roughly
  for (Vec3& position : problem_.start.positions) position += Vec3(0, 0, 0.01);
  problem_.gaps.clear();
  problem_.strips.clear();
  Observe();
  const auto mean_depth_error = [&](const CurvePoseState& state) {
    double sum = 0;
    for (size_t v = 0; v < state.positions.size(); ++v) {
      sum += (state.T_camera_world[0] * state.positions[v]).z() -
             (truth_.T_camera_world[0] * truth_.positions[v]).z();
    }
    return sum / static_cast<double>(state.positions.size());
  };
  const double without = std::abs(mean_depth_error(Solve(4)));
  for (int f = 0; f < kFrames; ++f) {
    for (size_t v = 0; v < truth_.positions.size(); ++v) {
      const double depth = (truth_.T_camera_world[f] * truth_.positions[v]).z();
      problem_.depths.push_back({f, static_cast<int>(v), depth, 0.003});
    }
  }
  EXPECT_GT(without, 0.004);
  EXPECT_LT(std::abs(mean_depth_error(Solve(4))), 0.0005);  // the priors' share of what was off
}

TEST_F(CurvePoseSolverTest, OutliersAreHeldOff) {
  for (size_t i = 0; i < problem_.strips.size(); i += 25) {
    problem_.strips[i].pixel += 5 * problem_.strips[i].normal;
  }
  CurvePoseState state = Solve(3);
  for (int i = 0; i < 3; ++i) state = ImproveCurvesAndPoses(problem_, state, 0.4);
  // 4 % outliers of 5 px, 4 mm; Huber leaves some pull, and spacings of the start are .4 mm off.
  EXPECT_LT(MeanDistance(state), 0.00035);
}

TEST_F(CurvePoseSolverTest, WithoutObservationsNothingMoves) {
  problem_.strips.clear();
  problem_.rows.clear();
  const CurvePoseState state = Solve(1);
  for (size_t v = 0; v < state.positions.size(); ++v) {
    EXPECT_TRUE(state.positions[v].isApprox(problem_.start.positions[v], 1e-12));  // rounding
  }
}

TEST_F(CurvePoseSolverTest, StripsBehindTheCameraAreLeftOut) {
  CurvePoseState behind = problem_.start;
  behind.positions[1] = problem_.start.T_camera_world[0].inverse() * Vec3(0, 0, -0.1);
  const StripObservation strip = {0, 1, {100, 100}, {1, 0}};
  EXPECT_TRUE(std::isnan(StripResidual(problem_, behind, strip)));
  problem_.strips = {strip};
  EXPECT_TRUE(ImproveCurvesAndPoses(problem_, behind, 4).positions[1].allFinite());
}

}  // namespace
}  // namespace curvefusion
