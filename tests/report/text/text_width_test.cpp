#include "report/text/text_width.h"

#include <gtest/gtest.h>

namespace gnomon::report {
namespace {

TEST(TextWidth, CountsTerminalColumns) {
  EXPECT_EQ(displayWidth(""), 0U);
  EXPECT_EQ(displayWidth("shadow"), 6U);
  EXPECT_EQ(displayWidth("κ ≥ 30°"), 7U);
  EXPECT_EQ(displayWidth("影"), 2U);       // wide
  EXPECT_EQ(displayWidth("e\u0301"), 1U);  // e and a combining accent
}

TEST(TextWidth, FitsExactly) {
  EXPECT_EQ(fitLeft("ab", 4), "ab  ");
  EXPECT_EQ(fitRight("ab", 4), "  ab");
  EXPECT_EQ(fitLeft("abcd", 4), "abcd");
  EXPECT_EQ(fitLeft("abcde", 4), "abc…");
  EXPECT_EQ(fitLeft("30° sun", 4), "30°…");
  EXPECT_EQ(fitRight("–", 3), "  –");
  EXPECT_EQ(fitLeft("影影影", 4), "影… ");
  EXPECT_EQ(fitLeft("ab", 0), "");
  EXPECT_EQ(fitLeft("ab", 1), "…");
}

TEST(TextWidth, NothingCanMoveTheCursor) {
  EXPECT_EQ(fitLeft("a\x1b[2Jb", 6), "a?[2Jb");
  EXPECT_EQ(fitLeft("a\nb", 3), "a?b");
  EXPECT_EQ(fitLeft(std::string("a\0b", 3), 3), "a?b");
  EXPECT_EQ(fitLeft("a\xff", 2), "a\uFFFD");
  EXPECT_EQ(fitLeft("a\xe2\x82", 4), "a\uFFFD\uFFFD ");  // cut within a character
}

TEST(TextWidth, WrapsAtSpaces) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(wrapText("one two three", 7), (Lines{"one two", "three"}));
  EXPECT_EQ(wrapText("one two three", 6), (Lines{"one", "two", "three"}));
  EXPECT_EQ(wrapText("  much   space ", 20), (Lines{"much space"}));
  EXPECT_EQ(wrapText("unbreakable", 4), (Lines{"unbr", "eaka", "ble"}));
  EXPECT_EQ(wrapText("a unbreakable", 4), (Lines{"a", "unbr", "eaka", "ble"}));
  EXPECT_EQ(wrapText("", 4), Lines{});
  EXPECT_EQ(wrapText("   ", 4), Lines{});
}

}  // namespace
}  // namespace gnomon::report
