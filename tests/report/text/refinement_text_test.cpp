#include "report/text/refinement_text.h"

#include <gmock/gmock.h>

#include "report/page/terminal_report.h"
#include "report/sample_record.h"
#include "report/tables/formats/html_format.h"
#include "report/tables/run_tables.h"

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

study::TruthRecord refinedTruth() {
  study::TruthRecord truth;
  truth.wantedUncertainty = 0.001;
  truth.refinement = {{1, 61'440, std::nullopt}, {0.5, 245'760, 0.0124}, {0.25, 983'040, 0.00083}};
  return truth;
}

TEST(RefinementText, NamesEveryLevel) {
  EXPECT_EQ(refinementText(refinedTruth()),
            "Refined until at most 0.1 % of the samples differ from the level before: step 1 "
            "(61\u202f440 micro-triangles), step 0.5 (245\u202f760 micro-triangles, 1.24 %), step "
            "0.25 (983\u202f040 micro-triangles, 0.083 %).");
}

TEST(RefinementText, IsEmptyWhereNothingWasAskedFor) {
  EXPECT_EQ(refinementText(study::TruthRecord{}), "");
  EXPECT_THAT(terminalReport(test::sampleRecord(), false), Not(HasSubstr("Refined")));
}

TEST(RefinementText, StandsInTheTerminalsTable) {
  study::StudyRecord record = test::sampleRecord();
  record.truth.wantedUncertainty = refinedTruth().wantedUncertainty;
  record.truth.refinement = refinedTruth().refinement;
  EXPECT_THAT(terminalReport(record, false), HasSubstr("Refined until at most 0.1 %"));
}

TEST(RefinementText, TheTableHasARowALevel) {
  const std::string table = htmlTable(refinementTable(refinedTruth().refinement)).text();
  EXPECT_THAT(table, HasSubstr("0.083"));
  EXPECT_THAT(table, HasSubstr("–"));
  EXPECT_THAT(table, HasSubstr("983\u202f040"));
}

TEST(RefinementText, StepsHaveTheDigitsTheyNeed) {
  EXPECT_EQ(stepText(0.25), "0.25");
  EXPECT_EQ(stepText(1.0 / 48), "0.02083");
}

}  // namespace
}  // namespace gnomon::report
