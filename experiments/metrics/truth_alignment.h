#pragma once

#include "experiments/metrics/alignment_points.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// The rigid motion of a result under which most of the truth is explained (see
/// ExplainingPoints::ShareOf, to 10 mm), of several starts, never less than where the result lies.
/// Each start is refined by pairs from truth to result within 20, 10, 5 and 2.5 mm, with Tukey's
/// weights, so that neither false nor missing curves move it. The first start is where the result
/// lies; others (see AlignmentStarts) must explain 5 % more of the truth: a result in another frame
/// than its truth is not found, a symmetric object is not turned. What curves do not determine (the
/// motion along a straight wire, the turn of a ring) stays as it is. Identity for fewer than 11
/// points of a result. The same bits for any number of threads. Of a truth of more than 20,000
/// points evenly many count.
RigidTransform AlignToTruth(const AlignmentPoints& result, const AlignmentPoints& truth);

}  // namespace curvefusion
