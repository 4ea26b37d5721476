#include "apps/live/frame_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <vector>

namespace curvefusion {
namespace {

ArrivedFrame At(double arrival) { return {{}, arrival}; }

// Arrivals of all frames that are left.
std::vector<double> Drain(FrameQueue& queue) {
  queue.Close();
  std::vector<double> arrivals;
  while (const auto frame = queue.Pop()) arrivals.push_back(frame->arrival);
  return arrivals;
}

double LargestStep(const std::vector<double>& arrivals) {
  double largest = arrivals.front();
  for (size_t i = 1; i < arrivals.size(); ++i)
    largest = std::max(largest, arrivals[i] - arrivals[i - 1]);
  return largest;
}

TEST(FrameQueue, KeepsAllFramesInTheirOrderWhileThereIsRoom) {
  FrameQueue queue(3);
  for (const double arrival : {1, 2, 3}) EXPECT_FALSE(queue.Push(At(arrival)));
  EXPECT_EQ(Drain(queue), (std::vector<double>{1, 2, 3}));
}

TEST(FrameQueue, DropsEverySecondFrameBeforeAnyGapGrows) {
  FrameQueue queue(10);
  for (int i = 1; i <= 20; ++i) EXPECT_EQ(queue.Push(At(i)), i > 10) << i;
  const std::vector<double> left = Drain(queue);
  EXPECT_EQ(left.size(), 10);
  EXPECT_EQ(left.back(), 20);
  EXPECT_EQ(LargestStep(left), 2);
}

// However much comes: neighbours that remain are at most twice as far apart as if they were spread
// evenly, as no pair around a dropped frame is farther apart than another one.
TEST(FrameQueue, WhatRemainsIsSpreadEvenly) {
  for (const int frames : {11, 25, 50, 100, 1000}) {
    FrameQueue queue(10);
    for (int i = 1; i <= frames; ++i) queue.Push(At(i));
    EXPECT_LE(LargestStep(Drain(queue)), 2 * frames / 10.0) << frames;
  }
}

// The gaps count from the frame that is worked on.
TEST(FrameQueue, TheFrameTakenLastIsANeighbour) {
  FrameQueue queue(2);
  queue.Push(At(1));
  queue.Pop();
  for (const double arrival : {4, 5, 6}) queue.Push(At(arrival));
  EXPECT_EQ(Drain(queue), (std::vector<double>{4, 6}));
}

TEST(FrameQueue, WhoTakesWaitsForAFrame) {
  FrameQueue queue(1);
  auto taken = std::async(std::launch::async, [&] { return queue.Pop()->arrival; });
  queue.Push(At(7));
  EXPECT_EQ(taken.get(), 7);
}

TEST(FrameQueue, ClosingEndsTheWait) {
  FrameQueue queue(1);
  auto taken = std::async(std::launch::async, [&] { return queue.Pop().has_value(); });
  queue.Close();
  EXPECT_FALSE(taken.get());
}

}  // namespace
}  // namespace curvefusion
