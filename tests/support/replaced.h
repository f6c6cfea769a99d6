#pragma once

#include <gtest/gtest.h>

#include <string>

namespace gnomon::test {

/// A text with one part of it replaced; the part must be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at == std::string::npos) return text;
  return text.replace(at, from.size(), to);
}

}  // namespace gnomon::test
