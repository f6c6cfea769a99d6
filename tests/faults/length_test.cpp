#include "support/test_length.h"

#include <gtest/gtest.h>

#include "support/scoped_variable.h"

namespace gnomon {
namespace {

test::ScopedVariable longTests(const char* value) {
  return {"GNOMON_LONG_TESTS", value};
}

TEST(TestLength, IsLongOnlyWhereItIsAskedFor) {
  EXPECT_EQ((longTests(nullptr), test::repetitions(2, 50)), 2);
  EXPECT_EQ((longTests("0"), test::repetitions(2, 50)), 2);
  EXPECT_EQ((longTests("1"), test::repetitions(2, 50)), 50);
}

}  // namespace
}  // namespace gnomon
