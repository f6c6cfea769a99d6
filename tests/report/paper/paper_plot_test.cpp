#include "report/paper_files.h"

#include <gmock/gmock.h>
#include <unistd.h>

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;

LinePlot plot(const std::string& label) {
  return {.name = "errors",
          .xLabel = "a_b & 50 % {x}",
          .yLabel = "error",
          .curves = {{label, "lc rgb '#0072b2' pt 7 ps 0.8 lw 2 dt 2", {{0, 1}, {1, -2}}}}};
}

TEST(PaperPdfs, AreOfTheirWidthAndTheSameBytes) {
  const std::string pdf = paperPdfs({plot("first")}, PaperWidth::column, 9).front();
  EXPECT_THAT(pdf, HasSubstr("/CreationDate (D:19700101000000"));
  // 84 and 178 mm are 238.1 and 504.6 of PDF's points.
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 238 "));
  EXPECT_THAT(paperPdfs({plot("first")}, PaperWidth::page, 9).front(),
              HasSubstr("/MediaBox [ 0 0 504 "));
  ::sleep(1);  // what a date would tell apart
  EXPECT_EQ(paperPdfs({plot("second"), plot("first")}, PaperWidth::column, 9).back(), pdf);
  EXPECT_TRUE(paperPdfs({}, PaperWidth::page, 9).empty());
}

TEST(PaperPdfs, HaveOneSizeOfTextAndTheLegendBelow) {
  const std::string commands = paperCommands(plot("first"), 7.5, 2);
  for (const char* part : {"set xtics font ',7.5'", "set ylabel font ',7.5'",
                           "set key outside bottom center horizontal", "maxcols 2"}) {
    EXPECT_THAT(commands, HasSubstr(part));
  }
}

}  // namespace
}  // namespace gnomon::report
