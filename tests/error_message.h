#pragma once

#include <gtest/gtest.h>

#include <string>

#include "kernel/error.h"

namespace curvefusion {

/// The message of the Error that `act` throws; the test fails where it throws none.
template <class Act>
std::string MessageOf(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

/// The same, of an Error that has to be of this kind.
template <class Act>
std::string MessageOf(ErrorKind kind, const Act& act) {
  return MessageOf([&] {
    try {
      act();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
      throw;
    }
  });
}

}  // namespace curvefusion
