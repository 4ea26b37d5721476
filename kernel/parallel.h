#pragma once

#include <cstdint>
#include <functional>

namespace curvefusion {

/// Limits every parallel loop started while it lives to so many threads; 0 = all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  Impl* impl_;
};

/// Calls body(first, last) on disjoint chunks of [begin, end), each of at most `grain` indices, in
/// parallel. The chunks do not depend on the number of threads: a body that writes only to its own
/// indices gives the same result for any number. Exceptions, cancellation too, reach the caller.
void ParallelChunks(int64_t begin, int64_t end, int64_t grain,
                    const std::function<void(int64_t first, int64_t last)>& body);

/// Calls body(i) for every i in [begin, end), in parallel chunks of `grain`.
template <class Body>
void ParallelFor(int64_t begin, int64_t end, int64_t grain, const Body& body) {
  ParallelChunks(begin, end, grain, [&body](int64_t first, int64_t last) {
    for (int64_t i = first; i < last; ++i) body(i);
  });
}

}  // namespace curvefusion
