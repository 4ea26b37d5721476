#include "capture/frame_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernel/error.h"
#include "tests/capture/sequence_fixture.h"

namespace curvefusion {
namespace {

using testing::ElementsAre;

class FrameStreamTest : public testing::Test {
 protected:
  FrameStreamTest() {
    WriteTumSequence(folder_.path());
    sequence_ = OpenSequence(folder_.path());
  }

  TemporaryFolder folder_;
  Sequence sequence_;
};

TEST_F(FrameStreamTest, VisitsARangeInOrder) {
  std::vector<int> seen;
  ForEachFrame(sequence_, 1, 4, {}, [&seen](const DecodedFrame& frame) {
    seen.push_back(frame.index);
    EXPECT_EQ(frame.depth.width(), 32);
    EXPECT_EQ(frame.color.width(), 32);
  });
  EXPECT_THAT(seen, ElementsAre(1, 2, 3));
}

// More frames than fit in one window, repeated: the frames given, not their order in the sequence.
TEST_F(FrameStreamTest, VisitsAnyFramesInTheOrderGiven) {
  std::vector<int> frames;
  for (int i = 0; i < 21; ++i) frames.push_back((i * 3) % kFixtureFrames);
  std::vector<int> seen;
  ForEachFrame(sequence_, frames, {false, true}, [&seen](const DecodedFrame& frame) {
    seen.push_back(frame.index);
    EXPECT_TRUE(frame.depth.empty());
  });
  EXPECT_EQ(seen, frames);
}

TEST_F(FrameStreamTest, AnEmptyRangeIsFine) {
  ForEachFrame(sequence_, 2, 2, {}, [](const DecodedFrame&) { ADD_FAILURE(); });
}

TEST(EvenlyThinned, SpreadsFramesOverAll) {
  EXPECT_THAT(EvenlyThinned({1, 5, 7}, 3), ElementsAre(1, 5, 7));
  // The middles of three thirds.
  EXPECT_THAT(EvenlyThinned({0, 1, 2, 3, 4, 5, 6, 7, 8}, 3), ElementsAre(1, 4, 7));
  EXPECT_THAT(EvenlyThinned({0, 1}, 40), ElementsAre(0, 1));
  EXPECT_THAT(EvenlyThinned({}, 3), ElementsAre());
}

TEST_F(FrameStreamTest, ABrokenImageThrows) {
  Truncate(sequence_.frames[3].depth_path, 0.5);
  EXPECT_THROW(ForEachFrame(sequence_, 0, 4, {}, [](const DecodedFrame&) {}), Error);
}

}  // namespace
}  // namespace curvefusion
