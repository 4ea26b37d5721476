#include "experiments/metrics/evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "experiments/metrics/evaluation_files.h"
#include "experiments/metrics/truth.h"
#include "experiments/simulation/object_truth.h"
#include "graph/io/graph_io.h"
#include "kernel/error.h"
#include "kernel/parallel.h"
#include "meshing/surface_mesh.h"
#include "meshing/tubes.h"
#include "tests/file_contents.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class EvaluationFiles : public testing::Test {
 protected:
  std::string Text(const std::string& name) const { return FileText(folder_ / name); }

  const TemporaryFolder folder_{"evaluation"};
};

TEST(Evaluate, IdentityIsPerfect) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("cubeframe"));
  const Evaluation evaluation = Evaluate(truth, nullptr, truth);
  for (const PlacedScores* scores : {&evaluation.raw, &evaluation.aligned}) {
    for (const PrecisionRecall& score : scores->curves.within) EXPECT_EQ(score.F(), 1.0);
    EXPECT_EQ(scores->junctions_5mm.matched, 13);
    EXPECT_EQ(scores->junctions_5mm.valence_right, 13);
    EXPECT_NEAR(*scores->paths.Apls(), 1, 1e-6);  // rounding of lengths
    // Where wires of 4.5 and 7 mm meet, the nearest sample may be the other wire's: some of 3000.
    EXPECT_NEAR(*scores->diameters.mean_error, 0, 5e-5);
  }
  EXPECT_EQ(evaluation.topology.cycles, evaluation.topology.true_cycles);
}

TEST(Evaluate, WhatIsTooLongToBeSampledIsRefused) {
  SkeletonGraph truth;
  truth.AddPolyline({{0, 0, 0}, {1, 0, 0}});
  SkeletonGraph result;
  result.AddPolyline({{0, 0, 0}, {1e6, 0, 0}});
  EXPECT_THROW(Evaluate(result, nullptr, truth), Error);
  EXPECT_THROW(Evaluate(truth, nullptr, result), Error);
}

TEST(Evaluate, AMissingEdgeLowersRecallAndCycles) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("cage"));
  SkeletonGraph result = truth;
  result.RemoveEdge(result.Edges()[3]);
  const Evaluation evaluation = Evaluate(result, nullptr, truth);
  EXPECT_EQ(evaluation.aligned.curves.within[2].precision, 1.0);
  EXPECT_LT(*evaluation.aligned.curves.within[2].recall, 1.0);
  EXPECT_EQ(evaluation.topology.cycles, 40);
  EXPECT_LT(*evaluation.aligned.paths.truth_to_result, 1.0);
}

TEST(Evaluate, AlignmentRemovesAShiftThatTheRawFiguresShow) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("cage"));
  RigidTransform shift = RigidTransform::Identity();
  shift.translation() = Vec3(0.002, 0.002, 0.002);
  const SkeletonGraph result = Transformed(truth, shift);
  const Evaluation evaluation = Evaluate(result, nullptr, truth);
  EXPECT_LT(*evaluation.raw.curves.within[0].F(), 0.1);
  EXPECT_EQ(evaluation.aligned.curves.within[0].F(), 1.0);
  // Pairs with samples 1 mm apart: below half a step.
  EXPECT_NEAR(evaluation.T_truth_result.translation().norm(), shift.translation().norm(), 0.0005);
}

// Half of the result and more is false: the alignment before kept 80 % of it, and moved the object.
TEST(Evaluate, FalseCurvesLeaveTheObjectInPlace) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("cat"));
  RigidTransform shift = RigidTransform::Identity();
  shift.translation() = Vec3(0.003, 0.002, -0.002);
  SkeletonGraph result = Transformed(truth, shift);
  for (int i = 0; i < 12; ++i) result.AddPolyline({{0.1, 0.02 * i, 0.3}, {0.5, 0.02 * i, 0.4}});
  const Evaluation evaluation = Evaluate(result, nullptr, truth);
  EXPECT_EQ(evaluation.aligned.junctions_5mm.matched, 22);
  EXPECT_EQ(evaluation.aligned.curves.within[0].recall, 1.0);
  EXPECT_LT(evaluation.aligned.curves.within[3].precision, 0.5);
  const PlacedScores& main_piece = evaluation.main_piece.aligned;
  EXPECT_EQ(main_piece.curves.within[0].F(), 1.0);
  EXPECT_EQ(main_piece.junctions_5mm.Score().F(), 1.0);
  EXPECT_EQ(main_piece.curves.false_length, 0);
  EXPECT_EQ(evaluation.main_piece.cycles, 12);
  EXPECT_NEAR(evaluation.main_piece.length, truth.TotalLength(), 1e-9);  // rounding
  // The raw figures are of the same piece.
  EXPECT_LT(*evaluation.main_piece.raw.curves.within[1].F(), 1.0);
  EXPECT_EQ(evaluation.main_piece.raw.curves.within[2].F(), 1.0);
}

