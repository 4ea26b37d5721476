#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "graph/skeleton_graph.h"
#include "graph/spline_fit.h"

namespace curvefusion {

/// What a format does not carry of a graph, a sentence each.
using FormatLosses = std::vector<std::string>;

/// The file formats of graphs besides skeleton.json; graph_io.h chooses by extension and makes
/// writing atomic. Readers take the text and name of a file and throw Error(kBadInput) with place
/// and reason; writers want finite values.

FormatLosses WriteGraphml(const std::filesystem::path& path, const SkeletonGraph& graph);
/// Boost's reader behind a check of the nesting, because it recurses. An edge without `points` is
/// straight.
SkeletonGraph ReadGraphml(const std::string& text, const std::string& source);

/// Every component is a tree that begins at its first node, breadth first; an edge that would close
/// a cycle ends in a copy of its node.
FormatLosses WriteSwc(const std::filesystem::path& path, const SkeletonGraph& graph);
SkeletonGraph ReadSwc(const std::string& text, const std::string& source);

FormatLosses WriteLinePly(const std::filesystem::path& path, const SkeletonGraph& graph);
/// ASCII only; elements other than vertex and edge, and further properties, are skipped.
SkeletonGraph ReadLinePly(const std::string& text, const std::string& source);

FormatLosses WriteLineObj(const std::filesystem::path& path, const SkeletonGraph& graph);
/// Statements other than v and l are skipped.
SkeletonGraph ReadLineObj(const std::string& text, const std::string& source);

FormatLosses WriteDxf(const std::filesystem::path& path, const SkeletonGraph& graph);

/// Views of the graph as it lies: front (x right, y down), side (z right, y down) and top (x right,
/// z down), at full size in millimetres, with dimension lines.
FormatLosses WriteSvg(const std::filesystem::path& path, const SkeletonGraph& graph);

/// OpenUSD in ASCII: one BasisCurves prim of linear curves, metres in float32, with widths.
FormatLosses WriteUsda(const std::filesystem::path& path, const SkeletonGraph& graph);

/// What formats of mere curves lose of a graph.
FormatLosses LossesOfCurves(const SkeletonGraph& graph, bool keeps_radii);

/// Edges as cubic B-splines, for the formats that have such curves.
using FittedCurves = std::vector<std::pair<EdgeId, CubicSpline>>;

/// SPLINE entities of release 2000, millimetres.
void WriteDxfSplines(const std::filesystem::path& path, const FittedCurves& fitted);
/// The same curves as cubic Bezier pieces of one BasisCurves prim.
void WriteUsdaSplines(const std::filesystem::path& path, const FittedCurves& fitted);
/// AP214: a wireframe of B_SPLINE_CURVE_WITH_KNOTS, millimetres.
void WriteStepSplines(const std::filesystem::path& path, const FittedCurves& fitted);

}  // namespace curvefusion
