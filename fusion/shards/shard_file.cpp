#include "fusion/shards/shard_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "capture/readers/binary_fields.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/shards/shard_fields.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/fnv_hash.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

// Chosen: of the format (docs/formats_shard.md), whose changes raise the version.
constexpr std::string_view kBegin = "CFSHARD\n";
constexpr std::string_view kEnd = "CFSHEND\n";
constexpr uint32_t kVersion = 2;
constexpr uint64_t kTrailerBytes = kEnd.size() + sizeof(uint64_t);  // kEnd and the checksum
constexpr uint64_t kPointBytes = 2 * sizeof(Vec3) + sizeof(float);

[[noreturn]] void Refuse(const fs::path& file, const std::string& why) {
  throw Error(ErrorKind::kBadInput, file.string() + ": " + why);
}

[[noreturn]] void RefuseDamaged(const fs::path& file, const std::string& what) {
  Refuse(file, fmt::format("is damaged ({}); copy it again, or make it again with --shard and "
                           "--force",
                           what));
}

// Writing

void PutHeader(const ShardHeader& header, ShardFields& fields) {
  fields.PutBytes(kBegin.data(), kBegin.size());
  fields.Put(kVersion);
  for (const std::string* text : {&header.identity.method, &header.identity.settings,
                                  &header.identity.scan, &header.prepared}) {
    fields.PutText(*text);
  }
  for (const int32_t number : {header.shard.number, header.shard.count, header.bundles.first,
                               header.bundles.last, header.first_frame, header.last_frame}) {
    fields.Put(number);
  }
}

void PutLearned(const LearnedScan& learned, ShardFields& fields) {
  for (const int64_t figure :
       {learned.volume.frames, learned.volume.blocks, learned.volume.bytes}) {
    fields.Put(figure);
  }
  const LearnedWires& wires = learned.wires;
  fields.Put(static_cast<int32_t>(wires.frame_stride));
  fields.Put(wires.array_spacing);
  fields.Put(wires.array_diameter);
  fields.Put(wires.colours.shift_px.x());
  fields.Put(wires.colours.shift_px.y());
  fields.Put(static_cast<uint64_t>(wires.colours.posterior.size()));
  fields.PutBytes(wires.colours.posterior.data(), wires.colours.posterior.size());
  fields.Put(wires.nets.spacing);
  fields.Put(wires.nets.noise);
  fields.Put(static_cast<uint64_t>(wires.nets.cells.size()));
  for (const VoxelKey& cell : wires.nets.cells)
    for (const int32_t number : {cell.x, cell.y, cell.z}) fields.Put(number);
}

void PutPoints(const ObservedPoints& points, ShardFields& fields) {
  fields.Put(static_cast<uint64_t>(points.size()));
  fields.PutBytes(points.positions.data(), points.size() * sizeof(Vec3));
  fields.PutBytes(points.viewing_rays.data(), points.size() * sizeof(Vec3));
  fields.PutBytes(points.counts.data(), points.size() * sizeof(float));
}

// Calls visit(count) for the counts of a funnel in the order of the file.
template <class Funnel, class Visit>
void ForEachCount(Funnel& funnel, const Visit& visit) {
  for (auto* count :
       {&funnel.frames, &funnel.depth_pixels, &funnel.thin_pixels, &funnel.gated_pixels,
        &funnel.merged_points, &funnel.too_few_frames, &funnel.small_clusters, &funnel.unverified,
        &funnel.isolated, &funnel.points}) {
    visit(*count);
  }
}

void PutBundle(const SegmentedBundle& bundle, ShardFields& fields) {
  fields.PutBytes(bundle.T_world_bundle.matrix().data(), 16 * sizeof(double));
  ForEachCount(bundle.funnel, [&](int64_t count) { fields.Put(count); });
  fields.Put(bundle.funnel.chroma);
  PutPoints(bundle.difference_set, fields);
  PutPoints(bundle.points, fields);
  fields.Put(static_cast<uint64_t>(bundle.frames.size()));
  for (const ObservedPoints& frame : bundle.frames) PutPoints(frame, fields);
}

// Reading

// Values of a file that has the right checksum but may have been made by anybody.
class ShardReader {
 public:
  explicit ShardReader(const fs::path& file) : file_(file), fields_(file) {}