// A room without wires: all that is found is false.
TEST(Evaluate, AnEmptyTruth) {
  const SkeletonGraph result = TruthSkeleton(MakeObject("cat"));
  const TriangleMesh tubes = ToTriangleMesh(BuildTubes(result, {}).surface);
  const Evaluation evaluation = Evaluate(result, &tubes, {});
  EXPECT_NEAR(evaluation.aligned.curves.false_length, result.TotalLength(), 1e-9);  // rounding
  EXPECT_EQ(evaluation.aligned.curves.missing_length, 0);
  EXPECT_EQ(evaluation.aligned.curves.within[3].precision, 0.0);
  EXPECT_EQ(evaluation.aligned.curves.within[3].recall, std::nullopt);
  EXPECT_EQ(evaluation.aligned.tips_5mm.Score().recall, std::nullopt);
  EXPECT_EQ(evaluation.true_length, 0);
  EXPECT_TRUE(evaluation.T_truth_result.isApprox(RigidTransform::Identity(), 0));
  EXPECT_EQ(EvaluationFigures(evaluation).at("aligned.curves.false_length"),
            evaluation.aligned.curves.false_length);
}

TEST(Evaluate, TheSameForAnyNumberOfThreads) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("deco"));
  RigidTransform shift = RigidTransform::Identity();
  shift.translation() = Vec3(0.002, 0.001, -0.001);
  const SkeletonGraph result = Transformed(truth, shift);
  const auto apls_and_motion = [&](int threads) {
    const ThreadLimit limit(threads);
    const Evaluation evaluation = Evaluate(result, nullptr, truth);
    return std::pair(*evaluation.raw.paths.Apls(), evaluation.T_truth_result.matrix().sum());
  };
  EXPECT_EQ(apls_and_motion(1), apls_and_motion(3));
}

TEST(Evaluate, EmptyResults) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("cat"));
  const Evaluation evaluation = Evaluate({}, nullptr, truth);
  EXPECT_EQ(evaluation.aligned.curves.within[3].F(), 0.0);
  EXPECT_EQ(evaluation.aligned.junctions_10mm.matched, 0);
  EXPECT_EQ(Evaluate(truth, nullptr, {}).aligned.curves.within[3].F(), 0.0);
  EXPECT_EQ(Evaluate({}, nullptr, {}).aligned.curves.within[3].F(), std::nullopt);
}

// A bare mesh gets the surface figures that the same mesh has beside its skeleton.
TEST(EvaluateMesh, ScoresTheTrueTubes) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("deco"));
  const TriangleMesh tubes = ToTriangleMesh(BuildTubes(truth, {}).surface);
  const Evaluation evaluation = EvaluateMesh(tubes, truth);
  EXPECT_FALSE(evaluation.has_curves);
  EXPECT_EQ(evaluation.raw.surface->within[0].F(), 1.0);
  EXPECT_EQ(evaluation.aligned.surface->within[0].F(), 1.0);
  EXPECT_LT(evaluation.true_volume->relative_error, 0.002);
  // Tubes are meshed to .5 %, and what the sampling errs.
  EXPECT_NEAR(*evaluation.VolumeRatio(), 1, 0.01);
}

TEST(EvaluateMesh, AlignsTheMeshItself) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("deco"));
  RigidTransform shift = RigidTransform::Identity();
  shift.translation() = Vec3(0.002, 0.002, 0.002);
  const TriangleMesh tubes = Transformed(ToTriangleMesh(BuildTubes(truth, {}).surface), shift);
  const Evaluation evaluation = EvaluateMesh(tubes, truth);
  EXPECT_LT(*evaluation.raw.surface->within[0].F(), 0.7);
  EXPECT_GT(*evaluation.aligned.surface->within[0].F(), 0.99);
}

