#include "experiments/simulation/drift.h"

#include <map>

#include "experiments/simulation/noise_process.h"
#include "kernel/angle.h"
#include "kernel/error.h"
#include "kernel/options.h"
#include "kernel/rigid_motion.h"

namespace curvefusion {
namespace {

// As tables of trackers have them: millimetres and degrees.
PoseErrorModel Model(double drift_memory, double drift_mm, double drift_deg, double walk_mm,
                     double walk_deg, double jitter_memory, double jitter_mm, double jitter_deg) {
  return {
      drift_memory,       drift_mm * kMillimetre, drift_deg * kDegree,     walk_mm * kMillimetre,
      walk_deg * kDegree, jitter_memory,          jitter_mm * kMillimetre, jitter_deg * kDegree};
}

const std::map<std::string, PoseErrorModel>& Models() {
  static const std::map<std::string, PoseErrorModel> models = {
      {"true", PoseErrorModel()},
      {"orbslam2", Model(10, 4, 0.25, 0.3, 0.01, 0.15, 0.5, 0.03)},
      {"bundlefusion", Model(15, 5, 0.30, 0.3, 0.01, 0.3, 0.4, 0.03)},
      {"arkit", Model(10, 4, 0.25, 2, 0.05, 0.1, 0.5, 0.03)},
      {"kinfu", Model(20, 4, 0.25, 1.5, 0.06, 0.3, 0.3, 0.02)},
      {"kitchen", Model(6, 5.5, 0.4, 0, 0, 0.3, 0.2, 0.02)},
      {"ptam", Model(5, 12, 0.8, 3, 0.1, 0.1, 2, 0.15)}};
  return models;
}

}  // namespace

std::vector<std::string> PoseSourceNames() {
  std::vector<std::string> names;
  for (const auto& [name, model] : Models()) names.push_back(name);
  return names;
}

PoseErrorModel PoseErrorOf(const std::string& source, double scale) {
  const auto found = Models().find(source);
  if (found == Models().end()) {
    throw Error(ErrorKind::kUsage, "no pose source is called '" + source + "'; did you mean '" +
                                       NearestName(source, PoseSourceNames()) + "'?");
  }
  PoseErrorModel model = found->second;
  for (double* sigma : {&model.drift_translation, &model.drift_rotation, &model.walk_translation,
                        &model.walk_rotation, &model.jitter_translation, &model.jitter_rotation}) {
    *sigma *= scale;
  }
  return model;
}

std::vector<RigidTransform> DriftedPoses(const std::vector<RigidTransform>& true_poses,
                                         double frame_rate, const PoseErrorModel& model,
                                         uint64_t seed) {
  Random random(seed, RandomStream::kDrift);
  const double step = 1 / frame_rate;
  PoseSway drift(model.drift_translation, model.drift_rotation, model.drift_memory,
                 model.drift_memory);
  PoseSway jitter(model.jitter_translation, model.jitter_rotation, model.jitter_memory,
                  model.jitter_memory);
  Vec3 walk_translation = Vec3::Zero();
  Vec3 walk_rotation = Vec3::Zero();
  std::vector<RigidTransform> poses;
  for (const RigidTransform& true_pose : true_poses) {
    poses.push_back(true_pose *
                    RigidMotion(drift.rotation() + jitter.rotation() + walk_rotation,
                                drift.translation() + jitter.translation() + walk_translation));
    drift.Step(step, random);
    jitter.Step(step, random);
    for (int axis = 0; axis < 3; ++axis) {
      walk_translation[axis] += model.walk_translation * std::sqrt(step) * random.Normal();
      walk_rotation[axis] += model.walk_rotation * std::sqrt(step) * random.Normal();
    }
  }
  return poses;
}

}  // namespace curvefusion
