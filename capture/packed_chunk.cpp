#include "capture/packed_chunk.h"

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>

#include <algorithm>
#include <memory>
#include <new>

namespace curvefusion {

namespace {

// Grown step by step, so that a false size takes no memory that the data do not fill.
constexpr size_t kStep = size_t{1} << 20;

// Calls step(target, room) for the next bytes of `unpacked` until it says that nothing more comes;
// it returns how many it wrote, or -1 for damaged data.
template <class Step>
std::string Grow(std::uint64_t size, std::string& unpacked, const Step& step) {
  size_t filled = 0;
  while (true) {
    // One byte more than there may be tells too long data.
    unpacked.resize(std::min<size_t>(filled + kStep, size + 1));
    const std::int64_t written = step(unpacked.data() + filled, unpacked.size() - filled);
    if (written < 0) return "its compressed data are damaged";
    filled += static_cast<size_t>(written);
    if (written == 0 || filled > size) break;
  }
  unpacked.resize(filled);
  if (filled == size) return {};
  return fmt::format("it unpacks to {} bytes, not to {}",
                     filled > size ? "more" : std::to_string(filled), size);
}

std::string UnpackLz4(std::uint64_t size, const std::string& packed, std::string& unpacked) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION))) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, LZ4F_freeDecompressionContext);
  size_t used = 0;
  return Grow(size, unpacked, [&](char* target, size_t room) -> std::int64_t {
    size_t written = room;
    size_t read = packed.size() - used;
    const size_t status =
        LZ4F_decompress(context.get(), target, &written, packed.data() + used, &read, nullptr);
    used += read;
    return LZ4F_isError(status) ? -1 : static_cast<std::int64_t>(written);
  });
}

std::string UnpackBzip2(std::uint64_t size, const std::string& packed, std::string& unpacked) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> ended(&stream,
                                                                         BZ2_bzDecompressEnd);
  stream.next_in = const_cast<char*>(packed.data());  // bzip2 does not write through it
  stream.avail_in = static_cast<unsigned>(packed.size());
  bool is_over = false;
  return Grow(size, unpacked, [&](char* target, size_t room) -> std::int64_t {
    if (is_over) return 0;
    stream.next_out = target;
    stream.avail_out = static_cast<unsigned>(room);
    const int status = BZ2_bzDecompress(&stream);
    if (status == BZ_MEM_ERROR) throw std::bad_alloc();
    if (status != BZ_OK && status != BZ_STREAM_END) return -1;
    is_over = status == BZ_STREAM_END;
    return static_cast<std::int64_t>(room - stream.avail_out);
  });
}

}  // namespace

std::string Unpack(const PackedChunk& chunk, const std::string& packed, std::string& unpacked) {
  switch (chunk.packing) {
    case Packing::kLz4:
      return UnpackLz4(chunk.unpacked_bytes, packed, unpacked);
    case Packing::kBzip2:
      return UnpackBzip2(chunk.unpacked_bytes, packed, unpacked);
    case Packing::kNone:
      break;
  }
  unpacked = packed;
  return {};
}

}  // namespace curvefusion
