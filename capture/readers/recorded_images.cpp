#include "capture/readers/recorded_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "capture/stamps.h"
#include "capture/trajectory.h"

namespace curvefusion {

namespace {

using Time = double RecordedImage::*;

constexpr double kPairedShare = 0.5;  // chosen: lost images are a few percent

std::vector<std::pair<size_t, size_t>> Pairs(const RecordedStream& depth,
                                             const RecordedStream& color, Time time) {
  const auto times = [&](const RecordedStream& stream) {
    std::vector<double> values;
    for (const RecordedImage& image : stream.images) values.push_back(image.*time);
    return values;
  };
  return AssociateStamps(times(depth), times(color), kAssociationTolerance);
}

// The clock by which the images are paired.
Time ClockOf(const RecordedStream& depth, const RecordedStream& color) {
  const size_t fewest = std::min(depth.images.size(), color.images.size());
  const size_t paired = Pairs(depth, color, &RecordedImage::stamp).size();
  const bool is_common = static_cast<double>(paired) >= kPairedShare * static_cast<double>(fewest);
  return is_common ? &RecordedImage::stamp : &RecordedImage::recorded;
}

}  // namespace

void AddRecordedFrames(const std::filesystem::path& file, RecordedStream depth,
                       RecordedStream color, const FindingHandler& on_finding, Sequence& sequence) {
  for (RecordedStream* stream : {&depth, &color}) {
    SortByStamp(
        fmt::format("{}: {}", file.string(), stream->name),
        [](const RecordedImage& image) { return image.stamp; }, on_finding, stream->images);
  }
  const Time time = ClockOf(depth, color);
  const auto pairs = Pairs(depth, color, time);
  for (const auto& [d, c] : pairs) {
    SequenceFrame frame;
    frame.name = fmt::format("{:06}", d);
    frame.timestamp = depth.images[d].stamp;
    frame.T_world_camera = RigidTransform::Identity();
    frame.color_path = frame.depth_path = file;
    frame.color_delay = color.images[c].*time - depth.images[d].*time;
    frame.color_part = color.images[c].part;
    frame.depth_part = depth.images[d].part;
    sequence.frames.push_back(std::move(frame));
  }
  sequence.frames_without_partner +=
      static_cast<int>(depth.images.size() + color.images.size() - 2 * pairs.size());
}

}  // namespace curvefusion
