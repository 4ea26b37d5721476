#include "fusion/shards/shard_file.h"

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "fusion/shards/shard_fields.h"
#include "kernel/fnv_hash.h"
#include "tests/fusion/shards/shard_fixture.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ShardFile : public ShardFixture {
 protected:
  static std::string Bytes(const fs::path& file) {
    std::stringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  static void WriteBytes(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
  }

  // Everything that can be read of a shard.
  static void ReadAll(const fs::path& file) {
    ReadBundles(OpenShard(file), [](const SegmentedBundle&) {});
  }

  // The file with a checksum that fits: as somebody would make it who wants to be believed.
  static void Sign(std::string& bytes) {
    FnvHash checksum;
    checksum.Add(std::string_view(bytes).substr(0, bytes.size() - 16));
    const uint64_t value = checksum.value();
    std::memcpy(bytes.data() + bytes.size() - 8, &value, 8);
  }
};

void ExpectSameBits(const ObservedPoints& a, const ObservedPoints& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.positions.data(), b.positions.data(), a.size() * sizeof(Vec3)), 0);
  EXPECT_EQ(std::memcmp(a.viewing_rays.data(), b.viewing_rays.data(), a.size() * sizeof(Vec3)), 0);
  EXPECT_EQ(std::memcmp(a.counts.data(), b.counts.data(), a.size() * sizeof(float)), 0);
}

TEST_F(ShardFile, HoldsAllBitsOfWhatWasFound) {
  const Shard shard = OpenShard(Write({2, 2}));
  EXPECT_TRUE(IsSame(shard.learned, learned_));
  EXPECT_TRUE(std::signbit(shard.learned.wires.colours.shift_px.x()));
  EXPECT_EQ(shard.learned.wires.array_diameter, 1e-310);
  EXPECT_EQ(shard.header.identity.settings, identity_.settings);
  EXPECT_EQ(shard.header.prepared, prepared_);
  EXPECT_EQ(ShardText(shard.header.shard), "2 of 2");
  EXPECT_EQ(shard.header.first_frame, 60);
  EXPECT_EQ(shard.header.last_frame, 100);
  int i = shard.header.bundles.first;
  ReadBundles(shard, [&](const SegmentedBundle& bundle) {
    const SegmentedBundle expected =
        SomeBundle(static_cast<int>(bundle.frames.size()), static_cast<uint32_t>(i++));
    EXPECT_EQ(bundle.T_world_bundle.matrix(), expected.T_world_bundle.matrix());
    ExpectSameBits(bundle.difference_set, expected.difference_set);
    ExpectSameBits(bundle.points, expected.points);
    for (size_t f = 0; f < bundle.frames.size(); ++f) {
      ExpectSameBits(bundle.frames[f], expected.frames[f]);
    }
    EXPECT_EQ(bundle.funnel.frames, 1);
    EXPECT_EQ(bundle.funnel.isolated, 9);
    EXPECT_EQ(bundle.funnel.points, 10);
    EXPECT_EQ(bundle.funnel.chroma, 0.1);
  });
  EXPECT_EQ(i, 3);
}

TEST_F(ShardFile, IsTheSameForTheSameInput) {
  EXPECT_EQ(Bytes(Write({1, 3}, "a.cfshard")), Bytes(Write({1, 3}, "b.cfshard")));
}

TEST_F(ShardFile, TruncatedAnywhereIsRefused) {
  const fs::path file = Write({2, 3});
  const std::string bytes = Bytes(file);
  const size_t step = std::max<size_t>(1, bytes.size() / 500);
  for (size_t length = 0; length < bytes.size();
       length += length < 100 || length + 100 > bytes.size() ? 1 : step) {
    WriteBytes(file, bytes.substr(0, length));
    EXPECT_THAT(Refusal([&] { OpenShard(file); }), HasSubstr(file.string())) << length;
  }
  WriteBytes(file, bytes.substr(0, bytes.size() - 1));
  EXPECT_THAT(Refusal([&] { OpenShard(file); }), HasSubstr("truncated"));
  WriteBytes(file, bytes + "x");
  EXPECT_NE(Refusal([&] { OpenShard(file); }), "");
}

TEST_F(ShardFile, EveryFlippedBitIsFound) {
  const fs::path file = Write({1, 3});
  const std::string bytes = Bytes(file);
  std::mt19937 random(1);
  for (size_t at = 0; at < bytes.size(); at += at < 100 ? 1 : 1 + random() % 60) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (random() % 8)));
    WriteBytes(file, flipped);
    EXPECT_NE(Refusal([&] { OpenShard(file); }), "") << at;
  }
}

TEST_F(ShardFile, AnotherVersionAndOtherFilesAreNamed) {
  const fs::path file = Write({1, 3});
  std::string bytes = Bytes(file);
  bytes[8] = 1;
  Sign(bytes);
  WriteBytes(file, bytes);
  EXPECT_THAT(Refusal([&] { OpenShard(file); }), HasSubstr("version 1"));
  WriteBytes(file, "{}");
  EXPECT_THAT(Refusal([&] { OpenShard(file); }), HasSubstr("is no shard"));
  EXPECT_THAT(Refusal([&] { OpenShard(folder_ / "none"); }), HasSubstr("is not there"));
}

// No length, count or number of a forged file leads beyond its end or into the memory of others.
TEST_F(ShardFile, AForgedFileWithARightChecksumIsReadWithinItsBounds) {
  const fs::path file = Write({1, 3});
  const std::string bytes = Bytes(file);
  int refused = 0;
  for (size_t at = 8; at + 24 < bytes.size(); at += at < 400 ? 1 : 41) {
    std::string forged = bytes;
    for (size_t i = 0; i < 8; ++i) forged[at + i] = '\x7f';
    Sign(forged);
    WriteBytes(file, forged);
    refused += Refusal([&] { ReadAll(file); }).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 50);
}

TEST_F(ShardFile, NothingIsLeftWhereItsSourceFails) {
  EXPECT_THROW(WriteShard(folder_ / "a.cfshard", Header({1, 2}),
                          [](const BundleSink& sink) {
                            sink.on_learned({});
                            throw Error(ErrorKind::kInterrupted, "interrupted");
                          }),
               Error);
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace curvefusion
