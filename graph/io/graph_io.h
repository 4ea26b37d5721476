#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The text of a skeleton.json: nodes and edges in ascending order of their handles, one a line,
/// every double in its shortest form that reads back to the same bits. An edge with radii has
/// `radius`, their mean, and `radii` only where they differ. Throws Error(kBadInput) where a value
/// is not finite, because JSON cannot hold it.
std::string SkeletonToJson(const SkeletonGraph& graph);

/// The graph of a skeleton.json; handles count up from 0 in the order of the file. `radius` alone
/// gives every point that radius. `source` names the input in errors. Throws Error(kBadInput) with
/// place and reason for anything that is not such a file: syntax, missing keys, another format or
/// version, numbers that are not finite, counts that do not match, edges of nodes that do not
/// exist, ends that differ from their nodes, repeated points, radii that are not positive. Names
/// every defective node, or else every defective edge, up to 1000.
SkeletonGraph SkeletonFromJson(const std::string& text, const std::string& source);

/// SkeletonToJson into a file, atomically.
void WriteSkeleton(const std::filesystem::path& path, const SkeletonGraph& graph);

/// Throws Error(kUsage) where ExportSkeleton would refuse this file for its extension, so that long
/// work before it can be spared.
void CheckSkeletonFormat(const std::filesystem::path& path);

/// Writes a graph in the format that the extension of `path` names, atomically:
/// - .json    skeleton.json, metres; bit for bit
/// - .graphml GraphML of Boost, NetworkX, Gephi, yEd: metres; bit for bit
/// - .swc     SWC of neuron morphology: micrometres; a forest, so cycles are cut
/// - .ply     vertices and edges in ASCII, metres, with radii
/// - .obj     Wavefront vertices and lines, metres
/// - .dxf     3D polylines, millimetres
/// - .svg     front, side and top view at full size, millimetres
/// - .usda    OpenUSD linear curves with widths, metres
/// Returns a sentence for everything of this graph that the format does not carry; one for each
/// cycle that is cut. Throws Error: kUsage for another extension, kBadInput for values that are not
/// finite, kResource where the file cannot be written.
std::vector<std::string> ExportSkeleton(const std::filesystem::path& path,
                                        const SkeletonGraph& graph);

/// Throws Error(kUsage) where ExportSplines would refuse this file for its extension.
void CheckSplineFormat(const std::filesystem::path& path);

/// What fitting splines to a graph came to.
struct SplineFigures {
  size_t control_points = 0;   ///< of all splines
  size_t polyline_points = 0;  ///< of all edges
  double deviation = 0;        ///< metres, the largest of CubicSpline::deviation
};

/// Writes every edge as one cubic B-spline (graph/spline_fit.h) within `tolerance` (metres) to .dxf
/// (SPLINE entities, mm), .usda (cubic Bezier curves with widths, metres) or .step (AP214
/// wireframe, mm), atomically. Throws like ExportSkeleton.
SplineFigures ExportSplines(const std::filesystem::path& path, const SkeletonGraph& graph,
                            double tolerance);

/// Reads a graph from JSON, GraphML, SWC, PLY or OBJ, by extension; a file without one is taken as
/// skeleton.json. From formats without nodes (SWC, PLY, OBJ) nodes are the points where other than
/// two segments meet, and one of every closed curve. Throws Error: kUsage for another extension,
/// kBadInput with place and reason for a file that cannot be read, has more than kMaxTextBytes, is
/// not a graph, or has points beyond kMaxCoordinate.
SkeletonGraph ReadSkeleton(const std::filesystem::path& path);

}  // namespace curvefusion
