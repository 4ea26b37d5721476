#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <type_traits>

#include "kernel/progress.h"

namespace curvefusion {

/// Runs `work` on a thread of its own and returns when it ends; its exceptions pass through. The
/// calling thread, which must hold the GIL, gives it up meanwhile, so that other threads of Python
/// go on. What `work` reports goes to `callback` (None = nobody), on the calling thread and with
/// the GIL. Where the callback raises, or a handler of a signal (Ctrl-C) does, the work is ended
/// and the exception passes on. Ctrl-C cancels all work of the process (kernel/cancellation.h).
void RunInterruptibly(const pybind11::object& callback,
                      const std::function<void(const Progress&)>& work);

/// The same for work that reports nothing, and returns a value.
template <class Work>
std::invoke_result_t<Work> Interruptible(const Work& work) {
  std::optional<std::invoke_result_t<Work>> result;
  RunInterruptibly(pybind11::none(), [&](const Progress&) { result.emplace(work()); });
  return std::move(*result);
}

}  // namespace curvefusion
