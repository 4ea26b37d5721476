// For LD_PRELOAD on Linux with glibc: lets one operation of a program, or some in a row, fail. From
// the start of main on, operations are counted; the environment names those that fail:
//   FAULT_KIND   write: whatever changes a file or a folder; allocation: whatever takes memory
//   FAULT_FIRST  number of the first that fails, from 1; 0: none, they are only counted
//   FAULT_COUNT  how many fail from there on; 0: for allocations, all until something is freed, and
//                for writes, all that need room on a device
//   FAULT_BYTES  allocations below this size are not counted and never fail
//   FAULT_ERRNO  what a failing write says (a failing allocation says ENOMEM)
//   FAULT_LOG    file that tells "failed NUMBER NAME" of the first that failed, and at the end of
//                the program "total NUMBER"
// Reading and removing never fail. Nothing here allocates: it would call itself.

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
// glibc's own allocator, which its replacements call without looking it up.
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* block, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* block);
}

namespace {

enum class Kind { kNone, kWrite, kAllocation };

struct Plan {
  Kind kind = Kind::kNone;
  long first = 0;
  long count = 1;
  size_t least_bytes = 0;
  int error = ENOSPC;
};
Plan plan;
std::atomic<long> operations{0};
std::atomic<bool> counts{false};
std::atomic<bool> is_exhausted{false};  // nothing was freed since an allocation failed
thread_local bool is_left_out = false;  // in what cannot be mended here
thread_local bool is_inside = false;    // in a function of stdio, which is one write as a whole

long Number(const char* variable, long otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atol(text);
}

// By system calls alone, which are never counted.
void Log(const char* what, long number, const char* name) {
  const char* path = std::getenv("FAULT_LOG");
  if (path == nullptr) return;
  char line[128];
  const int length = std::snprintf(line, sizeof(line), "%s %ld %s\n", what, number, name);
  const long file = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND, 0644);
  if (file < 0) return;
  syscall(SYS_write, file, line, length);
  syscall(SYS_close, file);
}

// Whether the operation of this number is to fail.
bool IsChosen(Kind kind, long number, bool needs_room) {
  if (plan.first == 0 || number < plan.first) return false;
  if (number == plan.first) return true;
  if (plan.count > 0) return number < plan.first + plan.count;
  return kind == Kind::kWrite ? needs_room : is_exhausted.load();
}

// Counts an operation and tells whether it is to fail.
bool Fails(Kind kind, const char* name, bool needs_room = true) {
  if (!counts.load(std::memory_order_relaxed) || kind != plan.kind || is_left_out) return false;
  if (kind == Kind::kWrite && is_inside) return false;
  const long number = ++operations;
  if (!IsChosen(kind, number, needs_room)) return false;
  if (number == plan.first) {
    is_exhausted = true;
    Log("failed", number, name);
  }
  errno = kind == Kind::kWrite ? plan.error : ENOMEM;
  return true;
}

bool FailsToAllocate(size_t bytes, const char* name) {
  return bytes >= plan.least_bytes && Fails(Kind::kAllocation, name);
}

template <class Function>
Function* Real(const char* name, Function*) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

// The function of this name that would have been called without this library.
#define REAL(function) Real(#function, &(function))

bool IsForWriting(int flags) { return (flags & (O_WRONLY | O_RDWR | O_CREAT | O_TRUNC)) != 0; }

bool IsForWriting(const char* mode) { return std::strpbrk(mode, "wa+") != nullptr; }

