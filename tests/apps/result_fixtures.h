#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "capture/sequence.h"
#include "experiments/simulation/simulate.h"
#include "graph/skeleton_graph.h"
#include "tests/temporary_path.h"

namespace curvefusion {

/// Three 100 mm arms from the origin, 4, 5 and 6 mm thick.
inline SkeletonGraph Y() {
  SkeletonGraph graph;
  const NodeId centre = graph.AddNode(Vec3::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 tip = 0.1 * Vec3::Unit(axis);
    const double radius = (4 + axis) * kMillimetre / 2;
    graph.AddEdge({{centre, graph.AddNode(tip)}, {Vec3::Zero(), tip}, {radius, radius}, {}});
  }
  return graph;
}

/// Five views of the simulator's cube, made once.
class FiveViews : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    SimulationOptions options;
    options.sensor = "ideal";
    options.pose_source = "true";
    options.frames = 5;
    SimulateScan(options, Folder(), NoProgress);
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(Folder()); }
  static std::filesystem::path Folder() { return TemporaryPath("five_views"); }

  Sequence sequence_ = OpenSequence(Folder());
};

}  // namespace curvefusion
