#pragma once

#include <ctime>

namespace curvefusion {

/// Processor seconds of this process so far, of all its threads.
inline double ProcessorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Adds the processor time until its end of life, of all threads, to a sum.
class ProcessorTimer {
 public:
  explicit ProcessorTimer(double& seconds) : seconds_(seconds) {}
  ~ProcessorTimer() { seconds_ += ProcessorSeconds() - start_; }
  ProcessorTimer(const ProcessorTimer&) = delete;
  ProcessorTimer& operator=(const ProcessorTimer&) = delete;

 private:
  double& seconds_;
  double start_ = ProcessorSeconds();
};

}  // namespace curvefusion
