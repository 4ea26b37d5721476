#include "fusion/curve_graph/wire_proof.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

// Straight edges of 40 mm, one stretch each, that hang together where they follow one another.
struct Stretches {
  SkeletonGraph skeleton;
  std::vector<StretchEvidence> evidence;
  std::vector<RefutedStretch> refuted;

  void Add(const Vec3& from, StretchEvidence of_stretch) {
    const EdgeId id = skeleton.AddPolyline({from, from + Vec3(0.04, 0, 0)});
    of_stretch.edge = id;
    of_stretch.part = {0, 1};
    of_stretch.length = 0.04;
    of_stretch.middle = from + Vec3(0.02, 0, 0);
    evidence.push_back(of_stretch);
  }
  double Probability(size_t i) const {
    return curvefusion::Probability(ProveWires(skeleton, evidence, refuted)[i].log_odds);
  }
};

StretchEvidence Wire() {
  StretchEvidence wire;
  wire.images = 60;
  wire.seen = 0.8;
  wire.past = 0.15;
  wire.open = 0.8;
  wire.width = 0.008;
  return wire;
}

StretchEvidence ShelfEdge() {
  StretchEvidence edge = Wire();
  edge.open = 0.2;
  edge.same = 0.5;
  return edge;
}

// All around it the background changes from image to image.
StretchEvidence OpenInColour(StretchEvidence evidence) {
  evidence.beside = {20, 25};
  evidence.on_surfaces = 3;
  return evidence;
}

double Alone(const StretchEvidence& evidence) {
  Stretches one;
  one.Add(Vec3::Zero(), evidence);
  return one.Probability(0);
}

TEST(WireProof, OfEvidenceOfAllKinds) {
  const double wire = Alone(Wire());
  EXPECT_LT(Alone(ShelfEdge()), 0.5 * wire);
  StretchEvidence slat = Wire();
  slat.width = 0.025;
  EXPECT_LT(Alone(slat), wire);
  StretchEvidence nothing = Wire();
  nothing.seen = 0;
  nothing.past = 1;
  EXPECT_LT(Alone(nothing), wire);
  StretchEvidence strip = Wire();
  strip.coverage = 1;
  strip.diameter = 0.006;
  EXPECT_GT(Alone(strip), wire);
  strip.diameter = 0.02;
  EXPECT_LT(Alone(strip), wire);
}

TEST(WireProof, AWireOf12MillimetresIsNotTooThick) {
  StretchEvidence thick = Wire();
  thick.width = 0.012;
  thick.diameter = 0.012;
  EXPECT_DOUBLE_EQ(Alone(thick), Alone(Wire()));
}

TEST(WireProof, ColoursBesideItTellWhereTheyChange) {
  EXPECT_GT(Alone(OpenInColour(ShelfEdge())), Alone(ShelfEdge()));  // depth has filled a gap
  StretchEvidence closed = Wire();
  closed.beside = {3, 25};
  closed.on_surfaces = 3;
  EXPECT_LT(Alone(closed), Alone(Wire()));
}

TEST(WireProof, WhatChangesFarMoreThanSurfacesIsOpenBeforePatchesToo) {
  StretchEvidence patches = Wire();
  patches.beside = {16, 54};
  patches.on_surfaces = 1.5;
  EXPECT_GT(Alone(patches), Alone(Wire()));
  patches.on_surfaces = 8;
  EXPECT_LT(Alone(patches), Alone(Wire()));
  patches.on_surfaces = 0;  // not known
  EXPECT_LT(Alone(patches), Alone(Wire()));
}

TEST(WireProof, ColoursOfEvenBackgroundsOrOfPoorPosesTellLittle) {
  StretchEvidence even = ShelfEdge();
  even.beside = {0.9, 1};
  even.on_surfaces = 0.5;
  EXPECT_NEAR(Alone(even), Alone(ShelfEdge()), 0.02);
  StretchEvidence poor = OpenInColour(ShelfEdge());
  poor.on_surfaces = 20;  // surfaces change as much
  EXPECT_LT(Alone(poor), Alone(OpenInColour(ShelfEdge())));
}

TEST(WireProof, AThickBarIsNoWireWhereColourShowsItOpen) {
  StretchEvidence bar = OpenInColour(Wire());
  bar.width = 0.03;
  bar.diameter = 0.025;
  EXPECT_LT(Alone(bar), 0.2);
}

TEST(WireProof, FewImagesWeighLittle) {
  StretchEvidence few = ShelfEdge();
  few.images = 1;
  StretchEvidence none = ShelfEdge();
  none.images = 0;
  EXPECT_GT(Alone(few), Alone(ShelfEdge()));
  EXPECT_DOUBLE_EQ(Alone(none), Alone(StretchEvidence()));
}

TEST(WireProof, WhatIsConnectedSpeaksForAStretch) {
  Stretches connected, apart;
  StretchEvidence unclear = Wire();
  unclear.open = 0.3;
  unclear.past = 0.5;
  connected.Add(Vec3::Zero(), unclear);
  apart.Add(Vec3::Zero(), unclear);
  apart.Add({0.05, 0, 0}, Wire());
  Stretches far = connected;
  far.Add({1, 0, 0}, Wire());
  // The same neighbour, joined to the end of the first.
  const NodeId end = connected.skeleton.Nodes()[1];
  const NodeId next = connected.skeleton.AddNode({0.08, 0, 0});
  StretchEvidence neighbour = Wire();
  neighbour.edge = connected.skeleton.AddEdge({{end, next}, {{0.04, 0, 0}, {0.08, 0, 0}}, {}, {}});
  neighbour.part = {0, 1};
  neighbour.length = 0.04;
  neighbour.middle = {0.06, 0, 0};
  connected.evidence.push_back(neighbour);
  EXPECT_GT(connected.Probability(0), apart.Probability(0));
  EXPECT_DOUBLE_EQ(apart.Probability(0), Alone(unclear));
  EXPECT_DOUBLE_EQ(far.Probability(0), Alone(unclear));
}

TEST(WireProof, WhatWasRefutedBesideAStretchSpeaksAgainstItStill) {
  Stretches left;
  left.Add(Vec3::Zero(), Wire());
  left.refuted = {{{0.3, 0, 0}, 0.04, -3}};
  EXPECT_DOUBLE_EQ(left.Probability(0), Alone(Wire()));  // too far away
  left.refuted = {{{0.1, 0, 0}, 0.04, -3}};
  EXPECT_LT(left.Probability(0), Alone(Wire()));
}

TEST(WireProof, NamesWhatSpeaksMostAgainstIt) {
  const auto doubt = [](const StretchEvidence& evidence) {
    Stretches one;
    one.Add(Vec3::Zero(), evidence);
    return ProveWires(one.skeleton, one.evidence, {})[0].doubt;
  };
  EXPECT_EQ(doubt(ShelfEdge()), Doubt::kSurface);
  StretchEvidence slat = Wire();
  slat.width = 0.03;
  EXPECT_EQ(doubt(slat), Doubt::kThick);
  StretchEvidence nothing = Wire();
  nothing.past = 0.9;
  EXPECT_EQ(doubt(nothing), Doubt::kLookedPast);
  EXPECT_EQ(doubt({}), Doubt::kUnproven);
}

}  // namespace
}  // namespace curvefusion
