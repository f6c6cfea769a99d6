#pragma once

#include <gtest/gtest.h>

#include <string>

#include "gnomon/exception.h"

namespace gnomon::test {

/// Expects an Exception of a kind and returns its message.
template <typename Work>
std::string failureOf(const Work& work, FailureKind kind = FailureKind::badInput) {
  try {
    work();
  } catch (const Exception& failure) {
    EXPECT_EQ(failure.kind(), kind) << failure.what();
    return failure.what();
  }
  ADD_FAILURE() << "an Exception expected";
  return {};
}

}  // namespace gnomon::test
