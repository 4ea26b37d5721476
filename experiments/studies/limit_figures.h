#pragma once

#include <map>
#include <string>

#include "graph/skeleton_graph.h"

namespace curvefusion {

// Figures of the study `limitations` by the place where they were measured, as in limit_objects.h.
// `result` is aligned to the truth.

/// Share of the true wires of each diameter within 5 mm of the result.
std::map<std::string, double> RecallByThickness(const SkeletonGraph& result,
                                                const SkeletonGraph& truth);

/// Share of the true wire in each range of heights of its axis above the table, on which the lowest
/// point of the truth lies, within 5 mm of the result.
std::map<std::string, double> RecallByHeight(const SkeletonGraph& result,
                                             const SkeletonGraph& truth);

/// How many junctions the result has within 20 mm of the true junction of each valence.
std::map<std::string, double> JunctionsAtHubs(const SkeletonGraph& result,
                                              const SkeletonGraph& truth);

/// 1 where that is one junction of the right valence, 0 otherwise.
std::map<std::string, double> WholeHubs(const SkeletonGraph& result, const SkeletonGraph& truth);

/// The mean measured diameter, mm, of the result's points whose nearest true wire within 10 mm has
/// about each diameter. Places without such a point are left out.
std::map<std::string, double> DiameterByTruth(const SkeletonGraph& result,
                                              const SkeletonGraph& truth);

}  // namespace curvefusion
