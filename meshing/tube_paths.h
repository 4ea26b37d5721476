#pragma once

#include <array>
#include <vector>

#include "meshing/tube_axis.h"
#include "meshing/tube_network.h"

namespace curvefusion {

/// How a tube ends.
struct TubeEnd {
  bool rounded = true;  ///< by a hemisphere; otherwise flat, inside a thicker or equal tube
  double radius = 0;    ///< of the flat disc
  bool joined = false;  ///< to other tubes, so that little is seen of a dome
};

/// A tube to be swept in one piece: at every inner point of the axis a mitred ring.
struct TubePath {
  TubeAxis axis;        ///< a closed path does not repeat its first point
  bool closed = false;  ///< a ring without ends
  std::array<TubeEnd, 2> ends;
  std::vector<int> curves = {};  ///< of the network, along which it runs (TubeNetwork::curves)

  int segment_count() const { return static_cast<int>(axis.points.size()) - (closed ? 0 : 1); }
};

/// Chains branches that run straight on through a node (by less than `max_turn` radians, with about
/// the same radius, without folding) and says how the others end there: the thickest tube at a node
/// carries a ball of its radius, all other ends lie flat inside that ball, so their union leaves no
/// gap. Rings are at most
/// `ring_spacing` radii apart, twice as far at nodes that a tube runs straight through.
std::vector<TubePath> ChainTubes(const TubeNetwork& network, double max_turn, double ring_spacing);

/// Cuts a path in two at an inner point: the first part ends rounded there, the second flat inside
/// it. A closed path is opened instead (one part).
std::vector<TubePath> CutPath(const TubePath& path, int point_index);

}  // namespace curvefusion
