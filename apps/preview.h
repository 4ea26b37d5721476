#pragma once

#include <string>

#include "capture/sequence.h"
#include "graph/skeleton_graph.h"
#include "kernel/image.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// The result at a glance: the graph over the points it was made from, seen from where the camera
/// was, from the side and from above, and the tubes drawn into the frame that sees most of them.
/// Uncertain curves are drawn as the points are; where the graph is empty, they are what the
/// picture shows. One of both must not be empty.
ColorImage DrawPreview(const SkeletonGraph& graph, const SkeletonGraph& uncertain,
                       const ObservedPoints& points, const Sequence& sequence,
                       const std::string& title);

/// The axes of the view from the mean camera: rows are right, up and towards the viewer.
Mat3 MeanCameraAxes(const Sequence& sequence);

}  // namespace curvefusion
