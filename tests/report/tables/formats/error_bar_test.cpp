#include "report/tables/formats/error_bar.h"

#include <gmock/gmock.h>

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const ErrorBar whole{0.04, 0.01, 0.03, 0.005, compare::Interval{0.02, 0.08}, 0.1};

TEST(ErrorBar, StandsToScale) {
  const std::string svg = htmlErrorBar(whole).text();
  EXPECT_THAT(svg, HasSubstr("class=\"shadow\" x=\"0.00\" y=\"4\" width=\"100.00\""));
  EXPECT_THAT(svg, HasSubstr("class=\"light\" x=\"100.00\" y=\"4\" width=\"300.00\""));
  EXPECT_THAT(svg, HasSubstr("class=\"truth\" x=\"350.00\" y=\"1\" width=\"100.00\""));
  EXPECT_THAT(svg, HasSubstr("<line x1=\"200.00\" x2=\"800.00\""));
}

TEST(ErrorBar, LeavesOutWhatIsNotKnown) {
  ErrorBar bar = whole;
  bar.interval.reset();
  bar.uncertainty.reset();
  EXPECT_THAT(htmlErrorBar(bar).text(), Not(HasSubstr("<line")));
  EXPECT_THAT(htmlErrorBar(bar).text(), Not(HasSubstr("truth")));
  bar.scale = 0;
  EXPECT_TRUE(htmlErrorBar(bar).empty());
}

}  // namespace
}  // namespace gnomon::report
