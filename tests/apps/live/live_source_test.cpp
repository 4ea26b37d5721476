#include "apps/live/live_source.h"

#include <gtest/gtest.h>

#include <string>

namespace curvefusion {
namespace {

Sequence FiveFrames(double step) {
  Sequence sequence;
  for (int i = 0; i < 5; ++i) {
    SequenceFrame frame;
    frame.name = std::to_string(i);
    frame.timestamp = 1000 + step * i;
    sequence.frames.push_back(frame);
  }
  return sequence;
}

// Names and arrivals of what has come by then.
std::string By(double now, LiveSource& source) {
  std::string names;
  for (const ArrivedFrame& frame : source.Arrived(now)) {
    EXPECT_LE(frame.arrival, now);
    EXPECT_GT(frame.arrival, now - 10);
    names += frame.frame.name;
  }
  return names;
}

TEST(ReplayedSequence, FramesComeInTheStepsOfTheirStamps) {
  const auto source = ReplayOf(FiveFrames(0.1), 0);
  EXPECT_EQ(source->Cameras()->frame_count(), 0);
  EXPECT_EQ(By(7, *source), "0");
  EXPECT_EQ(By(7.05, *source), "");
  EXPECT_EQ(By(7.25, *source), "12");
  EXPECT_FALSE(source->HasEnded(7.25));
  EXPECT_EQ(By(9, *source), "34");
  EXPECT_TRUE(source->HasEnded(9));
}

TEST(ReplayedSequence, ARateTakesThePlaceOfStamps) {
  const auto source = ReplayOf(FiveFrames(0.1), 2);
  EXPECT_EQ(By(0, *source), "0");
  EXPECT_EQ(By(1.1, *source), "12");
}

TEST(ReplayedSequence, StampsThatAreNumbersOfFramesAreNoTimes) {
  const auto source = ReplayOf(FiveFrames(1), 0);
  EXPECT_EQ(By(0, *source), "0");
  EXPECT_EQ(By(2.5 / 30, *source), "12");
}

TEST(ReplayedSequence, WithoutFramesItHasEnded) {
  EXPECT_TRUE(ReplayOf({}, 0)->HasEnded(0));
  EXPECT_EQ(By(0, *ReplayOf({}, 0)), "");
}

}  // namespace
}  // namespace curvefusion
