#include "apps/memory_reserve.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace curvefusion {

namespace {

// Chosen: many times what a destructor of JSON values takes, 16 bytes for each element of its
// largest array, and nothing beside what a run needs.
constexpr std::size_t kHalfBytes = 1 << 20;

// A new handler can reach nothing but globals.
std::atomic<void*> bridge{nullptr};
std::atomic<void*> rest{nullptr};

void UseReserve() {
  if (void* const block = bridge.exchange(nullptr)) {
    std::free(block);
    return;  // operator new tries again
  }
  std::free(rest.exchange(nullptr));
  throw std::bad_alloc();
}

}  // namespace

void SetMemoryAside() {
  bridge = std::malloc(kHalfBytes);
  rest = std::malloc(kHalfBytes);
  if (bridge == nullptr || rest == nullptr) throw std::bad_alloc();
  std::set_new_handler(UseReserve);
}

}  // namespace curvefusion
