#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace gnomon {

/// The message of the error that a call raises; a failed expectation if it raises none of that
/// type.
template <typename ErrorType, typename Call>
std::string messageOf(const Call& call) {
  try {
    call();
  } catch (const ErrorType& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error was raised";
  return {};
}

}  // namespace gnomon
