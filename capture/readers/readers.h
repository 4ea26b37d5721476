#pragma once

#include <filesystem>

#include "capture/finding.h"
#include "capture/sequence.h"

namespace curvefusion {

/// The readers of the four formats (DESIGN "Formats"). Each reads everything but the images and
/// reports defects of intrinsics, stamps and poses; frames with a defect are left out. Each throws
/// Error(kBadInput) where a file that it cannot do without is missing.

/// rgb.txt and depth.txt, or associations.txt; trajectory.txt or groundtruth.txt; intrinsics.json.
Sequence ReadTum(const std::filesystem::path& folder, const FindingHandler& on_finding);

/// The same with every pair of images, whether it has a pose or not; poses are the identity.
Sequence ReadTumImages(const std::filesystem::path& folder, const FindingHandler& on_finding);

/// Whether such a folder has a trajectory file.
bool HasTumTrajectory(const std::filesystem::path& folder);

/// The trajectory file of such a folder. Throws Error(kBadInput) where there is none.
std::filesystem::path TumTrajectoryPath(const std::filesystem::path& folder);

/// color/ (or colour/, rgb/, image/, images/), depth/ and pose/ with files of the same name;
/// intrinsics.json. Millimetres unless it says otherwise.
Sequence ReadPerFramePoses(const std::filesystem::path& folder, const FindingHandler& on_finding);

/// The same folders whatever their poses, which are the identity.
Sequence ReadPerFrameImages(const std::filesystem::path& folder, const FindingHandler& on_finding);

/// color/, depth/, trajectory.log, intrinsic.json as Open3D and Redwood write them. The i-th depth
/// image by name belongs to the pose whose first number is i; colour is matched by frame number.
Sequence ReadRedwood(const std::filesystem::path& folder, const FindingHandler& on_finding);

/// The same folders whatever their poses, which are the identity; trajectory.log may be missing.
Sequence ReadRedwoodImages(const std::filesystem::path& folder, const FindingHandler& on_finding);

/// frame-NNNNNN.{color.png,depth.png,pose.txt}; colour may be JPEG. Without an intrinsics.json the
/// cameras are those the data set was published with (f 585, centre 320, 240), which is reported as
/// a warning.
Sequence ReadSevenScenes(const std::filesystem::path& folder, const FindingHandler& on_finding);

/// The same images whatever their poses, which are the identity.
Sequence ReadSevenScenesImages(const std::filesystem::path& folder,
                               const FindingHandler& on_finding);

}  // namespace curvefusion
