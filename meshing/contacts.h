#pragma once

#include <vector>

#include "meshing/tube_paths.h"

namespace curvefusion {

/// A stretch of segments first..last-1 of one path. On a closed path `last` may exceed the number
/// of segments: the stretch then runs over the start.
struct TubeStretch {
  int path = 0;
  int first = 0;
  int last = 0;
};

/// Cuts every path that touches itself, so that no part of it does. Paths keep their order.
std::vector<TubePath> CutSelfContacts(std::vector<TubePath> paths);

/// Groups the segments of all tubes so that tubes of different groups are clear of each other
/// except where a stretch of one group continues, through a ring that nothing else comes near, in
/// another. A group of a single stretch touches nothing; any other is a junction, a contact or
/// several of them in reach of each other. Groups and stretches come in the order of paths and
/// segments. Near-linear in segments and in pairs that come near each other, with O(n log n)
/// for a tree of boxes.
std::vector<std::vector<TubeStretch>> GroupContacts(const std::vector<TubePath>& paths);

/// Of each segment of each path, whether it passes another tube, or its own after a turn, at about
/// the distance at which tubes touch or close a hole: there a small error of the surface decides
/// what is joined. Near-linear, as GroupContacts.
std::vector<std::vector<char>> FindGrazingSegments(const std::vector<TubePath>& paths);

}  // namespace curvefusion
