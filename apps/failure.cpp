#include "apps/failure.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr int kInternalError = 1;
constexpr int kBrokenPipe = 128 + SIGPIPE;  // as a shell shows it

// fmt would throw where the error stream cannot be written. Takes no memory: there may be none.
int Tell(ErrorKind kind, std::string_view message) {
  std::fprintf(stderr, "curvefusion: %.*s\n", static_cast<int>(message.size()), message.data());
  return ExitCode(kind);
}

int TellOutOfMemory() {
  return Tell(ErrorKind::kResource, "out of memory; use fewer frames or larger voxels");
}

int TellNoThreads() {
  return Tell(
      ErrorKind::kResource,
      "no more threads can be started; raise the limits (ulimit -u, ulimit -v) or use --threads 1");
}

bool IsLackOfResource(const std::error_code& code) {
  for (const std::errc lack :
       {std::errc::no_space_on_device, std::errc::file_too_large, std::errc::not_enough_memory,
        std::errc::too_many_files_open, std::errc::too_many_files_open_in_system,
        std::errc::io_error, std::errc::read_only_file_system,
        std::errc::resource_unavailable_try_again}) {
    if (code == lack) return true;
  }
  return code.value() == EDQUOT && code.category() == std::generic_category();
}

int TellFile(const std::filesystem::filesystem_error& error) {
  const std::string path = error.path2().empty() ? error.path1().string() : error.path2().string();
  const ErrorKind kind =
      IsLackOfResource(error.code()) ? ErrorKind::kResource : ErrorKind::kBadInput;
  return Tell(kind, fmt::format("{}: cannot be used ({})", path, error.code().message()));
}

int TellSystem(const std::system_error& error) {
  if (error.code() == std::errc::broken_pipe) return kBrokenPipe;
  if (error.code() == std::errc::resource_unavailable_try_again) return TellNoThreads();
  const bool printing = std::string_view(error.what()).find("write to file") != std::string::npos;
  return Tell(
      ErrorKind::kResource,
      fmt::format("{} ({})", printing ? "the output cannot be written" : "out of a resource",
                  error.code().message()));
}

int TellInternal(const std::string& what) {
  std::fprintf(stderr, "curvefusion: internal error, please report it: %s\n", what.c_str());
  return kInternalError;
}

// TBB and CHOLMOD tell of lacks by words only.
int TellOther(const std::exception& error) {
  const std::string_view what = error.what();
  if (what.find("pthread_create") != std::string_view::npos) return TellNoThreads();
  return TellInternal(error.what());
}

// Of what is being thrown.
int TellWhatWasThrown() {
  try {
    throw;
  } catch (const Error& error) {
    return Tell(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    return TellOutOfMemory();
  } catch (const std::length_error&) {  // of a container that would need more than can be
    return TellOutOfMemory();
  } catch (const cv::Exception& error) {
    return error.code == cv::Error::StsNoMem ? TellOutOfMemory() : TellOther(error);
  } catch (const std::filesystem::filesystem_error& error) {
    return TellFile(error);
  } catch (const std::system_error& error) {
    return TellSystem(error);
  } catch (const std::exception& error) {
    return TellOther(error);
  } catch (...) {
    return TellInternal("an exception of unknown kind");
  }
}

}  // namespace

void IgnoreWriteSignals() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

int ReportFailure() {
  try {
    return TellWhatWasThrown();
  } catch (const std::bad_alloc&) {  // in the making of the message
    return TellOutOfMemory();
  }
}

int FlushedOutput(int exit_code) {
  errno = 0;
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (!failed || errno == EPIPE) return exit_code;
  return Tell(ErrorKind::kResource,
              fmt::format("standard output cannot be written ({})",
                          std::generic_category().message(errno != 0 ? errno : EIO)));
}

}  // namespace curvefusion