  BinaryFields& fields() { return fields_; }

  void Require(bool is_good, const char* what) const {
    if (!is_good) RefuseDamaged(file_, fmt::format("{} before byte {}", what, fields_.position()));
  }

  // A length of what takes so many bytes each.
  uint64_t NextCount(uint64_t bytes_each) {
    const auto count = fields_.Next<uint64_t>();
    Require(count <= fields_.left() / bytes_each, "a length beyond the end of the file");
    return count;
  }

  std::string NextText() {
    std::string text(NextCount(1), '\0');
    fields_.Read(text.data(), text.size());
    return text;
  }

  int NextInt(int least, int greatest) {
    const auto value = fields_.Next<int32_t>();
    Require(value >= least && value <= greatest, "a number out of its range");
    return value;
  }

  double NextFinite() {
    const auto value = fields_.Next<double>();
    Require(std::isfinite(value), "a number that is not finite");
    return value;
  }

  ObservedPoints NextPoints() {
    ObservedPoints points;
    points.Resize(NextCount(kPointBytes));
    ReadFinite(points.positions);
    ReadFinite(points.viewing_rays);
    fields_.Read(points.counts.data(), points.size() * sizeof(float));
    return points;
  }

 private:
  void ReadFinite(std::vector<Vec3>& vectors) {
    fields_.Read(vectors.data(), vectors.size() * sizeof(Vec3));
    for (const Vec3& v : vectors) Require(v.allFinite(), "a number that is not finite");
  }

  const fs::path& file_;
  BinaryFields fields_;
};

constexpr int kMost = std::numeric_limits<int>::max();

void RequireFormat(const fs::path& file) {
  BinaryFields fields(file);
  std::string begin(kBegin.size(), '\0');
  if (fields.left() >= begin.size()) fields.Read(begin.data(), begin.size());
  if (begin != kBegin) {
    Refuse(file, "is no shard of a reconstruction; name what `reconstruct --shard` has written");
  }
  if (const auto version = fields.Next<uint32_t>(); version != kVersion) {
    Refuse(file, fmt::format("has version {} of the format of shards, this program reads {}; make "
                             "all shards and the result with one program",
                             version, kVersion));
  }
}

void RequireComplete(const fs::path& file) {
  constexpr size_t kBlock = 1 << 16;  // bytes read at once; chosen, changes no result
  BinaryFields fields(file);
  FnvHash checksum;
  std::vector<char> block(kBlock);
  while (fields.left() > kTrailerBytes) {
    const uint64_t bytes = std::min<uint64_t>(kBlock, fields.left() - kTrailerBytes);
    fields.Read(block.data(), bytes);
    checksum.Add({block.data(), bytes});
  }
  std::string end(kEnd.size(), '\0');
  if (fields.left() == kTrailerBytes) fields.Read(end.data(), end.size());
  if (end != kEnd) {
    RefuseDamaged(file,
                  fmt::format("it is truncated, at byte {}", fields.position() + fields.left()));
  }
  if (fields.Next<uint64_t>() != checksum.value()) {
    RefuseDamaged(file, "its bytes do not match their checksum");
  }
}

ShardHeader NextHeader(ShardReader& reader) {
  reader.fields().Skip(kBegin.size() + sizeof(kVersion));
  ShardHeader header;
  for (std::string* text : {&header.identity.method, &header.identity.settings,
                            &header.identity.scan, &header.prepared}) {
    *text = reader.NextText();
  }
  header.shard.number = reader.NextInt(1, kMost);
  header.shard.count = reader.NextInt(header.shard.number, kMost);
  header.bundles.first = reader.NextInt(0, kMost);
  header.bundles.last = reader.NextInt(header.bundles.first, kMost);
  header.first_frame = reader.NextInt(0, kMost);
  header.last_frame = reader.NextInt(header.first_frame, kMost);
  return header;
}

