#include "capture/readers/bag_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
// Chosen: headers are some hundred bytes, but a connection's holds the text of a message
// definition.
constexpr std::uint32_t kMaxHeaderBytes = 1 << 20;
// Chosen: a chunk is closed once it has 768 kB, so it is one image larger at most.
constexpr std::uint32_t kMaxChunkBytes = 256u << 20;

// The values of the format.
enum RecordKind : std::uint8_t {
  kMessage = 0x02,
  kChunk = 0x05,
  kConnection = 0x07,
};

struct Record {
  std::map<std::string, std::string, std::less<>> fields;
  std::uint64_t data = 0;  // offset
  std::uint32_t data_bytes = 0;
};

template <class T>
T ValueAt(std::string_view bytes) {
  T value{};
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

// Reads the records of a file or of an unpacked chunk.
class Records {
 public:
  Records(std::istream& stream, std::uint64_t begin, std::uint64_t end, std::string where)
      : stream_(stream), position_(begin), end_(end), where_(std::move(where)) {}

  std::optional<Record> Next() {
    if (position_ == end_) return std::nullopt;
    start_ = position_;
    Record record;
    const auto header_bytes = NextSize();
    if (header_bytes > kMaxHeaderBytes) Fail("has a header too long to be one");
    record.fields = ParseFields(NextBytes(header_bytes));
    record.data_bytes = NextSize();
    record.data = position_;
    RequireLeft(record.data_bytes);
    position_ += record.data_bytes;
    return record;
  }

  template <class T>
  T Field(const Record& record, std::string_view name) const {
    const auto field = record.fields.find(name);
    if (field == record.fields.end() || field->second.size() != sizeof(T)) {
      Fail(fmt::format("has no field '{}' of {} bytes", name, sizeof(T)));
    }
    return ValueAt<T>(field->second);
  }

  std::string Text(const Record& record, std::string_view name) const {
    const auto field = record.fields.find(name);
    if (field == record.fields.end()) Fail(fmt::format("has no field '{}'", name));
    return field->second;
  }

  std::string Bytes(std::uint64_t offset, std::uint64_t count) const {
    std::string bytes(count, '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(bytes.data(), static_cast<std::streamsize>(count));
    if (!stream_) Fail("cannot be read");
    return bytes;
  }

  [[noreturn]] void Fail(const std::string& what) const {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: the record at byte {} {}; copy or record the bag again", where_,
                            start_, what));
  }

 private:
  void RequireLeft(std::uint64_t count) const {
    if (count > end_ - position_) Fail("is cut off");
  }

  std::string NextBytes(std::uint64_t count) {
    RequireLeft(count);
    std::string bytes = Bytes(position_, count);
    position_ += count;
    return bytes;
  }

  std::uint32_t NextSize() { return ValueAt<std::uint32_t>(NextBytes(4)); }

  // "name=value" each, after its length.
  std::map<std::string, std::string, std::less<>> ParseFields(std::string_view header) const {
    std::map<std::string, std::string, std::less<>> fields;
    while (!header.empty()) {
      if (header.size() < 4) Fail("has a damaged header");
      const auto length = ValueAt<std::uint32_t>(header);
      header.remove_prefix(4);
      if (length > header.size()) Fail("has a damaged header");
      const std::string_view field = header.substr(0, length);
      const size_t equal = field.find('=');
      if (equal == std::string_view::npos) Fail("has a damaged header");
      fields.emplace(field.substr(0, equal), field.substr(equal + 1));
      header.remove_prefix(length);
    }
    return fields;
  }

  std::istream& stream_;
  std::uint64_t position_;
  std::uint64_t end_;
  std::uint64_t start_ = 0;  // of the record that is read
  std::string where_;
};

using Topics = std::map<std::uint32_t, std::string>;

void UseRecord(const Records& records, const Record& record, std::istream& stream,
               const PackedChunk& chunk, Topics& topics, const UseBagMessage& use) {
  const auto kind = records.Field<std::uint8_t>(record, "op");
  if (kind == kConnection) {
    topics[records.Field<std::uint32_t>(record, "conn")] = records.Text(record, "topic");
  } else if (kind == kMessage) {
    const auto topic = topics.find(records.Field<std::uint32_t>(record, "conn"));
    if (topic == topics.end()) records.Fail("is a message of a connection that is not there");
    const std::string time = records.Text(record, "time");
    if (time.size() != 8) records.Fail("has no time");
    const double seconds = ValueAt<std::uint32_t>(time) +
                           1e-9 * ValueAt<std::uint32_t>(std::string_view(time).substr(4));
    use(topic->second, seconds, {stream, chunk, record.data, record.data_bytes});
  }
}

PackedChunk ChunkOf(const Records& records, const Record& record) {
  PackedChunk chunk = {Packing::kNone, record.data, record.data_bytes,
                       records.Field<std::uint32_t>(record, "size")};
  const std::string compression = records.Text(record, "compression");
  if (compression == "lz4") {
    chunk.packing = Packing::kLz4;
  } else if (compression == "bz2") {
    chunk.packing = Packing::kBzip2;
  } else if (compression != "none") {
    records.Fail(fmt::format("is compressed by '{}'; none, lz4 and bz2 are read", compression));
  }
  if (chunk.unpacked_bytes > kMaxChunkBytes || chunk.bytes > kMaxChunkBytes) {
    records.Fail(fmt::format("is a chunk of more than {} MiB", kMaxChunkBytes >> 20));
  }
  return chunk;
}

void UseChunk(const Records& file, const Record& record, std::istream& stream,
              const std::string& where, Topics& topics, const UseBagMessage& use) {
  const PackedChunk chunk = ChunkOf(file, record);
  const auto use_all = [&](Records records, std::istream& source) {
    while (const auto inner = records.Next()) {
      UseRecord(records, *inner, source, chunk, topics, use);
    }
  };
  if (chunk.packing == Packing::kNone) {
    return use_all({stream, chunk.offset, chunk.offset + chunk.bytes, where}, stream);
  }
  std::string unpacked;
  const std::string defect = Unpack(chunk, file.Bytes(chunk.offset, chunk.bytes), unpacked);
  if (!defect.empty()) file.Fail("is damaged: " + defect);
  const std::uint64_t size = unpacked.size();
  std::istringstream source(std::move(unpacked));
  use_all({source, 0, size, fmt::format("{}: the chunk at byte {}", where, chunk.offset)}, source);
}

}  // namespace

std::string BagMessage::Read(std::uint64_t first, std::uint64_t count) const {
  std::string bytes(std::min(count, bytes_ - std::min<std::uint64_t>(first, bytes_)), '\0');
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(offset_ + first));
  stream_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(stream_.gcount()));
  return bytes;
}

void ReadBag(const fs::path& file, const UseBagMessage& use) {
  std::ifstream stream = OpenFile(file);
  std::string magic(kMagic.size(), '\0');
  stream.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (!stream || magic != kMagic) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is no ROS bag of format 2.0; a bag of ROS 2 is converted by "
                            "`rosbags-convert`, older ones by `rosbag migrate`",
                            file.string()));
  }
  Records records(stream, kMagic.size(), fs::file_size(file), file.string());
  Topics topics;
  while (const auto record = records.Next()) {
    if (records.Field<std::uint8_t>(*record, "op") == kChunk) {
      UseChunk(records, *record, stream, file.string(), topics, use);
    } else {
      UseRecord(records, *record, stream, {}, topics, use);
    }
  }
}

}  // namespace curvefusion
