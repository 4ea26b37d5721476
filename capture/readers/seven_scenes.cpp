#include "capture/readers/frame_assembly.h"
#include "capture/readers/readers.h"
#include "capture/trajectory.h"

namespace curvefusion {

namespace {

constexpr PinholeCamera kPublishedCamera = {640, 480, 585, 585, 320, 240};
constexpr double kMillimetreUnits = 1000;
constexpr int kInvalidDepth = 65535;

Intrinsics ReadSevenScenesIntrinsics(const std::filesystem::path& path,
                                     const FindingHandler& on_finding) {
  if (std::filesystem::exists(path)) return ReadIntrinsics(path, on_finding);
  on_finding({Severity::kWarning,
              path.string() + ": is missing; the cameras that 7-Scenes was published with are used "
                              "(640x480, f 585, centre 320, 240)"});
  Intrinsics intrinsics;
  intrinsics.depth_camera = intrinsics.color_camera = kPublishedCamera;
  return intrinsics;
}

Sequence ReadWith(const std::filesystem::path& folder, const PoseLookup& find_pose,
                  const FindingHandler& on_finding) {
  Sequence sequence;
  sequence.invalid_depth = kInvalidDepth;
  UseIntrinsics(ReadSevenScenesIntrinsics(folder / "intrinsics.json", on_finding), kMillimetreUnits,
                sequence);
  AddFrames(ImagesByFrameNumber(folder, ".color"), ImagesByFrameNumber(folder, ".depth"), find_pose,
            sequence);
  return sequence;
}

}  // namespace

Sequence ReadSevenScenes(const std::filesystem::path& folder, const FindingHandler& on_finding) {
  const auto find_pose = [&](int, const std::filesystem::path& depth_path) {
    const std::filesystem::path path = folder / (FrameName(depth_path) + ".pose.txt");
    if (!std::filesystem::exists(path)) return std::optional<RigidTransform>();
    return ReadPoseMatrix(path, on_finding);
  };
  return ReadWith(folder, find_pose, on_finding);
}

Sequence ReadSevenScenesImages(const std::filesystem::path& folder,
                               const FindingHandler& on_finding) {
  return ReadWith(folder, NoPose, on_finding);
}

}  // namespace curvefusion
