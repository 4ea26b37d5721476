#pragma once

#include <filesystem>

#include "capture/finding.h"
#include "capture/sequence.h"

namespace curvefusion {

/// The readers of the layouts (docs/formats_input.md). Each reads everything but the images and
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

/// Whether the folder is of ICL-NUIM, TUM-compatible: associations.txt, and the poses in a file
/// *.gt.freiburg instead of trajectory.txt or groundtruth.txt.
bool LooksLikeIclNuim(const std::filesystem::path& folder);

/// The same lists with numbers of frames for stamps and poses of a left-handed world. Without an
/// intrinsics.json the camera is that of the data set.
Sequence ReadIclNuim(const std::filesystem::path& folder, const FindingHandler& on_finding);
Sequence ReadIclNuimImages(const std::filesystem::path& folder, const FindingHandler& on_finding);

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

/// Whether the folder holds the transforms.json of nerfstudio and instant-ngp.
bool HasTransforms(const std::filesystem::path& folder);

/// transforms.json with colour, depth and pose of every frame: OpenGL camera axes, one camera for
/// all frames, depth in 1 mm or depth_unit_scale_factor metres. Frames are put in the order of
/// their colour files' names. Without poses they are the identity.
Sequence ReadNerfstudio(const std::filesystem::path& folder, const FindingHandler& on_finding);
Sequence ReadNerfstudioImages(const std::filesystem::path& folder,
                              const FindingHandler& on_finding);

/// Whether the folder, its sparse/0 or its sparse holds cameras and images of a COLMAP model.
bool HasColmapModel(const std::filesystem::path& folder);

/// A COLMAP model as text or binary, colour images in images/ (or color/, rgb/ ...) and 16-bit
/// depth of the same names in depth/, millimetres. Warns that the model's scale need not be metres.
Sequence ReadColmap(const std::filesystem::path& folder, const FindingHandler& on_finding);
Sequence ReadColmapImages(const std::filesystem::path& folder, const FindingHandler& on_finding);

/// Whether the folder is a recording of the app Stray Scanner: odometry.csv, camera_matrix.csv.
bool LooksLikeStrayScanner(const std::filesystem::path& folder);

/// depth/ in millimetres, poses of odometry.csv, the camera of camera_matrix.csv, and the images of
/// rgb.mp4 unpacked into rgb/ (or color/, ...).
Sequence ReadStrayScanner(const std::filesystem::path& folder, const FindingHandler& on_finding);
Sequence ReadStrayScannerImages(const std::filesystem::path& folder,
                                const FindingHandler& on_finding);

/// Whether a file is named like a recording of BundleFusion or ScanNet (.sens).
bool IsSens(const std::filesystem::path& file);

/// Whether any frame of it has a pose other than the identity. Throws Error(kBadInput) for what is
/// none.
bool HasSensPoses(const std::filesystem::path& file);

/// A .sens file of version 4. Its images are parts of the file; depth compressed by Occipital's
/// codec is refused. Poses are those of the depth camera; where both matrices of extrinsics are not
/// the identity, T_color_depth leads over the base frame of the recording. Reads the frames' heads,
/// not the images: a seek a frame.
Sequence ReadSens(const std::filesystem::path& file, const FindingHandler& on_finding);
Sequence ReadSensImages(const std::filesystem::path& file, const FindingHandler& on_finding);

/// Whether a file is named like a ROS bag (.bag), as RealSense cameras are recorded.
bool IsBag(const std::filesystem::path& file);

/// Never: RealSense cameras record none.
bool HasBagPoses(const std::filesystem::path& file);

/// A ROS bag of RealSense's SDK: the first depth and the first colour camera, paired by their
/// stamps within 20 ms, or, where these are of two clocks, by the times of the recorder.
/// Intrinsics, lens, extrinsics and depth unit are the recorded ones; where extrinsics or unit are
/// missing, a warning says what is assumed. Reads all messages but the pixels of images that are
/// not packed.
Sequence ReadRealSenseImages(const std::filesystem::path& file, const FindingHandler& on_finding);

/// Throws Error(kBadInput): there are no poses.
Sequence ReadRealSense(const std::filesystem::path& file, const FindingHandler& on_finding);

/// Whether a file is named like a Matroska video (.mkv), as Azure Kinect records.
bool IsMkv(const std::filesystem::path& file);

/// Never: Azure Kinect records none.
bool HasMkvPoses(const std::filesystem::path& file);

/// A recording of Azure Kinect's recorder: the tracks DEPTH (b16g) and COLOR (MJPG or BGRA),
/// cameras and lenses of the attached calibration.json, cut to the modes that the sizes of the
/// images tell.
Sequence ReadAzureKinectImages(const std::filesystem::path& file, const FindingHandler& on_finding);

/// Throws Error(kBadInput): there are no poses.
Sequence ReadAzureKinect(const std::filesystem::path& file, const FindingHandler& on_finding);

}  // namespace curvefusion
