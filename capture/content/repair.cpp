#include "capture/content/repair.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "capture/camera_json.h"
#include "capture/image_file.h"
#include "capture/link_file.h"
#include "capture/png.h"
#include "capture/trajectory.h"
#include "kernel/atomic_file.h"
#include "kernel/json_input.h"
#include "kernel/parallel.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

void WriteDepth(const SequenceFrame& frame, bool swap_bytes, const fs::path& copy) {
  if (frame.depth_part.IsWholeFile() && !swap_bytes) return LinkFile(frame.depth_path, copy);
  Image<uint16_t> depth = DecodeDepthImage(frame.depth_path, frame.depth_part);
  for (size_t i = 0; swap_bytes && i < depth.size(); ++i) {
    const uint16_t value = depth.data()[i];
    depth.data()[i] = static_cast<uint16_t>((value << 8) | (value >> 8));
  }
  WriteBytesAtomically(copy, EncodePng(depth));
}

void WriteColor(const SequenceFrame& frame, const fs::path& copy) {
  if (frame.color_part.IsWholeFile()) return LinkFile(frame.color_path, copy);
  if (!IsRaw(frame.color_part.coding)) {
    return WriteBytesAtomically(copy, ReadImageBytes(frame.color_path, frame.color_part));
  }
  WriteBytesAtomically(copy, EncodePng(DecodeColorImage(frame.color_path, frame.color_part)));
}

// With its dot. Parts of recordings are written as they are coded.
std::string ColorExtension(const SequenceFrame& frame) {
  if (frame.color_part.IsWholeFile()) return frame.color_path.extension().string();
  const bool is_jpeg =
      !IsRaw(frame.color_part.coding) && IsJpeg(frame.color_path, frame.color_part);
  return is_jpeg ? ".jpg" : ".png";
}

ordered_json LensJson(const PinholeCamera& camera, const Distortion& d) {
  ordered_json lens = CameraJson(camera);
  if (d.IsZero()) return lens;
  lens["distortion"] = {d.k1, d.k2, d.p1, d.p2, d.k3};
  if (d.IsRational()) lens["distortion"].insert(lens["distortion"].end(), {d.k4, d.k5, d.k6});
  return lens;
}

// The keys of the sequence's own file, where it has one.
ordered_json GivenIntrinsics(const Sequence& sequence) {
  const fs::path path = sequence.folder / "intrinsics.json";
  if (!fs::exists(path)) {
    ordered_json cameras = LensJson(sequence.depth_camera, sequence.depth_distortion);
    cameras["color_camera"] = LensJson(sequence.color_camera, sequence.color_distortion);
    cameras["T_color_depth"] = RowsJson(sequence.T_color_depth);
    return cameras;
  }
  return ordered_json(ParseJson(ReadFile(path), path.string()));
}

// Where the parts of a layout lie.
struct Layout {
  bool is_tum = false;
  bool is_seven_scenes = false;
  bool has_depth = true;

  fs::path Color(const SequenceFrame& frame) const {
    const std::string extension = ColorExtension(frame);
    if (is_tum) return "rgb" / frame.color_path.filename();
    return is_seven_scenes ? frame.name + ".color" + extension : "color/" + frame.name + extension;
  }
  fs::path Depth(const SequenceFrame& frame) const {
    if (is_tum) return "depth" / frame.depth_path.filename();
    return is_seven_scenes ? frame.name + ".depth.png" : "depth/" + frame.name + ".png";
  }
  fs::path Pose(const SequenceFrame& frame) const {
    return is_seven_scenes ? frame.name + ".pose.txt" : "pose/" + frame.name + ".txt";
  }
};

// Formats whose names of images need not hold different numbers: by the number of the frame.
void NameByNumber(SequenceCorrection& correction) {
  for (SequenceFrame& frame : correction.sequence.frames) {
    frame.name = fmt::format("{:06}", std::llround(frame.timestamp));
  }
}

void WriteImages(const SequenceCorrection& correction, const Layout& layout,
                 const fs::path& folder) {
  for (const SequenceFrame& frame : correction.sequence.frames) {
    fs::create_directories((folder / layout.Color(frame)).parent_path());
    if (layout.has_depth) fs::create_directories((folder / layout.Depth(frame)).parent_path());
  }
  ParallelFor(0, static_cast<int64_t>(correction.sequence.frames.size()), 1, [&](int64_t i) {
    const SequenceFrame& frame = correction.sequence.frames[static_cast<size_t>(i)];
    WriteColor(frame, folder / layout.Color(frame));
    if (layout.has_depth) WriteDepth(frame, correction.swap_bytes, folder / layout.Depth(frame));
  });
}

void WriteTumLists(const SequenceCorrection& correction, const Layout& layout,
                   const fs::path& folder) {
  Trajectory trajectory;
  std::string images;
  for (const SequenceFrame& frame : correction.sequence.frames) {
    trajectory.push_back({frame.timestamp, frame.T_world_camera});
    images += frame.name + " " + layout.Color(frame).string();
    if (layout.has_depth) images += " " + frame.name + " " + layout.Depth(frame).string();
    images += "\n";
  }
  WriteBytesAtomically(folder / (layout.has_depth ? "associations.txt" : "rgb.txt"), images);
  if (correction.sequence.has_poses) WriteTumTrajectory(folder / "trajectory.txt", trajectory);
}

void WritePoseFiles(const SequenceCorrection& correction, const Layout& layout,
                    const fs::path& folder) {
  for (const SequenceFrame& frame : correction.sequence.frames) {
    const Eigen::Matrix4d pose = frame.T_world_camera.matrix();
    std::string text;
    for (int row = 0; row < 4; ++row) {
      text += fmt::format("{:.12g} {:.12g} {:.12g} {:.12g}\n", pose(row, 0), pose(row, 1),
                          pose(row, 2), pose(row, 3));
    }
    fs::create_directories((folder / layout.Pose(frame)).parent_path());
    WriteBytesAtomically(folder / layout.Pose(frame), text);
  }
}

}  // namespace

void WriteRepairedSequence(const SequenceCorrection& given, const fs::path& folder) {
  SequenceCorrection correction = given;
  const Sequence& sequence = correction.sequence;
  if (sequence.format == "nerfstudio" || sequence.format == "colmap") NameByNumber(correction);
  const Layout layout{sequence.format == "tum", sequence.format == "7-scenes", sequence.has_depth};
  ordered_json intrinsics = GivenIntrinsics(sequence);
  if (sequence.has_depth) intrinsics["depth_scale"] = sequence.depth_scale;
  WriteFolderAtomically(folder, [&](const fs::path& temporary) {
    WriteImages(correction, layout, temporary);
    if (layout.is_tum) {
      WriteTumLists(correction, layout, temporary);
    } else if (sequence.has_poses) {
      WritePoseFiles(correction, layout, temporary);
    }
    WriteBytesAtomically(temporary / "intrinsics.json", intrinsics.dump(1) + "\n");
  });
}

}  // namespace curvefusion
