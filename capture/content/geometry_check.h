#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/content/thumbnails.h"
#include "capture/finding.h"

namespace curvefusion {

/// How far depth of different frames disagrees where they show the same surface.
struct DepthDisagreement {
  int gap = 0;          ///< frames between them, 0 = all gaps
  double distance = 0;  ///< metres, median
  double residual = 0;  ///< metres, median of the absolute difference along the optical axis
  double spread = 0;    ///< metres, interquartile range of the difference
  double noise = 0;     ///< metres, what sensor noise alone would give for the residual
  double overlap = 0;   ///< share of the measured points that the other frame sees; 0 where
                        ///< it is by distance
  int points = 0;
};

/// A sequence as it should have been.
struct SequenceCorrection {
  Sequence sequence;              ///< with right poses, frames and depth scale
  bool swap_bytes = false;        ///< of every depth value
  std::vector<std::string> made;  ///< what was changed, a clause each
};

/// Frames from one to another, both included, by their names.
struct FrameStretch {
  std::string first;
  std::string last;
};

/// By how much something is wrong.
struct MistakeAmount {
  double value = 0;
  std::string unit;  ///< "frames", "s", "factor" or "units per metre"
};

/// A mistake that was found, for programs: what the finding of the same cause tells in words.
struct Mistake {
  std::string cause;                         ///< as CheckFinding::cause
  std::vector<FrameStretch> frames = {};     ///< where it concerns some only
  std::optional<MistakeAmount> amount = {};  ///< docs/formats_output.md: of what, by cause
};

/// What the depth of a sequence says of its poses.
struct GeometryReport {
  bool is_judged = false;  ///< whether depth can tell right poses from wrong ones
  std::string why_not;     ///< where it cannot
  bool fits = false;       ///< judged, and nothing is wrong on the whole
  int frames = 0;          ///< compared
  std::vector<DepthDisagreement> by_gap;
  std::vector<DepthDisagreement> by_distance;
  std::vector<Mistake> mistakes;                 ///< that were found
  std::optional<SequenceCorrection> correction;  ///< where one is known
};

/// Compares the depth of frames 1, 3, 10 and 30 apart, moved by their poses, reports what is wrong
/// with poses, depth unit, clocks and order, and names its cause. Needs the thumbnails of the
/// frames it compares; those that are missing are left out. About .1 s; 2 s where poses do not fit.
GeometryReport CheckGeometry(const Sequence& sequence, const Thumbnails& thumbnails,
                             const FindingHandler& on_finding);

/// For a TUM sequence whose images hardly have poses: looks for an offset of the trajectory's clock
/// with which depth fits. `sequence` must have all pairs of images, whatever their poses
/// (ReadTumImages). A second or two.
GeometryReport CheckClocks(const Sequence& sequence, const FindingHandler& on_finding);

/// The same as CheckGeometry from about 30 frames, which it decodes: for the start of a
/// reconstruction. Throws Error(kBadInput) for what cannot work; adds to the sequence's warnings
/// what is in doubt.
void RequireFittingPoses(Sequence& sequence);

/// Whether depth of frames up to 30 apart disagrees, whatever the cause; not where it cannot tell.
/// Decodes about 30 depth images.
bool DepthDisagrees(const Sequence& sequence);

/// By which factor the cameras' positions are to be multiplied so that depth agrees best: what
/// poses that were found without depth are too large by; nothing where it cannot tell. Tried are
/// .94 to 1.06. Decodes 16 depth images.
std::optional<double> ScaleByDepth(const Sequence& sequence);

/// How many times less depth disagrees with some poses than with others.
struct DepthGain {
  double near = 1;  ///< of frames up to 30 apart
  double far = 1;   ///< of any frames, in the mean: where poses jump once, only this tells
};

/// The frames that GainOfDepth compares: two dozen, or less where a sequence is short; ascending.
std::vector<int> FramesOfGain(const Sequence& sequence);

/// With the poses of `corrected` against those of `given`, a sequence of the same images; nothing
/// where frames up to 30 apart cannot tell. Decodes FramesOfGain.
std::optional<DepthGain> GainOfDepth(const Sequence& given, const Sequence& corrected);

}  // namespace curvefusion
