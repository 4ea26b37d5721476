#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "capture/intrinsics.h"
#include "capture/sequence.h"

namespace curvefusion {

/// Image files by frame number, so in the order of the frames.
using NumberedImages = std::map<long long, std::filesystem::path>;

/// The PNG and JPEG files of a folder by frame number: the first run of digits in the name
/// ("000012.png", "0000001-000000033000.jpg", "frame-000007"). Throws Error(kBadInput) where the
/// folder is missing or holds images of other formats only, or two files have the same number.
/// `kind` limits it to names that have it before their extension (".depth").
NumberedImages ImagesByFrameNumber(const std::filesystem::path& folder,
                                   const std::string& kind = "");

/// What the folder of colour images beside depth/ may be called.
inline constexpr std::array<std::string_view, 5> kColorFolders = {"color", "colour", "rgb", "image",
                                                                  "images"};

/// The first of kColorFolders that is there; color where none is.
std::filesystem::path ColorFolder(const std::filesystem::path& folder);

/// Sets cameras and depth scale of a sequence; the scale is `default_depth_scale` where the
/// intrinsics do not say.
void UseIntrinsics(const Intrinsics& intrinsics, double default_depth_scale, Sequence& sequence);

/// Finds the pose of the `rank`-th depth image (counted from 0), or nothing. Where there is no
/// depth, of the colour image.
using PoseLookup =
    std::function<std::optional<RigidTransform>(int rank, const std::filesystem::path& image)>;

/// For sequences whose poses are not asked for: the identity for all.
std::optional<RigidTransform> NoPose(int rank, const std::filesystem::path& image);

/// The images of depth/ in a folder; none where it is not there.
NumberedImages DepthByFrameNumber(const std::filesystem::path& folder);

/// Appends a frame for every depth image that has a colour image of the same number and a pose;
/// counts the others as dropped. Frames are named after the depth image up to its first dot. Where
/// there is no depth at all, Sequence::has_depth is false from then on, and every colour image with
/// a pose is a frame.
void AddFrames(NumberedImages color, const NumberedImages& depth, const PoseLookup& find_pose,
               Sequence& sequence);

/// The camera of depth images that are registered to the images of `color` but may be smaller, as
/// the depth of phones is: the same view in the size of the image file. The camera itself where the
/// file cannot be read, which the survey of images reports. Throws Error(kBadInput) where the sides
/// have another proportion.
PinholeCamera RegisteredDepthCamera(const PinholeCamera& color,
                                    const std::filesystem::path& depth_image);

/// Puts frames in the order of the paths of their colour images, as text but numbers by value ("2"
/// before "10"), and numbers them from 0: formats that have neither times nor an order.
void NumberByColorPath(Sequence& sequence);

/// `name` up to its first dot: "frame-000007" of "frame-000007.depth.png".
std::string FrameName(const std::filesystem::path& image);

}  // namespace curvefusion
