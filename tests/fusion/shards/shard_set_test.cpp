#include "fusion/shards/shard_set.h"

#include <gmock/gmock.h>

#include <fstream>

#include "fusion/shards/scan_fingerprint.h"
#include "tests/fusion/shards/shard_fixture.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ShardSet : public ShardFixture {
 protected:
  std::string OpeningRefused() const {
    return Refusal([&] { OpenShards({folder_}, identity_); });
  }
};

TEST_F(ShardSet, SharesCoverAllBundlesEvenly) {
  BestOptions options = Options();
  for (int frames = 1; frames < 200; ++frames) {
    sequence_.frames.resize(static_cast<size_t>(frames));
    options.segmentation.bundle.frames = 1 + frames % 30;
    const auto ranges = SplitIntoBundles(frames, options.segmentation.bundle.frames);
    const int bundles = static_cast<int>(ranges.size());
    for (int count = 1; count <= bundles; ++count) {
      int bundle = 0, frame = 0;
      for (int number = 1; number <= count; ++number) {
        const ShardHeader header = ShardOf(sequence_, options, {number, count});
        ASSERT_EQ(header.bundles.first, bundle);
        ASSERT_EQ(header.first_frame, frame);
        ASSERT_GT(header.bundles.last, bundle);
        // Both ends are within half a bundle, of which the last one may have half as much again.
        const double share = static_cast<double>(frames) / count;
        ASSERT_LE(header.last_frame - header.first_frame,
                  share + 1.5 * options.segmentation.bundle.frames);
        bundle = header.bundles.last;
        frame = header.last_frame;
      }
      ASSERT_EQ(bundle, bundles);
      ASSERT_EQ(frame, frames);
    }
    EXPECT_THAT(Refusal([&] {
                  ShardOf(sequence_, options, {1, bundles + 1});
                }),
                HasSubstr("N can be at most " + std::to_string(bundles)));
  }
}

TEST_F(ShardSet, GivesAllBundlesInTheirOrder) {
  prepared_ = ScanFingerprint(sequence_);
  for (const int number : {3, 1, 2}) Write({number, 3});
  std::ofstream(folder_ / "shard_1_of_3.partial-1-2.cfshard") << "half";
  const std::vector<Shard> shards = OpenShards({folder_}, identity_);
  int learned = 0;
  std::vector<size_t> frames;
  BundlesOf(shards, sequence_)(
      {[&](const LearnedScan&) { ++learned; },
       [&](const SegmentedBundle& bundle) { frames.push_back(bundle.frames.size()); }});
  EXPECT_EQ(learned, 1);
  EXPECT_EQ(frames, (std::vector<size_t>{30, 30, 40}));

  sequence_.frames[7].T_world_camera.translation().x() += 1e-12;
  EXPECT_THAT(Refusal([&] { BundlesOf(shards, sequence_); }), HasSubstr("frame 7, pose"));
}

TEST_F(ShardSet, MissingAndDoubleShardsAreNamed) {
  EXPECT_THAT(OpeningRefused(), HasSubstr("holds no shard"));
  Write({1, 3});
  EXPECT_THAT(OpeningRefused(), HasSubstr("2 of 3 shards are missing: 2/3, 3/3"));
  Write({3, 3});
  EXPECT_THAT(OpeningRefused(),
              HasSubstr("missing: 2/3; make each with `reconstruct --shard 2/3`"));
  Write({3, 3}, "again.cfshard");
  EXPECT_THAT(OpeningRefused(), AllOf(HasSubstr("again.cfshard"), HasSubstr("both shard 3 of 3")));
  fs::remove(folder_ / "again.cfshard");
  Write({2, 2});
  EXPECT_THAT(OpeningRefused(), AllOf(HasSubstr("shard 1 of 3"), HasSubstr("shard 2 of 2")));
}

