#include "kernel/process_mark.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <fstream>

namespace curvefusion {

namespace {

std::string HostName() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// "pid:[4026531836]" for what no container encloses.
std::string PidNamespace() {
  std::array<char, 64> name{};
  const ssize_t size = ::readlink("/proc/self/ns/pid", name.data(), name.size());
  return {name.data(), static_cast<size_t>(size > 0 ? size : 0)};
}

// FNV-1a, 32 bits: the same on every machine.
uint32_t Hash(const std::string& text) {
  uint32_t hash = 2166136261u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

}  // namespace

ProcessMark ThisProcess() {
  ProcessMark mark{::getpid(), HostName(), ""};
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), mark.boot);
  return mark;
}

std::string ProcessSpace() { return fmt::format("{:08x}", Hash(HostName() + PidNamespace())); }

bool IsGone(int pid) { return ::kill(pid, 0) != 0 && errno == ESRCH; }

}  // namespace curvefusion
