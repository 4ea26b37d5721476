#include "capture/unpack_videos.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "capture/image_file.h"
#include "capture/link_file.h"
#include "capture/png.h"
#include "capture/readers/frame_assembly.h"
#include "kernel/atomic_file.h"
#include "kernel/child_program.h"
#include "kernel/error.h"
#include "kernel/file_extension.h"
#include "kernel/json_input.h"
#include "kernel/parallel.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr const char* kDepth = "depth";
constexpr const char* kConfidence = "confidence";
constexpr std::array<std::string_view, 4> kExtensions = {".mp4", ".mov", ".mkv", ".avi"};
constexpr std::array<std::string_view, 3> kLossless = {"ffv1", "png", "rawvideo"};

template <size_t kCount>
bool IsOneOf(const std::array<std::string_view, kCount>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool IsDepth(const fs::path& video) { return video.stem() == kDepth; }

// What ffprobe tells of the images of a video.
struct Stream {
  std::string codec;
  std::string pixels;
  std::string rate;  // images a second, as a fraction
  int images = 0;    // 0 where the file does not say
};

// Names any file: without the word, a colon would end the name of a protocol.
std::string Input(const fs::path& video) { return "file:" + fs::absolute(video).string(); }

ProgramResult Run(const std::string& program, const std::vector<std::string>& arguments,
                  const fs::path& folder, const std::function<void()>& meanwhile = {}) {
  ProgramResult result = RunProgram(program, arguments, folder, meanwhile);
  if (result.succeeded || !result.messages.empty()) return result;
  throw Error(ErrorKind::kResource,
              program + " unpacks videos and cannot be run; on Debian: apt-get install ffmpeg");
}

Stream Probe(const fs::path& video) {
  const ProgramResult probe =
      Run("ffprobe",
          {"-v", "error", "-protocol_whitelist", "file", "-select_streams", "v:0", "-show_entries",
           "stream=codec_name,pix_fmt,r_frame_rate,nb_frames", "-of", "json", Input(video)},
          ".");
  const nlohmann::json streams =
      probe.succeeded ? ParseJson(probe.output, video.string()).value("streams", nlohmann::json())
                      : nlohmann::json();
  if (!streams.is_array() || streams.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is no video that ffmpeg reads; copy it again{}{}", video.string(),
                            probe.messages.empty() ? "" : ": ", probe.messages));
  }
  const nlohmann::json& first = streams[0];
  const auto images = ParseInteger(first.value("nb_frames", "0"));
  return {first.value("codec_name", ""), first.value("pix_fmt", ""),
          first.value("r_frame_rate", ""), static_cast<int>(images.value_or(0))};
}

void RequireLossless(const fs::path& video, const Stream& stream) {
  if (stream.pixels.starts_with("gray16") && IsOneOf(kLossless, stream.codec)) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: holds {} by {}, which does not keep depth; it must have been stored "
                          "as 16-bit grey without loss (FFV1: ffmpeg ... -pix_fmt gray16le -c:v "
                          "ffv1 depth.mkv)",
                          video.string(), stream.pixels, stream.codec));
}

int CountFiles(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// Writes the images of a video into a folder of its name; returns their number.
int UnpackVideo(const fs::path& video, const Stream& stream, const fs::path& folder,
                const Progress& progress) {
  const std::string name = video.stem().string();
  fs::create_directory(folder / name);
  std::vector<std::string> line = {"-nostdin", "-v", "error", "-protocol_whitelist", "file"};
  line.insert(line.end(), {"-noautorotate", "-i", Input(video), "-map", "0:v:0", "-fps_mode",
                           "passthrough", "-start_number", "0"});
  if (IsDepth(video)) {
    line.insert(line.end(), {"-pix_fmt", "gray16be", name + "/%06d.png"});
  } else {
    line.insert(line.end(), {"-q:v", "2", name + "/%06d.jpg"});  // of 1 (finest) to 31
  }
  const std::string stage = "unpacking " + video.filename().string();
  const ProgramResult result = Run("ffmpeg", line, folder, [&] {
    const int done = CountFiles(folder / name);
    progress(stage, done, std::max(done, stream.images));
  });
  const int images = CountFiles(folder / name);
  if (result.succeeded && images > 0) return images;
  const bool is_full = result.messages.find("No space left") != std::string::npos;
  throw Error(is_full ? ErrorKind::kResource : ErrorKind::kBadInput,
              fmt::format("{}: cannot be unpacked beyond {} images: {}", video.string(), images,
                          result.messages));
}

// Pixels of a depth image.
struct TrustedPixels {
  int64_t measured = 0;
  int64_t left_out = 0;  // of those, for their confidence
};

// Copies depth without what has no confidence.
TrustedPixels WriteTrusted(const fs::path& depth_file, const fs::path& confidence_file,
                           const fs::path& copy) {
  Image<uint16_t> depth = DecodeDepthImage(depth_file);
  const ColorImage confidence = DecodeColorImage(confidence_file);
  if (confidence.width() != depth.width() || confidence.height() != depth.height()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has {}x{} pixels, {} has {}x{}; copy the scan again",
                            confidence_file.string(), confidence.width(), confidence.height(),
                            depth_file.string(), depth.width(), depth.height()));
  }
  TrustedPixels pixels;
  for (size_t i = 0; i < depth.size(); ++i) {
    if (depth.data()[i] == 0) continue;
    ++pixels.measured;
    if (confidence.data()[i][0] != 0) continue;
    depth.data()[i] = 0;
    ++pixels.left_out;
  }
  WriteBytesAtomically(copy, EncodePng(depth));
  return pixels;
}

