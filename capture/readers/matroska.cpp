#include "capture/readers/matroska.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string_view>

#include "capture/readers/binary_fields.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

// Identifiers of elements, as RFC 9559 lists them.
enum Element : std::uint32_t {
  kEbml = 0x1A45DFA3,
  kSegment = 0x18538067,
  kInfo = 0x1549A966,
  kTimestampScale = 0x2AD7B1,
  kTracks = 0x1654AE6B,
  kTrackEntry = 0xAE,
  kTrackNumber = 0xD7,
  kName = 0x536E,
  kCodecId = 0x86,
  kCodecPrivate = 0x63A2,
  kVideo = 0xE0,
  kPixelWidth = 0xB0,
  kPixelHeight = 0xBA,
  kContentEncodings = 0x6D80,
  kAttachments = 0x1941A469,
  kAttachedFile = 0x61A7,
  kFileName = 0x466E,
  kFileData = 0x465C,
  kCluster = 0x1F43B675,
  kTimestamp = 0xE7,
  kSimpleBlock = 0xA3,
  kBlockGroup = 0xA0,
  kBlock = 0xA1,
};

constexpr double kNanosecond = 1e-9;
constexpr double kDefaultScale = 1e-3;  // seconds, of the format
constexpr std::uint64_t kUnknownSize = ~std::uint64_t{0};
constexpr std::uint64_t kMaxTextBytes = 16 << 20;  // chosen: a calibration has 10 kB
constexpr std::uint64_t kMaxSide = 65536;          // pixels, as in intrinsics.json
constexpr std::uint8_t kLacing = 0x06;             // flags of a block

[[noreturn]] void Fail(const std::string& message) { throw Error(ErrorKind::kBadInput, message); }

// Elements whose content is elements again. As no identifier has two meanings, they need not be
// closed: what follows the last inner element is the next of their neighbours.
bool HasElements(std::uint32_t id) {
  switch (id) {
    case kSegment:
    case kInfo:
    case kTracks:
    case kTrackEntry:
    case kVideo:
    case kAttachments:
    case kAttachedFile:
    case kCluster:
    case kBlockGroup:
      return true;
    default:
      return false;
  }
}

class Walk {
 public:
  Walk(const std::filesystem::path& path, MatroskaFile& file)
      : fields_(path), where_(path.string()), file_(file) {}

  // Throws where nothing more can be read.
  void Run() {
    if (NextId() != kEbml) Fail(where_ + ": is no Matroska file (.mkv)");
    fields_.Skip(NextSize());
    while (fields_.left() > 0) UseElement();
  }

 private:
  void UseElement() {
    const std::uint32_t id = NextId();
    const std::uint64_t size = NextSize();
    if (HasElements(id)) return Enter(id);
    if (size == kUnknownSize) Fail(Here("an element without a size"));
    switch (id) {
      case kTimestampScale:
        scale_ = kNanosecond * static_cast<double>(Unsigned(size));
        break;
      case kTimestamp:
        cluster_time_ = scale_ * static_cast<double>(Unsigned(size));
        break;
      case kSimpleBlock:
      case kBlock:
        return UseBlock(size);
      case kFileName:
        attachment_ = Text(size);
        break;
      case kFileData:
        file_.attachments[attachment_] = Text(size);
        break;
      default:
        return UseTrackElement(id, size);
    }
  }

  void Enter(std::uint32_t id) {
    if (id == kTrackEntry) file_.tracks.emplace_back();
    if (id == kAttachedFile) attachment_.clear();
  }

  void UseTrackElement(std::uint32_t id, std::uint64_t size) {
    if (file_.tracks.empty()) return fields_.Skip(size);
    MatroskaTrack& track = file_.tracks.back();
    switch (id) {
      case kTrackNumber:
        track.number = Unsigned(size);
        break;
      case kName:
        track.name = Text(size);
        break;
      case kCodecId:
        track.codec = Text(size);
        break;
      case kCodecPrivate:
        track.codec_private = Text(size);
        break;
      case kPixelWidth:
        track.width = Side(size);
        break;
      case kPixelHeight:
        track.height = Side(size);
        break;
      case kContentEncodings:
        track.is_encoded = true;
        [[fallthrough]];
      default:
        fields_.Skip(size);
    }
  }

