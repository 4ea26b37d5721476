#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <exception>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "apps/live/live_source.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr int kMostWait = 100;  // milliseconds until it is asked whether to go on

bool IsFull(int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

[[noreturn]] void ThrowUnwritable(const fs::path& path) {
  throw Error(ErrorKind::kResource, fmt::format("{}: cannot be written: is the disk full, or the "
                                                "folder not yours?",
                                                path.string()));
}

// Reads a descriptor until it ends or nobody wants more.
class Input {
 public:
  Input(int descriptor, const std::atomic<bool>& is_unwanted)
      : descriptor_(descriptor), is_unwanted_(is_unwanted) {}

  // As archive_read_open wants it; `self` is an Input.
  static la_ssize_t Read(archive* reader, void* self, const void** block) {
    return static_cast<Input*>(self)->ReadBlock(reader, block);
  }

 private:
  la_ssize_t ReadBlock(archive* reader, const void** block) {
    *block = block_.data();
    pollfd waiting = {descriptor_, POLLIN, 0};
    while (poll(&waiting, 1, kMostWait) <= 0) {
      if (is_unwanted_) return 0;
    }
    const ssize_t size = read(descriptor_, block_.data(), block_.size());
    if (size < 0) archive_set_error(reader, errno, "Cannot be read");
    return size;
  }

  int descriptor_;
  const std::atomic<bool>& is_unwanted_;
  std::array<char, 1 << 16> block_;
};

// Unpacks a tar archive from standard input into a folder, on a thread of its own.
class Unpacking {
 public:
  explicit Unpacking(fs::path folder) : folder_(std::move(folder)), thread_([this] { Run(); }) {}

  ~Unpacking() {
    is_unwanted_ = true;
    thread_.join();
  }

  // Throws what has kept the stream from being unpacked.
  void ThrowIfFailed() const {
    if (has_failed_) std::rethrow_exception(failure_);
  }

 private:
  void Run() {
    try {
      Unpack();
      const fs::path end = folder_ / "end";
      if (!std::ofstream(end)) ThrowUnwritable(end);
    } catch (...) {
      failure_ = std::current_exception();
      has_failed_ = true;
    }
  }

  void Unpack() {
    Input input(STDIN_FILENO, is_unwanted_);
    const std::unique_ptr<archive, decltype(&archive_read_free)> reader(archive_read_new(),
                                                                        &archive_read_free);
    archive_read_support_format_tar(reader.get());
    Check(archive_read_open(reader.get(), &input, nullptr, &Input::Read, nullptr), *reader);
    archive_entry* entry = nullptr;
    while (!is_unwanted_) {
      const int result = archive_read_next_header(reader.get(), &entry);
      if (result == ARCHIVE_EOF) break;
      Check(result, *reader);
      UnpackEntry(*reader, *entry);
    }
  }

  void UnpackEntry(archive& reader, archive_entry& entry) const {
    const char* name = archive_entry_pathname(&entry);
    const fs::path inside = fs::path(name ? name : "").lexically_normal();
    const auto type = archive_entry_filetype(&entry);
    if (inside.empty() || inside.is_absolute() || *inside.begin() == ".." ||
        (type != AE_IFREG && type != AE_IFDIR)) {
      Fail(
          fmt::format("'{}' in the archive is no file or folder inside the scan", inside.string()));
    }
    const fs::path path = folder_ / inside;
    if (type == AE_IFDIR) {
      fs::create_directories(path);
      return;
    }
    fs::create_directories(path.parent_path());
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) ThrowUnwritable(path);
    const int result = archive_read_data_into_fd(&reader, file);
    close(file);
    if (result < ARCHIVE_WARN && IsFull(archive_errno(&reader))) ThrowUnwritable(path);
    Check(result, reader);
  }

  void Check(int result, archive& reader) const {
    if (result >= ARCHIVE_WARN || is_unwanted_) return;
    const char* reason = archive_error_string(&reader);
    Fail(reason ? reason : "no tar archive");
  }

  [[noreturn]] void Fail(const std::string& reason) const {
    throw Error(ErrorKind::kBadInput,
                fmt::format("standard input: {}. What came before lies in {}: reconstruct that, or "
                            "send a tar archive with intrinsics.json, depth/, color/ and pose/",
                            reason, folder_.string()));
  }

  fs::path folder_;
  std::atomic<bool> is_unwanted_ = false;
  std::exception_ptr failure_;
  std::atomic<bool> has_failed_ = false;
  std::thread thread_;  // last: uses the rest
};

class StreamedFolder : public LiveSource {
 public:
  StreamedFolder(const fs::path& folder, bool use_poses)
      : unpacking_(folder), followed_(FollowFolder(folder, use_poses, kNoLimit)) {}

  std::optional<Sequence> Cameras() override {
    unpacking_.ThrowIfFailed();
    return followed_->Cameras();
  }

  std::vector<ArrivedFrame> Arrived(double now) override {
    unpacking_.ThrowIfFailed();
    return followed_->Arrived(now);
  }

  bool HasEnded(double now) override { return followed_->HasEnded(now); }

 private:
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  Unpacking unpacking_;
  std::unique_ptr<LiveSource> followed_;
};

}  // namespace

std::unique_ptr<LiveSource> ReceiveFolder(const fs::path& folder, bool use_poses) {
  return std::make_unique<StreamedFolder>(folder, use_poses);
}

}  // namespace curvefusion