LearnedScan NextLearned(ShardReader& reader) {
  LearnedScan learned;
  for (int64_t* figure : {&learned.volume.frames, &learned.volume.blocks, &learned.volume.bytes}) {
    *figure = reader.fields().Next<int64_t>();
  }
  LearnedWires& wires = learned.wires;
  wires.frame_stride = reader.NextInt(1, kMost);
  wires.array_spacing = reader.NextFinite();
  wires.array_diameter = reader.NextFinite();
  wires.colours.shift_px.x() = reader.NextFinite();
  wires.colours.shift_px.y() = reader.NextFinite();
  std::vector<uint8_t>& posterior = wires.colours.posterior;
  posterior.resize(reader.NextCount(1));
  reader.fields().Read(posterior.data(), posterior.size());
  reader.Require(posterior.empty() || posterior.size() == WireColourModel().Posterior().size(),
                 "another number of colours");
  wires.nets.spacing = reader.NextFinite();
  wires.nets.noise = reader.NextFinite();
  wires.nets.cells.resize(reader.NextCount(3 * sizeof(int32_t)));
  for (VoxelKey& cell : wires.nets.cells)
    for (int* number : {&cell.x, &cell.y, &cell.z}) *number = reader.fields().Next<int32_t>();
  reader.Require(std::is_sorted(wires.nets.cells.begin(), wires.nets.cells.end()),
                 "cells of nets out of order");
  return learned;
}

SegmentedBundle NextBundle(ShardReader& reader) {
  SegmentedBundle bundle;
  for (int i = 0; i < 16; ++i) bundle.T_world_bundle.matrix()(i % 4, i / 4) = reader.NextFinite();
  ForEachCount(bundle.funnel, [&](int64_t& count) { count = reader.fields().Next<int64_t>(); });
  bundle.funnel.chroma = reader.NextFinite();
  bundle.difference_set = reader.NextPoints();
  bundle.points = reader.NextPoints();
  bundle.frames.resize(reader.NextCount(sizeof(uint64_t)));
  for (ObservedPoints& frame : bundle.frames) frame = reader.NextPoints();
  return bundle;
}

}  // namespace

std::string ShardText(ShardNumber shard) {
  return fmt::format("{} of {}", shard.number, shard.count);
}

std::string ShardName(ShardNumber shard) {
  return fmt::format("shard_{}_of_{}.cfshard", shard.number, shard.count);
}

void WriteShard(const fs::path& file, const ShardHeader& header, const BundleSource& source) {
  WriteStreamAtomically(file, [&](std::ostream& stream) {
    ShardFields fields(stream);
    // A full disk is told at once, not after hours.
    const auto require_written = [&] {
      if (fields.IsGood()) return;
      throw Error(ErrorKind::kResource, file.string() + ": cannot be written; is the disk full?");
    };
    PutHeader(header, fields);
    source({[&](const LearnedScan& learned) {
              PutLearned(learned, fields);
              require_written();
            },
            [&](const SegmentedBundle& bundle) {
              PutBundle(bundle, fields);
              require_written();
            }});
    const uint64_t checksum = fields.checksum();
    fields.PutBytes(kEnd.data(), kEnd.size());
    fields.Put(checksum);
  });
}

Shard OpenShard(const fs::path& file) {
  RequireFormat(file);
  RequireComplete(file);
  Shard shard{.file = file};
  ShardReader reader(shard.file);
  shard.header = NextHeader(reader);
  shard.learned = NextLearned(reader);
  shard.bundles_at = reader.fields().position();
  return shard;
}

void ReadBundles(const Shard& shard, const std::function<void(const SegmentedBundle&)>& on_bundle) {
  ShardReader reader(shard.file);
  reader.fields().Skip(shard.bundles_at);
  const ShardHeader& header = shard.header;
  int64_t frames = header.last_frame - header.first_frame;
  for (int i = header.bundles.first; i < header.bundles.last; ++i) {
    const SegmentedBundle bundle = NextBundle(reader);
    frames -= static_cast<int64_t>(bundle.frames.size());
    reader.Require(frames >= 0, "more frames than its header tells");
    on_bundle(bundle);
  }
  reader.Require(frames == 0 && reader.fields().left() == kTrailerBytes,
                 "other bundles than its header tells");
}

bool IsSame(const LearnedScan& a, const LearnedScan& b) {
  const auto bytes = [](const LearnedScan& learned) {
    std::ostringstream stream;
    ShardFields fields(stream);
    PutLearned(learned, fields);
    return stream.str();
  };
  return bytes(a) == bytes(b);
}

}  // namespace curvefusion
