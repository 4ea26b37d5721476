#include "kernel/run_lock.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <string>
#include <system_error>
#include <utility>

#include "kernel/error.h"
#include "kernel/process_mark.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

// What a lock file tells of its holder.
struct Holder {
  ProcessMark process;
  std::string since;
};

std::string HolderText(const Holder& holder) {
  return fmt::format("pid {}\nhost {}\nboot {}\nsince {}\n", holder.process.pid,
                     holder.process.host, holder.process.boot, holder.since);
}

Holder ParsedHolder(const std::string& text) {
  Holder holder;
  LineScanner lines(text);
  std::string_view line;
  while (lines.Next(line)) {
    const std::string_view key = NextWord(line);
    const std::string value(line.substr(line.empty() ? 0 : 1));
    if (key == "pid") holder.process.pid = static_cast<int>(ParseInteger(value).value_or(0));
    if (key == "host") holder.process.host = value;
    if (key == "boot") holder.process.boot = value;
    if (key == "since") holder.since = value;
  }
  return holder;
}

Holder ReadHolder(int descriptor) {
  std::array<char, 1024> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  return ParsedHolder({text.data(), static_cast<size_t>(size > 0 ? size : 0)});
}

std::string Described(const Holder& holder) {
  if (holder.process.pid == 0) return "another run";
  return fmt::format("process {} on {}, since {},", holder.process.pid, holder.process.host,
                     holder.since);
}

[[noreturn]] void ThrowBusy(const fs::path& place, const Holder& holder) {
  throw Error(ErrorKind::kBusy,
              fmt::format("{}: {} is writing there; wait for its end or name another place",
                          place.string(), Described(holder)));
}

// A lock of another kernel need not be visible here, whatever the file system.
void RefuseForeignHolder(const fs::path& place, const fs::path& file, const Holder& holder) {
  const ProcessMark here = ThisProcess();
  if (holder.process.pid == 0 || holder.process.boot == here.boot) return;
  if (holder.process.host == here.host) return;  // of an earlier boot
  throw Error(
      ErrorKind::kBusy,
      fmt::format("{}: {} may still be writing there, which cannot be seen from here; where "
                  "that run is over, remove {}",
                  place.string(), Described(holder), file.string()));
}

[[noreturn]] void ThrowUnwritable(const fs::path& file) {
  const std::string reason = std::generic_category().message(errno);
  throw Error(ErrorKind::kResource,
              fmt::format("{}: cannot be written ({})", file.string(), reason));
}

// Whether `descriptor` is still what the name stands for: the holder before may have removed it
// between opening and locking.
bool IsCurrent(int descriptor, const fs::path& file) {
  struct stat opened, named;
  return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

// False where another process holds the lock. On file systems without locks the number of the
// holder has to tell.
bool TryLock(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
  if (errno == EWOULDBLOCK) return false;
  const Holder holder = ReadHolder(descriptor);
  const bool here = holder.process.boot == ThisProcess().boot;
  return holder.process.pid == 0 || !here || IsGone(holder.process.pid);
}

}  // namespace

RunLock::RunLock(fs::path file, const fs::path& place) : file_(std::move(file)) {
  while (true) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0) ThrowUnwritable(file_);
    const bool locked = TryLock(descriptor_);
    if (locked && IsCurrent(descriptor_, file_)) break;
    const Holder holder = ReadHolder(descriptor_);
    ::close(descriptor_);
    if (!locked) ThrowBusy(place, holder);
  }
  try {
    RefuseForeignHolder(place, file_, ReadHolder(descriptor_));
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
  const std::string text = HolderText(
      {ThisProcess(), fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr)))});
  const bool written =
      ::ftruncate(descriptor_, 0) == 0 &&
      ::pwrite(descriptor_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
  if (written) {
    unfinished_.emplace(file_);
    return;
  }
  const int reason = errno;
  ::unlink(file_.c_str());
  ::close(descriptor_);
  errno = reason;
  ThrowUnwritable(file_);
}

RunLock::~RunLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace curvefusion
