#include "support/test_length.h"

#include <gtest/gtest.h>
#include <stdlib.h>

namespace gnomon {
namespace {

/// Sets or removes the variable while it lives.
class LongTests {
 public:
  explicit LongTests(const char* value) {
    if (const char* before = std::getenv("GNOMON_LONG_TESTS")) before_ = before;
    if (value != nullptr) {
      setenv("GNOMON_LONG_TESTS", value, 1);
    } else {
      unsetenv("GNOMON_LONG_TESTS");
    }
  }
  ~LongTests() {
    if (before_.empty()) {
      unsetenv("GNOMON_LONG_TESTS");
    } else {
      setenv("GNOMON_LONG_TESTS", before_.c_str(), 1);
    }
  }
  LongTests(const LongTests&) = delete;
  LongTests& operator=(const LongTests&) = delete;

 private:
  std::string before_;
};

TEST(TestLength, IsLongOnlyWhereItIsAskedFor) {
  EXPECT_EQ((LongTests(nullptr), test::repetitions(2, 50)), 2);
  EXPECT_EQ((LongTests("0"), test::repetitions(2, 50)), 2);
  EXPECT_EQ((LongTests("1"), test::repetitions(2, 50)), 50);
}

}  // namespace
}  // namespace gnomon
