#include "meshing/stubs.h"

#include <map>
#include <utility>

namespace curvefusion {

namespace {

void AddBand(const TubeRings& rings, int ring, std::vector<std::array<int, 3>>& triangles) {
  const int sides = rings.sides;
  const int next = (ring + 1) % rings.ring_count;
  for (int k = 0; k < sides; ++k) {
    const int a = ring * sides + k;
    const int b = ring * sides + (k + 1) % sides;
    const int c = next * sides + k;
    const int d = next * sides + (k + 1) % sides;
    triangles.push_back({a, b, d});
    triangles.push_back({a, d, c});
  }
}

void AddPoleFan(const TubeRings& rings, int side, std::vector<std::array<int, 3>>& triangles) {
  const int first = side == 0 ? 0 : (rings.ring_count - 1) * rings.sides;
  for (int k = 0; k < rings.sides; ++k) {
    const int a = first + k;
    const int b = first + (k + 1) % rings.sides;
    triangles.push_back(side == 0 ? std::array<int, 3>{b, a, rings.poles[0]}
                                  : std::array<int, 3>{a, b, rings.poles[1]});
  }
}

// A disc over a ring without new vertices, as a zigzag; `backwards` faces the start of the tube.
void AddDisc(const TubeRings& rings, int ring, bool backwards,
             std::vector<std::array<int, 3>>& triangles) {
  const int base = ring * rings.sides;
  int low = 0;
  int high = rings.sides - 1;
  for (bool raise_low = true; high - low > 1; raise_low = !raise_low) {
    const int middle = raise_low ? low + 1 : high - 1;
    std::array<int, 3> triangle = {base + low, base + middle, base + high};
    if (backwards) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
    (raise_low ? low : high) = middle;
  }
}

int SegmentCount(const TubeRings& rings) {
  return static_cast<int>(rings.ring_of_point.size()) - (rings.closed ? 0 : 1);
}

// One past the last band of a segment.
int BandsEnd(const TubeRings& rings, int segment) {
  return segment + 1 < static_cast<int>(rings.ring_of_point.size())
             ? rings.ring_of_point[segment + 1]
             : rings.ring_count;
}

std::vector<std::array<int, 3>> SideTriangles(const TubeRings& rings, int first_segment,
                                              int last_segment) {
  std::vector<std::array<int, 3>> triangles;
  for (int segment = first_segment; segment < last_segment; ++segment) {
    const auto side = SegmentTriangles(rings, segment % SegmentCount(rings));
    triangles.insert(triangles.end(), side.begin(), side.end());
  }
  return triangles;
}

TriangleMesh WithUsedVertices(const TubeRings& rings, std::vector<std::array<int, 3>> triangles) {
  TriangleMesh mesh;
  // A map, not a table: the stub of a long tube uses few of its vertices.
  std::map<int, int> compact;
  for (std::array<int, 3>& triangle : triangles) {
    for (int& vertex : triangle) {
      const auto [entry, is_new] =
          compact.try_emplace(vertex, static_cast<int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(rings.vertices[vertex]);
      vertex = entry->second;
    }
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

}  // namespace

std::vector<std::array<int, 3>> SegmentTriangles(const TubeRings& rings, int segment) {
  std::vector<std::array<int, 3>> triangles;
  const bool starts = !rings.closed && segment == 0;
  const bool finishes = !rings.closed && segment + 1 == SegmentCount(rings);
  const int first = starts ? 0 : rings.ring_of_point[segment];
  const int end = finishes ? rings.ring_count - 1 : BandsEnd(rings, segment);
  for (int ring = first; ring < end; ++ring) AddBand(rings, ring, triangles);
  for (int side = 0; side < 2; ++side) {
    if (!(side == 0 ? starts : finishes)) continue;
    if (rings.poles[side] >= 0) {
      AddPoleFan(rings, side, triangles);
    } else {
      AddDisc(rings, side == 0 ? 0 : rings.ring_count - 1, side == 0, triangles);
    }
  }
  return triangles;
}

TriangleMesh SideOfStub(const TubeRings& rings, int first_segment, int last_segment) {
  return WithUsedVertices(rings, SideTriangles(rings, first_segment, last_segment));
}

TriangleMesh CloseStub(const TubeRings& rings, int first_segment, int last_segment) {
  const int count = SegmentCount(rings);
  std::vector<std::array<int, 3>> triangles = SideTriangles(rings, first_segment, last_segment);
  const bool whole_ring = rings.closed && last_segment - first_segment == count;
  const auto ring_at = [&](int point) {
    return rings.ring_of_point[point % (count + !rings.closed)];
  };
  if (!whole_ring && (rings.closed || first_segment > 0)) {
    AddDisc(rings, ring_at(first_segment), true, triangles);
  }
  if (!whole_ring && (rings.closed || last_segment < count)) {
    AddDisc(rings, ring_at(last_segment), false, triangles);
  }
  return WithUsedVertices(rings, std::move(triangles));
}

}  // namespace curvefusion
