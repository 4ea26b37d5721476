#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace curvefusion {

/// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 8 axis + c runs along an axis
/// from corner c, whose bit of that axis is 0.
/// One sign pattern of a cell: its triangles as triples of such edges.
struct MarchingCubesCase {
  int8_t edge_count = 0;
  std::array<int8_t, 15> edges{};

  constexpr void AddTriangle(int a, int b, int c) {
    for (const int edge : {a, b, c}) edges[edge_count++] = static_cast<int8_t>(edge);
  }
};

namespace marching_cubes {

constexpr int kEdgeIds = 24;

constexpr int EdgeBetween(int corner_a, int corner_b) {
  const int axis = std::countr_zero(static_cast<unsigned>(corner_a ^ corner_b));
  return 8 * axis + (corner_a & corner_b);
}

// Whether one face of the cell holds both edges.
constexpr bool ShareFace(int edge_a, int edge_b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == edge_a / 8 || axis == edge_b / 8) continue;
    if ((edge_a >> axis & 1) == (edge_b >> axis & 1)) return true;
  }
  return false;
}

// The surface cuts each face of the cell in segments, directed so that seen from outside the cell
// they run from where a walk around the face enters a stretch of negative corners to where it
// leaves it. Every cut edge is so left on one of its faces and reached on the other: the segments
// form closed loops.
constexpr std::array<int, kEdgeIds> FaceSegments(int negative) {
  std::array<int, kEdgeIds> next{};
  next.fill(-1);
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, b = (axis + 1) % 3, c = (axis + 2) % 3, side = face % 2;
    std::array<int, 4> ring = {0, 1 << b, 1 << b | 1 << c, 1 << c};  // counter-clockwise from +axis
    if (side == 0) std::swap(ring[1], ring[3]);
    for (int& corner : ring) corner |= side << axis;
    for (int i = 0; i < 4; ++i) {
      const int before = ring[(i + 3) % 4];
      if ((negative >> before & 1) != 0 || (negative >> ring[i] & 1) == 0) continue;
      int last = i;
      while (negative >> ring[(last + 1) % 4] & 1) ++last;
      next[EdgeBetween(before, ring[i])] = EdgeBetween(ring[last % 4], ring[(last + 1) % 4]);
    }
  }
  return next;
}

// Cuts ears off a loop. A diagonal within a face of the cell could coincide with one of the
// neighbouring cell and break the manifold; no loop forces one.
constexpr void Triangulate(std::array<int, 12> loop, int length, MarchingCubesCase& triangles) {
  for (; length > 3; --length) {
    int ear = 0;
    while (ShareFace(loop[(ear + length - 1) % length], loop[(ear + 1) % length])) ++ear;
    triangles.AddTriangle(loop[(ear + length - 1) % length], loop[ear], loop[(ear + 1) % length]);
    for (int i = ear; i + 1 < length; ++i) loop[i] = loop[i + 1];
  }
  triangles.AddTriangle(loop[0], loop[1], loop[2]);
}

constexpr MarchingCubesCase BuildCase(int negative) {
  MarchingCubesCase triangles;
  std::array<int, kEdgeIds> next = FaceSegments(negative);
  for (int start = 0; start < kEdgeIds; ++start) {
    std::array<int, 12> loop{};
    int length = 0;
    for (int edge = start; next[edge] >= 0;) {
      loop[length++] = edge;
      const int following = next[edge];
      next[edge] = -1;
      edge = following;
    }
    if (length > 0) Triangulate(loop, length, triangles);
  }
  return triangles;
}

}  // namespace marching_cubes

/// Indexed by the bits of the negative corners. Triangles are counter-clockwise seen from the
/// positive side. Faces with diagonal signs always separate the negative corners, so neighbouring
/// cells agree, and no diagonal lies in a face: the mesh of all cells is manifold, whatever the
/// signs.
inline constexpr std::array<MarchingCubesCase, 256> kMarchingCubesCases = [] {
  std::array<MarchingCubesCase, 256> cases;
  for (int negative = 0; negative < 256; ++negative)
    cases[negative] = marching_cubes::BuildCase(negative);
  return cases;
}();

}  // namespace curvefusion
