#pragma once

#include <optional>
#include <string>

#include "experiments/metrics/curve_metrics.h"
#include "experiments/metrics/diameter_metrics.h"
#include "experiments/metrics/junction_metrics.h"
#include "experiments/metrics/mesh_metrics.h"
#include "experiments/metrics/topology_metrics.h"
#include "meshing/tube_volume.h"

namespace curvefusion {

/// Every figure that depends on where the result lies.
struct PlacedScores {
  DistanceScores curves;
  JunctionScores junctions_10mm;
  JunctionScores junctions_5mm;
  TipScores tips_5mm;
  AplsScores paths;
  DiameterScores diameters;
  std::optional<SurfaceScores> surface;  ///< where a mesh was given
};

/// Figures of the main piece of a result (see MainPiece) alone, against the whole truth.
struct MainPieceScores {
  double length = 0;  ///< metres
  int cycles = 0;
  PlacedScores raw;  ///< all but `surface`
  PlacedScores aligned;
};

/// A result compared with the truth as it lies, and after one rigid alignment of its curves (of its
/// surface, where there are none).
struct Evaluation {
  bool has_curves = true;  ///< false for a bare mesh, which only `surface` and `mesh` tell of
  PlacedScores raw;
  PlacedScores aligned;
  RigidTransform T_truth_result = RigidTransform::Identity();  ///< the alignment
  TopologyScores topology;
  MainPieceScores main_piece;
  double length = 0;                         ///< metres of curve in the result
  double true_length = 0;                    ///< and in truth
  std::optional<WatertightReport> mesh;      ///< of the part around the truth
  double mesh_area_outside = 0;              ///< m^2 of the rest, which nothing else looks at
  std::optional<SampledVolume> true_volume;  ///< of the union of the true tubes, beside a mesh

  /// Volume of the mesh over that of the true tubes; nothing where the part around the truth is
  /// not closed, as its volume depends on where it is cut.
  std::optional<double> VolumeRatio() const;
};

/// Compares a skeleton, and the mesh beside it unless that is null, with a truth that has radii.
Evaluation Evaluate(const SkeletonGraph& result, const TriangleMesh* mesh,
                    const SkeletonGraph& truth);

/// Compares a mesh that comes without curves, as volumetric methods give it.
Evaluation EvaluateMesh(const TriangleMesh& mesh, const SkeletonGraph& truth);

}  // namespace curvefusion
