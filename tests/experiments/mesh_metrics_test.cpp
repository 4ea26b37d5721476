#include "experiments/metrics/mesh_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace curvefusion {
namespace {

constexpr double kRadius = 0.003;
constexpr double kLength = 0.1;

SkeletonGraph Wire() {
  SkeletonGraph graph;
  const NodeId a = graph.AddNode({0, 0, 0});
  const NodeId b = graph.AddNode({kLength, 0, 0});
  graph.AddEdge({{a, b}, {{0, 0, 0}, {kLength, 0, 0}}, {kRadius, kRadius}, {}});
  return graph;
}

// An open cylinder about the x axis of 64 sides.
TriangleMesh Cylinder(double radius, double from, double to, double y = 0) {
  constexpr int kSides = 64;
  TriangleMesh mesh;
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    for (const double x : {from, to}) {
      mesh.vertices.push_back(
          Vec3(x, y + radius * std::cos(angle), radius * std::sin(angle)).cast<float>());
    }
    const int next = 2 * ((k + 1) % kSides);
    mesh.triangles.push_back({2 * k, 2 * k + 1, next});
    mesh.triangles.push_back({next, 2 * k + 1, next + 1});
  }
  return mesh;
}

TEST(CompareSurface, TheTrueTubeIsPerfect) {
  const SurfaceScores scores = CompareSurface(Cylinder(kRadius, 0, kLength), Wire());
  for (const PrecisionRecall& score : scores.within) EXPECT_EQ(score.F(), 1.0);
  // The limit stated for sampling.
  EXPECT_LT(*scores.mean_to_truth, 0.0001);
}

TEST(CompareSurface, AThickerTubeIsOffByTheDifference) {
  const SurfaceScores scores = CompareSurface(Cylinder(kRadius + 0.0015, 0, kLength), Wire());
  EXPECT_EQ(scores.within[0].F(), 0.0);
  EXPECT_EQ(scores.within[1].F(), 1.0);
  EXPECT_NEAR(*scores.mean_to_truth, 0.0015, 0.0001);
}

TEST(CompareSurface, HalfATubeHasHalfTheRecall) {
  const SurfaceScores scores = CompareSurface(Cylinder(kRadius, 0, kLength / 2), Wire());
  EXPECT_EQ(scores.within[0].precision, 1.0);
  // 50 mm and the 1 mm beyond, of 100 mm; rings stand 1 mm apart.
  EXPECT_NEAR(*scores.within[0].recall, 0.51, 0.011);
}

TEST(CompareSurface, WhatIsInsideAnotherTubeIsNoSurface) {
  SkeletonGraph truth = Wire();
  const NodeId a = truth.AddNode({0, 0, 0.0001});
  const NodeId b = truth.AddNode({kLength, 0, 0.0001});
  truth.AddEdge({{a, b}, {{0, 0, 0.0001}, {kLength, 0, 0.0001}}, {0.001, 0.001}, {}});
  EXPECT_EQ(CompareSurface(Cylinder(kRadius, 0, kLength), truth).within[0].recall, 1.0);
}

TEST(CompareSurface, NothingThere) {
  EXPECT_EQ(CompareSurface({}, Wire()).within[3].recall, 0.0);
  EXPECT_EQ(CompareSurface({}, Wire()).within[3].precision, std::nullopt);
  EXPECT_EQ(CompareSurface(Cylinder(kRadius, 0, kLength), {}).within[3].F(), 0.0);
}

TEST(PartAroundTruth, LeavesTheRoomOut) {
  TriangleMesh mesh = Cylinder(kRadius, 0, kLength);
  const size_t near = mesh.triangles.size();
  Append(Cylinder(kRadius, 0, kLength, 0.06), mesh);
  const MeshPart part = PartAroundTruth(mesh, Wire());
  EXPECT_EQ(part.mesh.triangles.size(), near);
  // A 64-gon's circumference is .04 % less than the circle's.
  EXPECT_NEAR(part.area_outside, 2 * std::numbers::pi * kRadius * kLength, 2e-6);
  EXPECT_EQ(ExamineMesh(part.mesh).boundary_edges, 128);
}

}  // namespace
}  // namespace curvefusion
