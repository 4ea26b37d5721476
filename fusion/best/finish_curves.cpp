#include "fusion/best/finish_curves.h"

#include <algorithm>
#include <limits>

#include "fusion/best/colour_fit.h"
#include "fusion/best/net_stage.h"
#include "graph/contraction/hidden_parts.h"
#include "graph/crossings.h"
#include "graph/intersections.h"
#include "graph/validate.h"

namespace curvefusion {

namespace {

// What a pixel of the nearest colour image shows of the object, metres.
double FinestPixel(const Sequence& sequence, const SkeletonGraph& skeleton) {
  const Vec3 middle = BoundsOf(skeleton).center();
  double nearest = std::numeric_limits<double>::infinity();
  for (const SequenceFrame& frame : sequence.frames)
    nearest = std::min(nearest, (frame.T_world_camera.translation() - middle).norm());
  return nearest / sequence.color_camera.fx;
}

// Makes junctions where curves come within the proximity of each other; false where none do.
bool ResolveContacts(SkeletonGraph& skeleton) {
  if (Violations(skeleton, kProximity).empty()) return false;
  ResolveIntersections(skeleton, kProximity);
  return true;
}

}  // namespace

void FinishCurves(const LearnedWires& wires, const BestOptions& options,
                  const StageReporter& reporter, Reconstruction& result) {
  const NetCurves nets = TraceNets(wires.nets, reporter, result);
  SkeletonGraph& skeleton = result.skeleton;
  const int loops =
      OpenFilledLoops(skeleton, FinestPixel(result.sequence, skeleton), options.ridge.junctions);
  int hidden = MergeHiddenJunctions(skeleton);
  const int crossings = result.trust.adjusted ? SeparateCrossings(skeleton) : 0;
  const bool has_contacts = ResolveContacts(skeleton);
  if (has_contacts) {
    hidden += MergeHiddenJunctions(skeleton);
    ResolveContacts(skeleton);
  }
  if (loops > 0 || hidden > 0 || crossings > 0 || has_contacts || nets.length > 0) {
    AssignMeasuredRadii(wires.array_diameter, options.radius, reporter, result);
  }
  MeasureNetWires(nets, result);
  reporter.log.Count("radius", "loops without opening", loops);
  reporter.log.Count("radius", "junctions within wires", hidden);
  reporter.log.Count("radius", "crossings taken apart", crossings);
}

}  // namespace curvefusion
