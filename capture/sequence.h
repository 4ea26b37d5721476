#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "capture/color_levels.h"
#include "capture/distortion.h"
#include "capture/image_part.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

class DecodedImages;

/// One frame of a sequence: where its images lie and where the depth camera was. An image is a
/// file, or the part of a recording.
struct SequenceFrame {
  std::string name;               ///< what messages call it, e.g. "000012" or "1000.033333"
  double timestamp = 0;           ///< seconds, or the frame number where the format has no times
  RigidTransform T_world_camera;  ///< pose of the depth camera
  std::filesystem::path color_path;
  std::filesystem::path depth_path;
  double color_delay = 0;  ///< seconds from the depth image to the colour image
  ImagePart color_part;    ///< of color_path: what of it is the image
  ImagePart depth_part;
};

/// An RGB-D sequence whose images are decoded when asked for; it may have colour images and poses
/// only. Open it with OpenSequence.
struct Sequence {
  std::string format;            ///< its name in docs/formats_input.md, such as "tum"
  std::filesystem::path folder;  ///< or the file of a recording
  PinholeCamera depth_camera;
  PinholeCamera color_camera;
  Distortion depth_distortion;  ///< of the images as stored: LoadDepth and LoadColor undo it
  Distortion color_distortion;
  ColorLevels color_levels;  ///< by which LoadColor stretches the images as stored
  RigidTransform T_color_depth = RigidTransform::Identity();
  double depth_scale = 5000;          ///< depth units per metre
  int invalid_depth = 0;              ///< raw value that means "no measurement", besides 0
  std::vector<SequenceFrame> frames;  ///< ordered, all with both images
  bool has_depth = true;              ///< otherwise frames have colour only, and no depth is read
  bool has_poses = true;              ///< otherwise T_world_camera of the frames is meaningless
  int frames_without_pose = 0;        ///< dropped when opening
  int frames_without_partner = 0;     ///< colour or depth images without the other, dropped
  std::vector<std::string> warnings;  ///< what the user should know, a sentence each
  std::shared_ptr<DecodedImages> decoded;  ///< where images stay once they are decoded; may be null

  int frame_count() const { return static_cast<int>(frames.size()); }
  /// From the world to the colour camera of a frame.
  RigidTransform T_color_world(int frame) const {
    return T_color_depth * frames[frame].T_world_camera.inverse();
  }
  /// Whether the images are parts of a file.
  bool IsRecording() const { return !frames.empty() && !frames[0].color_part.IsWholeFile(); }
};

/// What becomes of the poses of a sequence.
enum class PoseUse {
  kNeeded,   ///< a sequence without any is bad input; frames without one are dropped
  kIfGiven,  ///< the same, but where there are none at all the sequence is opened without
  kIgnored,  ///< every frame with both images is there, Sequence::has_poses is false
};

/// What becomes of the depth images of a sequence.
enum class DepthUse {
  kNeeded,   ///< a sequence without any is bad input
  kIfGiven,  ///< the same, but where there are none at all the sequence is opened without
  kIgnored,  ///< none is opened, Sequence::has_depth is false
};

/// The sequence, whose images are decoded once only from now on, as far as memory allows.
Sequence KeepingImages(Sequence sequence);

/// The sequence as if it had colour images and poses only.
Sequence WithoutDepth(Sequence sequence);

/// Detects the format of a folder or a recording in one file (docs/formats_input.md) and reads
/// everything but the images, of which it looks at the headers, at the depths of three frames and
/// at the colours of twelve. Throws Error(kBadInput) naming file, line or frame, value and remedy
/// at the first defect that would spoil a reconstruction; capture/check.h finds all of them. Well
/// under a second.
Sequence OpenSequence(const std::filesystem::path& folder, PoseUse poses = PoseUse::kNeeded,
                      DepthUse depth = DepthUse::kNeeded);

/// The poses of the cameras of all frames.
std::vector<RigidTransform> CameraPoses(const Sequence& sequence);

/// How far, in metres, the camera moves at most from frame to frame in this share of the steps;
/// infinity where there is only one frame.
double StepBetweenFrames(const Sequence& sequence, double share);

/// Whether the sequence is a video: three quarters of its steps are as small as those of a handheld
/// camera. Otherwise its frames are separate views.
bool IsVideo(const Sequence& sequence);

/// Decodes one depth image to metres and undoes the lens distortion; one without any measurement
/// where the sequence has no depth. Thread-safe. Throws Error(kBadInput) for a missing, truncated,
/// 8-bit or wrongly sized image.
DepthImage LoadDepth(const Sequence& sequence, int frame);

/// Decodes one colour image, undoes the lens distortion and stretches its levels. Thread-safe.
/// Throws like LoadDepth.
ColorImage LoadColor(const Sequence& sequence, int frame);

/// The same with its levels as they are stored.
ColorImage LoadColorAsStored(const Sequence& sequence, int frame);

}  // namespace curvefusion
