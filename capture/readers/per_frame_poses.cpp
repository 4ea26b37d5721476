#include "capture/readers/frame_assembly.h"
#include "capture/readers/readers.h"
#include "capture/trajectory.h"

namespace curvefusion {

namespace {

constexpr double kMillimetreUnits = 1000;

Sequence ReadWith(const std::filesystem::path& folder, const PoseLookup& find_pose,
                  const FindingHandler& on_finding) {
  Sequence sequence;
  UseIntrinsics(ReadIntrinsics(folder / "intrinsics.json", on_finding), kMillimetreUnits, sequence);
  AddFrames(ImagesByFrameNumber(ColorFolder(folder)), DepthByFrameNumber(folder), find_pose,
            sequence);
  return sequence;
}

}  // namespace

Sequence ReadPerFramePoses(const std::filesystem::path& folder, const FindingHandler& on_finding) {
  const auto find_pose = [&](int, const std::filesystem::path& image) {
    const std::filesystem::path path = folder / "pose" / (FrameName(image) + ".txt");
    if (!std::filesystem::exists(path)) return std::optional<RigidTransform>();
    return ReadPoseMatrix(path, on_finding);
  };
  return ReadWith(folder, find_pose, on_finding);
}

Sequence ReadPerFrameImages(const std::filesystem::path& folder, const FindingHandler& on_finding) {
  return ReadWith(folder, NoPose, on_finding);
}

}  // namespace curvefusion
