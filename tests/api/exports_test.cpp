#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

std::string outputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  std::string text;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe.get()) != nullptr) text += buffer.data();
  return text;
}

// What else a shared library exports, a program may come to depend on.
TEST(ApiExports, NothingButTheFace) {
  EXPECT_THAT(outputOf("nm -DC --defined-only " GNOMON_LIBRARY " | grep ' T '"),
              HasSubstr("gnomon::api::runStudy"));
  EXPECT_EQ(
      outputOf("nm -DC --defined-only " GNOMON_LIBRARY " | grep -i gnomon | grep -v gnomon::api::"),
      "");
}

}  // namespace
}  // namespace gnomon::test
