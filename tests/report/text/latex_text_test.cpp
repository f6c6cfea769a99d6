#include "report/text/latex_text.h"

#include <gmock/gmock.h>

namespace gnomon::report {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(EscapeLatex, EscapesEachOfItsOwn) {
  EXPECT_EQ(escapeLatex("\\ & % $ # _ { } ~ ^"),
            "\\textbackslash{} \\& \\% \\$ \\# \\_ \\{ \\} \\textasciitilde{} "
            "\\textasciicircum{}");
  EXPECT_EQ(escapeLatex("30° – é 影\n"), "30$^\\circ$ -- é 影 ");
}

TEST(EscapeLatex, NeedsNoEncodingOfItsOwn) {
  EXPECT_EQ(escapeLatex("\"a\"|b"), "\\char34{}a\\char34{}\\textbar{}b");
}

TEST(BreakableParts, EndBehindSpacesHyphensAndTheirLike) {
  EXPECT_THAT(breakableParts("sloan-cohen, 32 azimuths"),
              ElementsAre("sloan-", "cohen, ", "32 ", "azimuths"));
  EXPECT_THAT(breakableParts("a/b_c:--d"), ElementsAre("a/", "b_", "c:--", "d"));
  EXPECT_THAT(breakableParts("-x"), ElementsAre("-", "x"));
  EXPECT_THAT(breakableParts(""), IsEmpty());
}

/// The widths that TeX tells of cmr9, in units of its 9 points: its characters are wider for their
/// size than those of cmr10 and of Times.
TEST(LatexWidth, BoundsComputerModern) {
  EXPECT_GE(latexWidth("resampled-horizon"), 73.586 / 9);
  EXPECT_GE(latexWidth("10.25–12.61"), 46.764 / 9);
  EXPECT_GE(latexWidth("Memory"), 33.426 / 9);
  EXPECT_GE(latexWidth("a a"), 12.334 / 9);
  EXPECT_GE(latexWidth("mW…"), (7.709 + 9.506 + 12.334) / 9);
  EXPECT_LE(latexWidth("resampled-horizon"), 1.15 * 73.586 / 9);
}

}  // namespace
}  // namespace gnomon::report
