#include "common/text/one_line.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(OneLine, HasASpaceForEveryControlCharacter) {
  EXPECT_EQ(oneLine("saw 't\n'\r\tand\x01more"), "saw 't '  and more");
}

TEST(OneLine, HasOneForEveryOtherEndOfALineToo) {
  EXPECT_EQ(oneLine("a\x7f"
                    "b\xc2\x85"
                    "c\xc2\x9b"
                    "2Jd\u2028e\u2029f"),
            "a b c 2Jd e f");
}

TEST(OneLine, ShowsWhereSomethingIsNoUtf8OrTurnsText) {
  EXPECT_EQ(oneLine("a\xff\xc3(b\xed\xa0\x80"), "a\uFFFD\uFFFD(b\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(oneLine("\u202epass\u202c\u2066x\u2069"), "\uFFFDpass\uFFFD\uFFFDx\uFFFD");
}

TEST(OneLine, KeepsAllElse) {
  EXPECT_EQ(oneLine("日本 𝛋 עברית"), "日本 𝛋 עברית");
  EXPECT_EQ(oneLine(""), "");
  EXPECT_EQ(oneLine("κ × h ~ 1"), "κ × h ~ 1");
}

}  // namespace
}  // namespace gnomon
