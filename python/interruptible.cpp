#include "python/interruptible.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "kernel/cancellation.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

namespace py = pybind11;

// How often signals are looked for: a person does not notice it, and it costs nothing.
constexpr std::chrono::milliseconds kSignalInterval(50);

struct Step {
  std::string stage;
  int64_t done = 0;
  int64_t total = 0;
};

// What the thread that works and the thread that waits for it tell each other.
class Exchange {
 public:
  // The working thread goes on when the waiting one has answered.
  void Tell(std::string_view stage, int64_t done, int64_t total) {
    std::unique_lock lock(mutex_);
    step_ = Step{std::string(stage), done, total};
    changed_.notify_all();
    changed_.wait(lock, [this] { return !step_; });
    if (is_stopped_) throw Error(ErrorKind::kInterrupted, "interrupted; there is no result");
  }

  void Finish() {
    const std::lock_guard lock(mutex_);
    is_finished_ = true;
    changed_.notify_all();
  }

  // Whether the work goes on, and the step it waits with. Returns after kSignalInterval at last.
  bool IsAtWork(std::optional<Step>& step) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kSignalInterval, [this] { return is_finished_ || step_; });
    step = step_;
    return !is_finished_;
  }

  void Answer(bool stop) {
    const std::lock_guard lock(mutex_);
    is_stopped_ = stop;
    step_.reset();
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Step> step_;
  bool is_stopped_ = false;
  bool is_finished_ = false;
};

void CallBack(const py::object& callback, const Step& step) {
  callback(step.stage, step.done, step.total);
}

// What Python raised while the work went on.
struct Raised {
  std::optional<py::error_already_set> error;
  bool by_signal = false;
};

// Handles signals and steps until the work ends.
Raised Attend(Exchange& exchange, const py::object& callback) {
  const py::gil_scoped_release released;
  Raised raised;
  std::optional<Step> step;
  while (exchange.IsAtWork(step)) {
    const py::gil_scoped_acquire acquired;
    try {
      if (PyErr_CheckSignals() != 0) {
        RequestCancellation();
        raised.by_signal = true;
        throw py::error_already_set();
      }
      if (step && !raised.error) CallBack(callback, *step);
    } catch (py::error_already_set& error) {
      if (!raised.error) raised.error.emplace(error);
    }
    if (step) exchange.Answer(raised.error.has_value());
  }
  return raised;
}

Progress ProgressInto(Exchange& exchange, const py::object& callback) {
  if (callback.is_none()) {
    return [](std::string_view, int64_t, int64_t) { ThrowIfCancelled(); };
  }
  return [&exchange](std::string_view stage, int64_t done, int64_t total) {
    ThrowIfCancelled();
    exchange.Tell(stage, done, total);
  };
}

}  // namespace

void RunInterruptibly(const py::object& callback,
                      const std::function<void(const Progress&)>& work) {
  Exchange exchange;
  std::exception_ptr failure;
  std::thread worker([&, progress = ProgressInto(exchange, callback)] {
    try {
      work(progress);
    } catch (...) {
      failure = std::current_exception();
    }
    exchange.Finish();
  });
  const Raised raised = Attend(exchange, callback);
  worker.join();
  if (raised.by_signal) ResetCancellation();
  if (raised.error) throw py::error_already_set(*raised.error);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace curvefusion
