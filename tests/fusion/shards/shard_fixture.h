#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "fusion/shards/shard_set.h"
#include "kernel/error.h"
#include "tests/temporary_path.h"

namespace curvefusion {

/// Shards of a scan that there is not: 100 frames, of which bundles of 30 are made up.
class ShardFixture : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static Sequence MadeUpSequence() {
    Sequence sequence;
    sequence.format = "tum";
    sequence.folder = "scan";
    sequence.depth_camera = {640, 480, 525.1, 525.2, 319.5, 239.5};
    sequence.color_camera = sequence.depth_camera;
    for (int i = 0; i < 100; ++i) {
      SequenceFrame frame;
      frame.name = std::to_string(i);
      frame.timestamp = i / 30.0;
      frame.T_world_camera = Eigen::Translation3d(0.1 * i, 0, 0);
      frame.depth_path = sequence.folder / "depth" / (frame.name + ".png");
      frame.color_path = sequence.folder / "rgb" / (frame.name + ".png");
      sequence.frames.push_back(frame);
    }
    return sequence;
  }

  static ObservedPoints SomePoints(size_t count, std::mt19937& random) {
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
    ObservedPoints points;
    for (size_t i = 0; i < count; ++i) {
      points.Add(vector(), vector().normalized(), static_cast<float>(normal(random)));
    }
    return points;
  }

  static LearnedScan SomeLearned() {
    LearnedScan learned;
    learned.volume = {50, 1234, 5678910};
    learned.wires = {2, 0.1 / 3, 1e-310, {std::vector<uint8_t>(24 * 24 * 24, 7), {-0.0, 1.0 / 7}}};
    learned.wires.colours.posterior[5] = 255;
    learned.wires.nets = {{{-3, 0, 7}, {2, 1, -1}}, 0.1 / 7, 1.0 / 3};
    return learned;
  }

  static SegmentedBundle SomeBundle(int frames, uint32_t seed) {
    std::mt19937 random(seed);
    SegmentedBundle bundle;
    bundle.difference_set = SomePoints(9, random);
    bundle.points = SomePoints(5, random);
    for (int i = 0; i < frames; ++i) {
      bundle.frames.push_back(SomePoints(static_cast<size_t>(i % 3), random));
    }
    bundle.T_world_bundle =
        Eigen::Translation3d(1.0 / 3, 2, 3) * Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized());
    bundle.funnel = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0.1};
    return bundle;
  }

  static BestOptions Options() { return DefaultBestOptions(); }

  ShardHeader Header(ShardNumber shard) const {
    ShardHeader header = ShardOf(sequence_, Options(), shard);
    header.identity = identity_;
    header.prepared = prepared_;
    return header;
  }

  // What every shard has in common stands in members, for tests to change.
  std::filesystem::path Write(ShardNumber shard, const std::string& name = "") const {
    const std::filesystem::path file = folder_ / (name.empty() ? ShardName(shard) : name);
    const ShardHeader header = Header(shard);
    WriteShard(file, header, [&](const BundleSink& sink) {
      sink.on_learned(learned_);
      const auto ranges = SplitIntoBundles(100, Options().segmentation.bundle.frames);
      for (int i = header.bundles.first; i < header.bundles.last; ++i) {
        const auto& [first, last] = ranges[static_cast<size_t>(i)];
        sink.on_bundle(SomeBundle(last - first, static_cast<uint32_t>(i)));
      }
    });
    return file;
  }

  // The message of the Error that `act` throws; empty where it throws none.
  template <class Act>
  static std::string Refusal(const Act& act) {
    try {
      act();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  const std::filesystem::path folder_ = TemporaryPath("shards");
  Sequence sequence_ = MadeUpSequence();
  ShardIdentity identity_ = {"0123456789abcdef", "a = 1\nb.c = 2.5\n", "frames = 100\n"};
  std::string prepared_ = "frames = 100\n";
  LearnedScan learned_ = SomeLearned();
};

}  // namespace curvefusion