  // Track number, time within the cluster, flags, and the frame.
  void UseBlock(std::uint64_t size) {
    const std::uint64_t end = fields_.position() + size;
    if (size > fields_.left()) fields_.Skip(size);  // throws
    const std::uint64_t number = NextSize();
    const auto high = fields_.Next<std::uint8_t>();
    const auto low = fields_.Next<std::uint8_t>();
    const auto time = static_cast<std::int16_t>(high << 8 | low);
    const auto flags = fields_.Next<std::uint8_t>();
    if (fields_.position() > end) Fail(Here("a block too short to be one"));
    if ((flags & kLacing) != 0) Fail(Here("several frames in one block, which is not read"));
    const auto track = std::find_if(file_.tracks.begin(), file_.tracks.end(),
                                    [&](const MatroskaTrack& t) { return t.number == number; });
    if (track != file_.tracks.end()) {
      track->frames.push_back(
          {cluster_time_ + scale_ * time, fields_.position(), end - fields_.position()});
    }
    fields_.Skip(end - fields_.position());
  }

  // The number of leading zero bits tells how many bytes follow the first.
  std::uint32_t NextId() {
    const auto first = fields_.Next<std::uint8_t>();
    const int more = std::countl_zero(first);
    if (more > 3) Fail(Here("what is no element"));
    std::uint32_t id = first;
    for (int i = 0; i < more; ++i) id = id << 8 | fields_.Next<std::uint8_t>();
    return id;
  }

  std::uint64_t NextSize() {
    const auto first = fields_.Next<std::uint8_t>();
    const int more = std::countl_zero(first);
    if (more > 7) Fail(Here("a size that is none"));
    std::uint64_t size = first & (0x7Fu >> more);
    for (int i = 0; i < more; ++i) size = size << 8 | fields_.Next<std::uint8_t>();
    const bool is_unknown = size == (std::uint64_t{1} << (7 * (more + 1))) - 1;
    return is_unknown ? kUnknownSize : size;
  }

  std::uint64_t Unsigned(std::uint64_t size) {
    if (size > 8) Fail(Here("a number of more than 8 bytes"));
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < size; ++i) value = value << 8 | fields_.Next<std::uint8_t>();
    return value;
  }

  int Side(std::uint64_t size) {
    const std::uint64_t pixels = Unsigned(size);
    if (pixels >= 1 && pixels <= kMaxSide) return static_cast<int>(pixels);
    Fail(Here(fmt::format("an image side of {} pixels", pixels)));
  }

  std::string Text(std::uint64_t size) {
    if (size > kMaxTextBytes) Fail(Here(fmt::format("a text of {} bytes", size)));
    if (size > fields_.left()) fields_.Skip(size);  // throws before memory is taken
    std::string text(size, '\0');
    fields_.Read(text.data(), size);
    return text;
  }

  std::string Here(const std::string& what) const {
    return fmt::format("{}: at byte {} is {}; copy or record it again", where_, fields_.position(),
                       what);
  }

  BinaryFields fields_;
  std::string where_;
  MatroskaFile& file_;
  double scale_ = kDefaultScale;
  double cluster_time_ = 0;
  std::string attachment_;  // the name of the file that is read
};

}  // namespace

MatroskaFile ReadMatroska(const std::filesystem::path& file) {
  MatroskaFile read;
  try {
    Walk(file, read).Run();
  } catch (const Error& error) {
    if (read.tracks.empty()) throw;
    read.defect = error.what();
  }
  return read;
}

}  // namespace curvefusion
