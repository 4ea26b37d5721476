#include "kernel/parallel.h"

#include <algorithm>

#include "kernel/cancellation.h"

#ifdef CURVEFUSION_STD_THREADS
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#endif

namespace curvefusion {

#ifdef CURVEFUSION_STD_THREADS

// Debian's TBB is not built for ThreadSanitizer, which then reports races inside it: this back end
// runs the same chunks on plain threads.
namespace {
std::atomic<int> thread_limit{0};

int ThreadCount() {
  const int limit = thread_limit.load();
  return limit > 0 ? limit : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}
}  // namespace

struct ThreadLimit::Impl {
  int previous;
};

ThreadLimit::ThreadLimit(int threads) : impl_(new Impl{thread_limit.exchange(threads)}) {}

ThreadLimit::~ThreadLimit() {
  thread_limit = impl_->previous;
  delete impl_;
}

void ParallelChunks(int64_t begin, int64_t end, int64_t grain,
                    const std::function<void(int64_t, int64_t)>& body) {
  std::atomic<int64_t> next{begin};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    for (int64_t first = next.fetch_add(grain); first < end; first = next.fetch_add(grain)) {
      try {
        ThrowIfCancelled();
        body(first, std::min(first + grain, end));
      } catch (...) {
        const std::lock_guard<std::mutex> lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next = end;
      }
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < ThreadCount(); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

#else

struct ThreadLimit::Impl {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : impl_(threads > 0 ? new Impl{tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                                       static_cast<size_t>(threads))}
                        : nullptr) {}

ThreadLimit::~ThreadLimit() { delete impl_; }

void ParallelChunks(int64_t begin, int64_t end, int64_t grain,
                    const std::function<void(int64_t, int64_t)>& body) {
  const int64_t chunks = (end - begin + grain - 1) / grain;
  if (chunks <= 0) return;
  tbb::parallel_for(
      tbb::blocked_range<int64_t>(0, chunks, 1),
      [&](const tbb::blocked_range<int64_t>& range) {
        for (int64_t chunk = range.begin(); chunk < range.end(); ++chunk) {
          ThrowIfCancelled();
          const int64_t first = begin + chunk * grain;
          body(first, std::min(first + grain, end));
        }
      },
      tbb::simple_partitioner());
}

#endif

}  // namespace curvefusion