bool IsForWriting(FILE* stream) {
  const int flags = fcntl(fileno(stream), F_GETFL);
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

// What is still in the stream's buffer, and whatever follows, meets a full device.
void Fill(FILE* stream) {
  const auto full = static_cast<int>(syscall(SYS_openat, AT_FDCWD, "/dev/full", O_WRONLY, 0));
  if (full < 0) return;
  dup2(full, fileno(stream));
  syscall(SYS_close, full);
}

// Sets a flag of this thread to the end of a scope.
class Raised {
 public:
  explicit Raised(bool& flag) : flag_(flag), before_(flag) { flag = true; }
  ~Raised() { flag_ = before_; }
  Raised(const Raised&) = delete;
  Raised& operator=(const Raised&) = delete;

 private:
  bool& flag_;
  bool before_;
};

mode_t ModeOf(int flags, va_list arguments) {
  return (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

int (*program_main)(int, char**, char**) = nullptr;

void LogTotal() {
  counts = false;
  Log("total", operations, "");
}

// What ran before, libraries set themselves up with; nobody could catch it if that failed.
int CountedMain(int argc, char** argv, char** environment) {
  const char* kind = std::getenv("FAULT_KIND");
  if (kind != nullptr)
    plan.kind = std::strcmp(kind, "write") == 0 ? Kind::kWrite : Kind::kAllocation;
  plan.first = Number("FAULT_FIRST", 0);
  plan.count = Number("FAULT_COUNT", 1);
  plan.least_bytes = static_cast<size_t>(Number("FAULT_BYTES", 0));
  plan.error = static_cast<int>(Number("FAULT_ERRNO", ENOSPC));
  counts = true;
  const int result = program_main(argc, argv, environment);
  // What libraries take down themselves with is nobody's to catch either.
  if (plan.kind == Kind::kAllocation) counts = false;
  return result;
}

[[gnu::destructor]] void AtEnd() { LogTotal(); }

}  // namespace

extern "C" {

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(),
                      void (*finish)(), void (*unload)(), void* stack_end) {
  using Start =
      int(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*);
  program_main = main;
  const auto start = reinterpret_cast<Start*>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(CountedMain, argc, argv, init, finish, unload, stack_end);
}

// Allocations. operator new calls malloc or aligned_alloc.

void* malloc(size_t size) {
  return FailsToAllocate(size, "malloc") ? nullptr : __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
  return FailsToAllocate(count * size, "calloc") ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* block, size_t size) {
  return FailsToAllocate(size, "realloc") ? nullptr : __libc_realloc(block, size);
}

void* memalign(size_t alignment, size_t size) {
  return FailsToAllocate(size, "memalign") ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(size_t alignment, size_t size) {
  return FailsToAllocate(size, "aligned_alloc") ? nullptr : __libc_memalign(alignment, size);
}

int posix_memalign(void** block, size_t alignment, size_t size) {
  if (FailsToAllocate(size, "posix_memalign")) return ENOMEM;
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

void free(void* block) {
  if (block != nullptr) is_exhausted.store(false, std::memory_order_relaxed);
  __libc_free(block);
}

void* mmap(void* address, size_t length, int protection, int flags, int file, off_t offset) {
  if (FailsToAllocate(length, "mmap")) return MAP_FAILED;
  return reinterpret_cast<void*>(
      syscall(SYS_mmap, address, length, protection, flags, file, offset));
}

void* mmap64(void* address, size_t length, int protection, int flags, int file, off64_t offset) {
  return mmap(address, length, protection, flags, file, offset);
}

// TBB calls this when it is asked for the first thread; glibc's dlopen goes on without the memory
// for its own messages, through a null pointer.
void* dlopen(const char* file, int mode) {
  const Raised left_out(is_left_out);
  return REAL(dlopen)(file, mode);
}

// Opening files to write them.

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = ModeOf(flags, arguments);
  va_end(arguments);
  if (IsForWriting(flags) && Fails(Kind::kWrite, "open")) return -1;
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = ModeOf(flags, arguments);
  va_end(arguments);
  return open(path, flags | O_LARGEFILE, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = ModeOf(flags, arguments);
  va_end(arguments);
  if (IsForWriting(flags) && Fails(Kind::kWrite, "openat")) return -1;
  return static_cast<int>(syscall(SYS_openat, folder, path, flags, mode));
}

int openat64(int folder, const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = ModeOf(flags, arguments);
  va_end(arguments);
  return openat(folder, path, flags | O_LARGEFILE, mode);
}

int creat(const char* path, mode_t mode) { return open(path, O_CREAT | O_WRONLY | O_TRUNC, mode); }

FILE* fopen(const char* path, const char* mode) {
  if (IsForWriting(mode) && Fails(Kind::kWrite, "fopen")) return nullptr;
  return REAL(fopen)(path, mode);
}

FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }

FILE* fdopen(int file, const char* mode) {
  if (IsForWriting(mode) && Fails(Kind::kWrite, "fdopen")) return nullptr;
  return REAL(fdopen)(file, mode);
}

// Writing to open files.

ssize_t write(int file, const void* data, size_t size) {
  return Fails(Kind::kWrite, "write") ? -1 : syscall(SYS_write, file, data, size);
}

ssize_t pwrite(int file, const void* data, size_t size, off_t offset) {
  return Fails(Kind::kWrite, "pwrite") ? -1 : syscall(SYS_pwrite64, file, data, size, offset);
}

ssize_t pwrite64(int file, const void* data, size_t size, off64_t offset) {
  return pwrite(file, data, size, offset);
}

ssize_t writev(int file, const iovec* parts, int count) {
  return Fails(Kind::kWrite, "writev") ? -1 : syscall(SYS_writev, file, parts, count);
}

int ftruncate(int file, off_t length) {
  return Fails(Kind::kWrite, "ftruncate") ? -1
                                          : static_cast<int>(syscall(SYS_ftruncate, file, length));
}

int ftruncate64(int file, off64_t length) { return ftruncate(file, length); }

int fallocate(int file, int mode, off_t offset, off_t length) {
  if (Fails(Kind::kWrite, "fallocate")) return -1;
  return static_cast<int>(syscall(SYS_fallocate, file, mode, offset, length));
}

int fsync(int file) {
  return Fails(Kind::kWrite, "fsync") ? -1 : static_cast<int>(syscall(SYS_fsync, file));
}

int fdatasync(int file) {
  return Fails(Kind::kWrite, "fdatasync") ? -1 : static_cast<int>(syscall(SYS_fdatasync, file));
}

// A file is closed in any case: only its last bytes may be lost.
int close(int file) {
  const int flags = fcntl(file, F_GETFL);
  const bool is_written = flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
  const bool fails = is_written && Fails(Kind::kWrite, "close");
  const auto closed = static_cast<int>(syscall(SYS_close, file));
  if (!fails) return closed;
  errno = plan.error;
  return -1;
}

size_t fwrite(const void* data, size_t size, size_t count, FILE* stream) {
  if (Fails(Kind::kWrite, "fwrite")) Fill(stream);
  const Raised inside(is_inside);
  return REAL(fwrite)(data, size, count, stream);
}

int fputs(const char* text, FILE* stream) {
  if (Fails(Kind::kWrite, "fputs")) Fill(stream);
  const Raised inside(is_inside);
  return REAL(fputs)(text, stream);
}

int fputc(int character, FILE* stream) {
  if (Fails(Kind::kWrite, "fputc")) Fill(stream);
  const Raised inside(is_inside);
  return REAL(fputc)(character, stream);
}

int putc(int character, FILE* stream) { return fputc(character, stream); }

int fflush(FILE* stream) {
  const bool is_written = stream != nullptr && IsForWriting(stream);
  if (is_written && Fails(Kind::kWrite, "fflush")) Fill(stream);
  const Raised inside(is_inside);
  return REAL(fflush)(stream);
}

int fclose(FILE* stream) {
  const bool fails = IsForWriting(stream) && Fails(Kind::kWrite, "fclose");
  if (fails) Fill(stream);
  const Raised inside(is_inside);
  const int closed = REAL(fclose)(stream);
  if (!fails) return closed;
  errno = plan.error;
  return EOF;
}

// Changing folders.

int mkdir(const char* path, mode_t mode) {
  return Fails(Kind::kWrite, "mkdir")
             ? -1
             : static_cast<int>(syscall(SYS_mkdirat, AT_FDCWD, path, mode));
}

int mkdirat(int folder, const char* path, mode_t mode) {
  return Fails(Kind::kWrite, "mkdirat")
             ? -1
             : static_cast<int>(syscall(SYS_mkdirat, folder, path, mode));
}

int rename(const char* from, const char* to) {
  if (Fails(Kind::kWrite, "rename", false)) return -1;
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  if (Fails(Kind::kWrite, "renameat", false)) return -1;
  return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, 0));
}

int symlink(const char* target, const char* path) {
  return Fails(Kind::kWrite, "symlink")
             ? -1
             : static_cast<int>(syscall(SYS_symlinkat, target, AT_FDCWD, path));
}

int link(const char* from, const char* to) {
  return Fails(Kind::kWrite, "link")
             ? -1
             : static_cast<int>(syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
}

}  // extern "C"
