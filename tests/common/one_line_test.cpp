#include "common/one_line.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(OneLine, HasASpaceForEveryControlCharacter) {
  EXPECT_EQ(oneLine("saw 't\n'\r\tand\x01more"), "saw 't '  and more");
}

TEST(OneLine, KeepsAllElse) {
  EXPECT_EQ(oneLine(""), "");
  EXPECT_EQ(oneLine("κ × h ~ 1"), "κ × h ~ 1");
}

}  // namespace
}  // namespace gnomon
