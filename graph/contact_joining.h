#pragma once

#include <vector>

#include "graph/contacts.h"

namespace curvefusion {

/// Which contacts are joined in one go.
enum class JoinSelection {
  /// Of overlaps that meet the same part of an edge only the longest, and no crossing inside it:
  /// the others are found again once it is merged.
  kApart,
  /// All of them: where only points that coincide are in contact, what is not joined at once parts
  /// by rounding.
  kAll,
};

/// Joins contacts: makes a node where edges come together, and nodes at both ends where they run
/// along each other, so that MergeParallelEdges can make the parts between one. At least one
/// contact is joined.
void JoinContacts(SkeletonGraph& graph, const std::vector<Contact>& contacts, double threshold,
                  JoinSelection selection);

/// Makes the vertices nearest to each contact one, without moving any other; of contacts that need
/// the same vertex the nearest comes first. No points are added, so calls can be repeated only as
/// often as there are points.
void MergeContactVertices(SkeletonGraph& graph, const std::vector<Contact>& contacts);

}  // namespace curvefusion
