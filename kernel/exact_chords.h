#pragma once

#include "kernel/exact.h"

namespace curvefusion {

// The points of a segment within a distance of a point, limit included, are a chord of a sphere or
// there are none. Chords of one segment for points p and q:

/// Whether the chord for p begins no later than that for q ends, so that one can go from near p to
/// near q without turning back. There must be both. Decided exactly. distance >= 0; the segment
/// must not have length zero.
bool AreInOrder(const Segment& s, const Vec3& p, const Vec3& q, double distance);

/// Whether the line of the segment comes within the distance of p later than it does of q. It must
/// do both. Decided exactly.
bool BeginsLater(const Segment& s, const Vec3& p, const Vec3& q, double distance);

/// The parameter in [0, 1] at which the chord for p begins, in floating point: for placing points,
/// not for decisions.
double ChordBegin(const Segment& s, const Vec3& p, double distance);

}  // namespace curvefusion