// Returns the share of the measured depth that was left out.
double WriteTrustedDepth(const fs::path& scan, const fs::path& folder, const Progress& progress) {
  const NumberedImages depth = ImagesByFrameNumber(scan / kDepth);
  const NumberedImages confidence = ImagesByFrameNumber(scan / kConfidence);
  const std::vector<std::pair<long long, fs::path>> images(depth.begin(), depth.end());
  fs::create_directory(folder / kDepth);
  std::vector<TrustedPixels> pixels(images.size());
  const auto total = static_cast<int64_t>(images.size());
  progress("leaving out uncertain depth", 0, total);
  ParallelFor(0, total, 1, [&](int64_t i) {
    const auto& [number, file] = images[static_cast<size_t>(i)];
    const fs::path copy = folder / kDepth / file.filename();
    const auto found = confidence.find(number);
    if (found == confidence.end()) {
      LinkFile(file, copy);
    } else {
      pixels[static_cast<size_t>(i)] = WriteTrusted(file, found->second, copy);
    }
  });
  progress("leaving out uncertain depth", total, total);
  TrustedPixels sum;
  for (const TrustedPixels& of_image : pixels) {
    sum.measured += of_image.measured;
    sum.left_out += of_image.left_out;
  }
  return sum.measured > 0 ? static_cast<double>(sum.left_out) / static_cast<double>(sum.measured)
                          : 0;
}

void LinkTheRest(const fs::path& scan, const fs::path& folder,
                 const std::vector<fs::path>& videos) {
  for (const auto& entry : fs::directory_iterator(scan)) {
    const fs::path name = entry.path().filename();
    const bool is_video = std::find(videos.begin(), videos.end(), entry.path()) != videos.end();
    if (is_video || name == kConfidence || fs::exists(folder / name)) continue;
    LinkFile(entry.path(), folder / name);
  }
}

// Images are paired by their order.
void RequireSameRate(const std::vector<fs::path>& videos, const std::vector<Stream>& streams) {
  for (size_t i = 1; i < videos.size(); ++i) {
    if (streams[i].rate == streams[0].rate) continue;
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: has {} images a second, {} has {}; images are paired by their "
                    "order, so record both at the same rate",
                    videos[i].string(), streams[i].rate, videos[0].string(), streams[0].rate));
  }
}

}  // namespace

std::vector<fs::path> VideosOf(const fs::path& scan) {
  std::vector<fs::path> videos;
  for (const auto& entry : fs::directory_iterator(scan)) {
    const fs::path& path = entry.path();
    const bool is_video = IsOneOf(kExtensions, LowerCaseExtension(path)) &&
                          (IsDepth(path) || IsOneOf(kColorFolders, path.stem().string()));
    const fs::path images = IsDepth(path) ? scan / kDepth : ColorFolder(scan);
    if (is_video && !fs::is_directory(images)) videos.push_back(path);
  }
  std::sort(videos.begin(), videos.end());
  return videos;
}

std::string VideoRemedy(const fs::path& scan) {
  const std::vector<fs::path> videos = VideosOf(scan);
  if (videos.empty()) return {};
  return fmt::format(
      "{}: images are read one by one and several times, which a video does not allow; unpack it "
      "once: curvefusion unpack '{}' -o DIR",
      videos[0].string(), scan.string());
}

UnpackedVideos UnpackVideos(const fs::path& scan, const fs::path& folder,
                            const Progress& progress) {
  if (!fs::is_directory(scan)) {
    throw Error(ErrorKind::kBadInput, scan.string() + ": there is no such folder");
  }
  const std::vector<fs::path> videos = VideosOf(scan);
  const bool has_confidence =
      fs::is_directory(scan / kConfidence) && fs::is_directory(scan / kDepth);
  if (videos.empty() && !has_confidence) {
    throw Error(ErrorKind::kBadInput,
                scan.string() + ": holds nothing to unpack: no rgb.mp4, color.mkv or depth.mkv");
  }
  std::vector<Stream> streams;
  for (const fs::path& video : videos) {
    streams.push_back(Probe(video));
    if (IsDepth(video)) RequireLossless(video, streams.back());
  }
  RequireSameRate(videos, streams);
  UnpackedVideos unpacked;
  WriteFolderAtomically(folder, [&](const fs::path& temporary) {
    for (size_t i = 0; i < videos.size(); ++i) {
      unpacked.images[videos[i].stem().string()] =
          UnpackVideo(videos[i], streams[i], temporary, progress);
    }
    if (has_confidence) unpacked.untrusted_share = WriteTrustedDepth(scan, temporary, progress);
    LinkTheRest(scan, temporary, videos);
  });
  return unpacked;
}

}  // namespace curvefusion
