#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace curvefusion {

/// A frame of a track: bytes of the file.
struct MatroskaFrame {
  double time = 0;  ///< seconds from the beginning
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

struct MatroskaTrack {
  std::uint64_t number = 0;
  std::string name;           ///< "DEPTH"
  std::string codec;          ///< "V_MS/VFW/FOURCC"
  std::string codec_private;  ///< what the codec needs to know
  int width = 0;              ///< pixels; 0 where it is no video
  int height = 0;
  bool is_encoded = false;  ///< compressed or encrypted by the container
  std::vector<MatroskaFrame> frames;
};

/// What is read of a Matroska file (.mkv).
struct MatroskaFile {
  std::vector<MatroskaTrack> tracks;
  std::map<std::string, std::string> attachments;  ///< contents by name
  std::string defect;  ///< why the file was not read to its end; empty where it was
};

/// Reads tracks, attachments and the places of all frames, not the frames. A file that is cut off
/// or damaged has what comes before that place, and the defect. Throws Error(kBadInput) for what is
/// no Matroska file. Source: RFC 9559 (Matroska) and RFC 8794 (EBML).
MatroskaFile ReadMatroska(const std::filesystem::path& file);

}  // namespace curvefusion
