#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "render/method.h"

namespace gnomon::test {

/// A method of its own text: TOML lines of its declaration, beside title and citation, and its
/// code.
inline render::Method methodOfText(const std::string& declaration, const std::string& code) {
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".glsl");
  std::ofstream(path) << "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n"
                      << declaration << "\n*/\n"
                      << code;
  render::Method method = render::readMethod(path);
  std::filesystem::remove(path);
  return method;
}

}  // namespace gnomon::test
