#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "capture/content/thumbnails.h"

namespace curvefusion {

/// Two frames whose depth is compared.
struct FramePair {
  int from = 0;
  int to = 0;
  int gap() const { return to - from; }
};

/// Pairs of frames 1, 3, 10 and 30 apart, evenly spread over a sequence, at most `starts` of each
/// gap. Short sequences have the gaps that fit twice into them.
std::vector<FramePair> SpreadPairs(int frame_count, int starts);

/// The frames that occur in pairs, each once, ascending.
std::vector<int> FramesOf(const std::vector<FramePair>& pairs);

/// Poses T_world_camera by frame; none where a hypothesis has none.
using FramePoses = std::vector<std::optional<RigidTransform>>;

/// How well the depth of one frame, moved by the poses, lies on that of the other. Relative to
/// distance, so that the unit of depth and poses together does not matter.
struct PairAgreement {
  double overlap = 0;     ///< share of the measured points that fall on measured depth of the other
  double cost = 1;        ///< mean of min(|dz| / (0.05 z), 1) over the overlap
  double residual = 0;    ///< median of |dz| / z over the overlap, which occlusion does not spoil
  double difference = 0;  ///< likewise of |dz|, metres
  bool is_usable = false;  ///< enough overlap to speak
};

/// Depth in metres by frame: thumbnails with a unit, to be looked up between pixels.
class DepthViews {
 public:
  /// `swap_bytes` reads every 16-bit value with its bytes swapped.
  DepthViews(const Thumbnails& thumbnails, double depth_scale, bool swap_bytes = false);

  bool empty() const { return depth_.empty(); }
  bool Has(int frame) const { return !depth_[static_cast<size_t>(frame)].empty(); }

  /// Compares both ways, `from` seen in `to` and `to` in `from`.
  PairAgreement Compare(const FramePair& pair, const RigidTransform& T_to_from) const;

  /// A point of one frame seen in another.
  struct Overlap {
    float distance = 0;    ///< metres, where the other frame measured it
    float difference = 0;  ///< metres, of the measured distance minus that of the moved point
  };

  /// All overlaps of `from` seen in `to`; `samples` counts the measured points looked at.
  std::vector<Overlap> Overlaps(int from, int to, const RigidTransform& T_to_from,
                                int& samples) const;

  const PinholeCamera& camera() const { return camera_; }
  const DepthImage& depth(int frame) const { return depth_[static_cast<size_t>(frame)]; }

 private:
  PinholeCamera camera_;
  std::vector<DepthImage> depth_;
};

/// How well poses fit depth over many pairs.
struct PoseAgreement {
  std::vector<PairAgreement> pairs;  ///< as the pairs given; unusable ones too
  int usable = 0;                    ///< number of usable pairs
  double cost = 1;                   ///< median of the usable pairs' costs
  double residual = 0;               ///< likewise, of their residuals
  double difference = 0;             ///< likewise, of their differences, metres
  double overlap = 0;                ///< median over all pairs
};

PoseAgreement MeasureAgreement(const DepthViews& views, const std::vector<FramePair>& pairs,
                               const FramePoses& poses);

}  // namespace curvefusion