TEST(EvaluateMesh, AnOpenMeshHasNoVolume) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("deco"));
  TriangleMesh tubes = ToTriangleMesh(BuildTubes(truth, {}).surface);
  tubes.triangles.pop_back();
  EXPECT_EQ(EvaluateMesh(tubes, truth).VolumeRatio(), std::nullopt);
  EXPECT_EQ(EvaluateMesh({}, truth).VolumeRatio(), std::nullopt);
  EXPECT_EQ(EvaluateMesh({}, truth).aligned.surface->within[3].recall, 0.0);
}

TEST_F(EvaluationFiles, TruthReadsAlikeFromSkeletonAndCurves) {
  const WireObject object = MakeObject("cage");
  WriteSkeleton(folder_ / "skeleton.json", TruthSkeleton(object));
  WriteCurves(folder_ / "curves.json", object);
  const SkeletonGraph from_folder = ReadTruth(folder_);
  const SkeletonGraph from_curves = ReadTruth(folder_ / "curves.json");
  EXPECT_EQ(SkeletonToJson(from_folder), SkeletonToJson(from_curves));
  fs::remove(folder_ / "skeleton.json");
  EXPECT_EQ(ReadTruth(folder_).CycleRank(), 41);
  WriteCurves(folder_ / "curves.json", {"room", {}});
  EXPECT_TRUE(ReadTruth(folder_).empty());
  WriteSkeleton(folder_ / "skeleton.json", {});
  EXPECT_TRUE(ReadTruth(folder_).empty());
}

TEST_F(EvaluationFiles, RefusesWhatIsNoTruth) {
  EXPECT_THROW(ReadTruth(folder_), Error);
  EXPECT_THROW(ReadTruth(folder_ / "missing.json"), Error);
  const auto refuses = [&](const std::string& text) {
    std::ofstream(folder_ / "curves.json") << text;
    EXPECT_THROW(ReadTruth(folder_), Error) << text;
  };
  refuses("[{\"diameter\": 1}]");
  refuses("[");
  refuses("[{\"diameter\": 0.004, \"closed\": false, \"points\": [[0, 0, 0]]}]");
  refuses("[{\"diameter\": -1, \"closed\": false, \"points\": [[0, 0, 0], [1, 0, 0]]}]");
  SkeletonGraph bare;
  bare.AddPolyline({{0, 0, 0}, {1, 0, 0}});
  WriteSkeleton(folder_ / "skeleton.json", bare);
  EXPECT_THROW(ReadTruth(folder_), Error);
}

TEST_F(EvaluationFiles, CsvGrowsByRowsOfTheSameColumns) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("cat"));
  const Evaluation evaluation = Evaluate(truth, nullptr, truth);
  AppendEvaluation(folder_ / "all.csv", {"a", "t"}, evaluation);
  AppendEvaluation(folder_ / "all.csv", {"b, \"c\"", "t"}, evaluation);
  std::ifstream stream(folder_ / "all.csv");
  std::string header, first, second, rest;
  std::getline(stream, header);
  std::getline(stream, first);
  std::getline(stream, second);
  EXPECT_FALSE(std::getline(stream, rest));
  EXPECT_EQ(std::count(header.begin(), header.end(), ','),
            std::count(first.begin(), first.end(), ','));
  EXPECT_NE(header.find("aligned.curves.5mm.f"), std::string::npos);
  EXPECT_EQ(first.rfind("a,t,", 0), 0u);
  EXPECT_EQ(second.rfind("\"b, \"\"c\"\"\",t,", 0), 0u);
}

TEST_F(EvaluationFiles, CsvWithOtherColumnsIsLeftAlone) {
  std::ofstream(folder_ / "other.csv") << "x,y\n1,2\n";
  EXPECT_THROW(AppendEvaluation(folder_ / "other.csv", {"a", "t"}, {}), Error);
  EXPECT_EQ(Text("other.csv"), "x,y\n1,2\n");
}

}  // namespace
}  // namespace curvefusion
