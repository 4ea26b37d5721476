#pragma once

#include <gtest/gtest.h>

#include "experiments/studies/gnuplot.h"
#include "kernel/error.h"

namespace curvefusion {

/// Tests that draw: skipped where gnuplot cannot be run.
class WithGnuplot : public testing::Test {
 protected:
  void SetUp() override {
    try {
      RequireGnuplot();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

}  // namespace curvefusion
