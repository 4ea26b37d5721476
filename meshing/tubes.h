#pragma once

#include <string>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/options.h"
#include "meshing/surface_mesh.h"
#include "meshing/tube_paths.h"
#include "meshing/watertight.h"

namespace curvefusion {

/// How tubes are made of a skeleton.
struct TubeOptions {
  double default_radius = 0.0025;  ///< m, > 0, of edges without radii; Kinect-size wires
  int sides = 16;  ///< corners of a ring, 8 to 64; chosen here: 16 differ from a circle by 1.3 %
  double ring_spacing = 2.5;     ///< radii between rings along straight tubes, 1 to 20; chosen here
  double axis_tolerance = 0.02;  ///< radii by which the simplified axis may differ, 0.005 to 0.2;
                                 ///< chosen here: far below what a scan resolves
  int attempts = 8;              ///< per junction, each a little perturbed, 1 to 20; chosen here
};

/// Visits the options (section "tubes").
void VisitOptions(TubeOptions& options, OptionVisitor& visitor);

/// A place that did not come out at the first attempt.
struct TubeFallback {
  Vec3 position = Vec3::Zero();  ///< about the middle of the tubes that meet there
  int tubes = 0;                 ///< how many tubes the remedy changed
  int attempts = 0;              ///< how many it took
  std::string remedy;            ///< what was done, a phrase
  bool last_resort = false;      ///< wrapped or resampled: not of the true shape there
};

/// The tubes of a skeleton as one surface.
struct TubeMesh {
  SurfaceMesh
      surface;  ///< outward normals, metres, float32; WriteMesh takes ToTriangleMesh(surface)
  WatertightReport report;              ///< of the surface; always watertight unless empty
  std::vector<TubePath> paths;          ///< tubes swept in one piece (for ComputeTubeNormals)
  int unions = 0;                       ///< junctions, contacts and groups of them, united exactly
  std::vector<TubeFallback> fallbacks;  ///< empty when all unions came out at once
};

/// Sweeps a circle of the local radius along every edge and unites all tubes that touch, whether
/// joined in the skeleton or not; free ends are rounded by hemispheres. The surface is closed,
/// consistently oriented, 2-manifold, free of self-intersections, bounds the volume of the union of
/// the tubes and stays so in float32 files: all of this is checked before it is returned. Nodes
/// without edges are ignored; an empty skeleton gives an empty surface. Throws Error(kBadInput)
/// for radii or coordinates that cannot be (see PrepareTubes) and, naming the place, where nothing
/// gives a sound surface. Where an exact union fails in all turns of the
/// tubes' rings that are tried, the tubes there are replaced by an approximate closed surface (see
/// TubeFallback::last_resort). Tubes
/// are polygons about a simplified axis: gaps, contacts and holes of less than about a tenth of the
/// radius may come out either way. Cost: 3 to 7 ms of one core per junction. The paper assumes
/// tubes of constant radius about the curves (CurveFusion 4.3) and does not say how they join.
TubeMesh BuildTubes(const SkeletonGraph& graph, const TubeOptions& options);

}  // namespace curvefusion
