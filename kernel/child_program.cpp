#include "kernel/child_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

namespace curvefusion {

namespace {

constexpr std::chrono::milliseconds kPoll{100};  // chosen: how long an interruption waits

// A file in memory that takes what a program prints.
class Printed {
 public:
  Printed() : file_(::memfd_create("printed", MFD_CLOEXEC)) {}
  ~Printed() {
    if (file_ >= 0) ::close(file_);
  }
  Printed(const Printed&) = delete;
  Printed& operator=(const Printed&) = delete;

  int file() const { return file_; }

  std::string Text() const {
    std::string text;
    std::array<char, 4096> part{};
    for (off_t at = 0;;) {
      const ssize_t count = ::pread(file_, part.data(), part.size(), at);
      if (count <= 0) return text;
      text.append(part.data(), static_cast<size_t>(count));
      at += count;
    }
  }

 private:
  int file_;
};

// The process, or 0 where it cannot be started.
pid_t Start(const std::string& program, const std::vector<std::string>& arguments,
            const std::filesystem::path& folder, const Printed& output, const Printed& messages) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), program);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output.file(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages.file(), STDERR_FILENO);
  pid_t child = 0;
  const int failure =
      posix_spawnp(&child, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failure == 0 ? child : 0;
}

// Ends and forgets a process that is still there when the scope is left.
class Child {
 public:
  explicit Child(pid_t process) : process_(process) {}
  ~Child() {
    if (has_ended_) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  bool HasEnded() {
    has_ended_ = has_ended_ || ::waitpid(process_, &status_, WNOHANG) != 0;
    return has_ended_;
  }
  bool has_succeeded() const { return WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }

 private:
  pid_t process_;
  int status_ = -1;
  bool has_ended_ = false;
};

}  // namespace

ProgramResult RunProgram(const std::string& program, const std::vector<std::string>& arguments,
                         const std::filesystem::path& folder,
                         const std::function<void()>& meanwhile) {
  const Printed output;
  const Printed messages;
  const pid_t process = Start(program, arguments, folder, output, messages);
  if (process == 0) return {};
  Child child(process);
  // Programs that take a moment only are not waited for until the next poll.
  std::chrono::milliseconds pause{1};
  while (!child.HasEnded()) {
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, kPoll);
    if (meanwhile) meanwhile();
  }
  return {child.has_succeeded(), output.Text(), messages.Text()};
}

}  // namespace curvefusion
