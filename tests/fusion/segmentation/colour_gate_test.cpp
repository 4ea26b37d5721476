#include "fusion/segmentation/colour_gate.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

constexpr int kWidth = 200, kHeight = 120;
constexpr Rgb kGreen{60, 160, 70};

ColourGateOptions Asked() {
  ColourGateOptions options;
  options.frames = 1;
  options.max_width = 0.1;  // 15 px at one metre; a wire has 4
  return options;
}

Sequence OneCamera() {
  Sequence sequence;
  sequence.depth_camera = {kWidth, kHeight, 150, 150, 99.5, 59.5};
  sequence.color_camera = sequence.depth_camera;
  sequence.T_color_depth = RigidTransform::Identity();
  return sequence;
}

// Background of many colours; deterministic.
Rgb Background(int u, int v) {
  const auto tone = static_cast<uint8_t>(90 + (u * 7 + v * 13) % 60);
  return {tone, static_cast<uint8_t>(tone - 20), tone};
}

// Five vertical wires, 4 pixels wide and 8 apart, in colour `shift` pixels to the right; the mask
// covers them and the gaps between them.
bool IsWire(int u) { return u >= 80 && u < 120 && (u - 80) % 8 < 4; }

WireCandidates Rows(int shift, const Rgb& wire) {
  WireCandidates frame;
  frame.depth = DepthImage(kWidth, kHeight, 1.0f);
  frame.mask = MaskImage(kWidth, kHeight, 0);
  frame.arrays = MaskImage(kWidth / 2, kHeight / 2, 1);
  frame.color = ColorImage(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      frame.mask(u, v) = u >= 79 && u < 117 && v >= 20 && v < 100;
      frame.color(u, v) = IsWire(u - shift) && v >= 20 && v < 100 ? wire : Background(u, v);
    }
  }
  return frame;
}

// Shares of wire and of gap pixels that a gated mask holds, away from the wires' ends.
std::pair<double, double> KeptShares(const MaskImage& mask) {
  double wire = 0, wire_kept = 0, gap = 0, gap_kept = 0;
  for (int v = 25; v < 95; ++v) {
    for (int u = 80; u < 116; ++u) {
      (IsWire(u) ? wire : gap) += 1;
      (IsWire(u) ? wire_kept : gap_kept) += mask(u, v);
    }
  }
  return {wire_kept / wire, gap_kept / gap};
}

class ColourGate : public testing::TestWithParam<int> {};

TEST_P(ColourGate, PartsRowsWhoseDepthIsOneSheet) {
  const Sequence sequence = OneCamera();
  WireCandidates frame = Rows(GetParam(), kGreen);
  const WireColours colours = LearnWireColours({frame}, sequence, Asked());
  GateByColour(colours, sequence, Asked(), frame);
  // The shift is known to better than half a pixel: the blurred borders decide the rest.
  EXPECT_NEAR(colours.shift_px.x(), GetParam(), 0.5);
  EXPECT_NEAR(colours.shift_px.y(), 0, 0.5);
  const auto [wire, gap] = KeptShares(frame.mask);
  EXPECT_GT(wire, 0.95);
  EXPECT_LT(gap, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Shifts, ColourGate, testing::Values(-1, 0, 2));

TEST(ColourGateWithoutContrast, DropsNothing) {
  const Sequence sequence = OneCamera();
  WireCandidates frame = Rows(0, kGreen);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) frame.color(u, v) = Background(u, v);
  }
  const WireColours colours = LearnWireColours({frame}, sequence, Asked());
  GateByColour(colours, sequence, Asked(), frame);
  const auto [wire, gap] = KeptShares(frame.mask);
  EXPECT_GT(wire, 0.98);
  EXPECT_GT(gap, 0.98);
}

// The same rows with all gaps of the wires' colour in the upper half: not resolved there.
TEST(ColourGateOfMergedRows, LeavesThemToOtherViews) {
  const Sequence sequence = OneCamera();
  const WireCandidates resolved = Rows(0, kGreen);
  WireCandidates merged = resolved;
  for (int v = 20; v < 60; ++v) {
    for (int u = 80; u < 116; ++u) merged.color(u, v) = kGreen;
  }
  const WireColours colours = LearnWireColours({resolved}, sequence, Asked());
  GateByColour(colours, sequence, Asked(), merged);
  int above = 0, below = 0;
  for (int u = 80; u < 116; ++u) {
    above += merged.mask(u, 40);
    below += merged.mask(u, 85);
  }
  EXPECT_EQ(above, 0);
  EXPECT_GE(below, 18);  // five wires of four pixels, the outermost cut by the mask
}

TEST(ColourGateOutsideRows, DropsNothing) {
  const Sequence sequence = OneCamera();
  WireCandidates frame = Rows(0, kGreen);
  const WireColours colours = LearnWireColours({frame}, sequence, Asked());
  frame.arrays = MaskImage(kWidth / 2, kHeight / 2, 0);
  const MaskImage before = frame.mask;
  GateByColour(colours, sequence, Asked(), frame);
  for (size_t i = 0; i < before.size(); ++i) EXPECT_EQ(frame.mask.data()[i], before.data()[i]);
}

TEST(ColourGateOfNothing, StaysEmpty) {
  const Sequence sequence = OneCamera();
  WireCandidates frame = Rows(0, kGreen);
  frame.mask = MaskImage(kWidth, kHeight, 0);
  const WireColours colours = LearnWireColours({frame}, sequence, Asked());
  EXPECT_EQ(colours.shift_px, Vec2::Zero());
  GateByColour(colours, sequence, Asked(), frame);
  for (size_t i = 0; i < frame.mask.size(); ++i) EXPECT_EQ(frame.mask.data()[i], 0);
}

}  // namespace
}  // namespace curvefusion
