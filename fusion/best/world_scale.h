#pragma once

#include <optional>

#include "capture/sequence.h"
#include "fusion/reconstruction.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// Scales all that has a length in a result, and where its cameras are, about a point of its world.
void ScaleAbout(const Vec3& fixed, double scale, Reconstruction& result);

/// How many times larger the world should be for the wires of a result to be as thick as those that
/// the lengths of the best profile were chosen on, and pixels of depth no coarser than in these
/// scans; as coarse as there for a result without curves. Nothing where that is less than twice, or
/// depth images do not show the wires.
std::optional<double> MagnificationFor(const Reconstruction& result);

/// The sequence in a world that is so many times as large.
Sequence Magnified(Sequence sequence, double magnification);

/// A result for Magnified(given, magnification), in the world of the given sequence; what its
/// stages counted stays that of the magnified one.
Reconstruction Reduced(Reconstruction result, double magnification, const Sequence& given);

/// Hands on what it hears of a run in a magnified world, in the given one; tables and the volume,
/// which were handed on before, are left out.
class ReducingObserver : public PipelineObserver {
 public:
  ReducingObserver(PipelineObserver& observer, double magnification)
      : observer_(observer), magnification_(magnification) {}

  void OnPlan(const std::vector<PlannedStage>& stages) override { observer_.OnPlan(stages); }
  void OnProgress(const std::string& stage, int64_t done, int64_t total) override {
    observer_.OnProgress(stage, done, total);
  }
  void OnPoints(const std::string& name, const ObservedPoints& points) override;
  void OnGraph(const std::string& name, const SkeletonGraph& graph) override;

 private:
  PipelineObserver& observer_;
  double magnification_;
};

}  // namespace curvefusion
