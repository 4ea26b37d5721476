#include <cstring>
#include <string>

#include "fusion/shards/shard_fields.h"
#include "fusion/shards/shard_set.h"
#include "kernel/fnv_hash.h"
#include "tests/fuzz/fuzz_target.h"

using namespace curvefusion;

namespace {

void ReadShard(const std::filesystem::path& file) {
  AcceptErrors([&] {
    const Shard shard = OpenShard(file);
    ForeignText(shard.header.identity, {"", shard.header.prepared, shard.header.identity.scan});
    ReadBundles(shard, [](const SegmentedBundle&) {});
  });
}

}  // namespace

// As it is, and with a checksum that fits, which hardly any input would have.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const InputFolder folder;
  std::string bytes(Text(data, size));
  ReadShard(folder.Write("input.cfshard", bytes));
  constexpr size_t kTrailer = 16;
  if (size < kTrailer) return 0;
  bytes.replace(size - kTrailer, 8, "CFSHEND\n");
  FnvHash checksum;
  checksum.Add(std::string_view(bytes).substr(0, size - kTrailer));
  const uint64_t value = checksum.value();
  std::memcpy(bytes.data() + size - 8, &value, 8);
  ReadShard(folder.Write("input.cfshard", bytes));
  return 0;
}
