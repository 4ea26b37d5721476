#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace curvefusion {

/// Does jobs on a thread of its own, always the latest one: a job that has not begun when the next
/// one comes is left out.
template <class Job>
class LatestWorker {
 public:
  explicit LatestWorker(std::function<void(Job)> work)
      : work_(std::move(work)), thread_([this] { Run(); }) {}
  /// Waits for the job that is being done; one that has not begun is left out.
  ~LatestWorker() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
      waiting_.reset();
    }
    changed_.notify_all();
    thread_.join();
  }
  LatestWorker(const LatestWorker&) = delete;
  LatestWorker& operator=(const LatestWorker&) = delete;

  /// Throws what an earlier job has thrown.
  void Offer(Job job) {
    {
      const std::lock_guard lock(mutex_);
      if (failure_) std::rethrow_exception(failure_);
      waiting_ = std::move(job);
    }
    changed_.notify_all();
  }

  /// Waits until all is done. Throws what a job has thrown.
  void Wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return failure_ || (!waiting_ && !busy_); });
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void Run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return waiting_ || ending_; });
      if (!waiting_) return;
      Job job = std::move(*waiting_);
      waiting_.reset();
      busy_ = true;
      lock.unlock();
      std::exception_ptr failure;
      try {
        work_(std::move(job));
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      busy_ = false;
      if (failure) failure_ = failure;
      changed_.notify_all();
    }
  }

  std::function<void(Job)> work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Job> waiting_;
  bool busy_ = false;
  bool ending_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // last: begins when all else is there
};

}  // namespace curvefusion