TEST_F(ShardSet, AnotherScanSettingOrProgramIsNamedWithItsValue) {
  Write({1, 2});
  const ShardIdentity same = identity_;
  identity_.settings = "a = 1\nb.c = 2.25\n";
  const fs::path other = Write({2, 2});
  EXPECT_THAT(Refusal([&] { OpenShards({folder_}, same); }),
              AllOf(HasSubstr(other.string()), HasSubstr("b.c = 2.25, here it is 2.5")));
  identity_ = same;
  identity_.scan = "frames = 99\n";
  Write({2, 2});
  EXPECT_THAT(Refusal([&] { OpenShards({folder_}, same); }),
              AllOf(HasSubstr("another scan"), HasSubstr("frames = 99, here it is 100")));
  identity_ = same;
  identity_.method = "fedcba9876543210";
  Write({2, 2});
  EXPECT_THAT(Refusal([&] { OpenShards({folder_}, same); }),
              AllOf(HasSubstr("version fedcba9876543210"), HasSubstr("one program")));
}

TEST_F(ShardSet, WhatWasLearnedOrTrackedOtherwiseIsRefused) {
  Write({1, 2});
  learned_.wires.colours.posterior[9] = 8;
  Write({2, 2});
  EXPECT_THAT(OpeningRefused(), HasSubstr("has learned other"));
  learned_ = SomeLearned();
  prepared_ = "frames = 98\n";
  Write({2, 2});
  EXPECT_THAT(OpeningRefused(), HasSubstr("frames = 98 was found for it, here it is 100"));
}

TEST_F(ShardSet, FingerprintsTellScansApart) {
  const std::string scan = ScanFingerprint(sequence_);
  EXPECT_EQ(ScanFingerprint(MadeUpSequence()), scan);
  const auto change = [&](const auto& alter) {
    Sequence other = MadeUpSequence();
    alter(other);
    const auto found = FirstChange(ScanFingerprint(other), scan);
    return found ? found->name : "none";
  };
  EXPECT_EQ(change([](Sequence&) {}), "none");
  EXPECT_EQ(change([](Sequence& s) { s.frames.pop_back(); }), "frames");
  EXPECT_EQ(change([](Sequence& s) { s.color_camera.fx = std::nextafter(525.1, 600); }),
            "colour camera");
  EXPECT_EQ(change([](Sequence& s) { s.T_color_depth(0, 3) = 1e-9; }), "T_color_depth");
  EXPECT_EQ(change([](Sequence& s) { s.depth_distortion.k1 = 0.1; }), "depth distortion");
  EXPECT_EQ(change([](Sequence& s) { s.depth_scale = 1000; }), "depth scale");
  EXPECT_EQ(change([](Sequence& s) { s.frames[3].depth_path = "scan/depth/x.png"; }),
            "frame 3, depth image");
  EXPECT_EQ(change([](Sequence& s) { s.frames[3].T_world_camera(0, 3) += 1e-9; }), "frame 3, pose");
  EXPECT_EQ(change([](Sequence& s) { s.has_poses = false; }), "poses");
}

TEST_F(ShardSet, FingerprintsDoNotDependOnThePlaceOfTheScan) {
  const auto fingerprint_in = [&](const fs::path& place) {
    fs::create_directories(folder_ / "elsewhere" / "depth");
    std::ofstream(folder_ / "elsewhere" / "depth" / "0.png") << "12345";
    Sequence sequence = MadeUpSequence();
    sequence.folder = place;
    for (SequenceFrame& frame : sequence.frames) {
      frame.depth_path = place / frame.depth_path.lexically_relative("scan");
      frame.color_path = place / frame.color_path.lexically_relative("scan");
    }
    return ScanFingerprint(sequence);
  };
  const std::string here = fingerprint_in(folder_ / "elsewhere");
  EXPECT_THAT(here, HasSubstr("depth image = depth/0.png of 5 bytes\n"));
  EXPECT_EQ(fingerprint_in(folder_ / "elsewhere" / ""), here);
  EXPECT_EQ(fingerprint_in(folder_ / "." / "elsewhere"), here);
}

}  // namespace
}  // namespace curvefusion
