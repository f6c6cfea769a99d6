#include "report/paper/paper_table.h"

#include <gmock/gmock.h>

#include "report/paper/chosen_methods.h"
#include "report/sample_record.h"
#include "report/tables/formats/latex_format.h"
#include "report/tables/ranked_table.h"
#include "study/judge/ranking.h"

namespace gnomon::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::SizeIs;

Table table() {
  const study::StudyRecord record = test::sampleRecord();
  return rankedTable(record, study::rankMethods(record));
}

std::vector<std::string> headsOf(const Table& of, Readers reader) {
  std::vector<std::string> heads;
  for (const std::size_t i : columnsFor(of, reader)) heads.push_back(heading(of.columns[i]));
  return heads;
}

TEST(PaperTable, HasTheChosenColumnsInItsOwnOrder) {
  EXPECT_THAT(headsOf(table(), inColumn),
              ElementsAre("Method", "Error", "95 %", "False shadow", "False light", "Memory, MB"));
  const Table chosen = withColumns(table(), {"frame_ms", "iou", "interval"});
  for (const Readers reader : {inColumn, onPaper}) {
    EXPECT_THAT(headsOf(chosen, reader), ElementsAre("Method", "95 %", "IoU", "Frame, ms"));
  }
  EXPECT_EQ(headsOf(chosen, asData), headsOf(table(), asData));
  EXPECT_EQ(headsOf(withColumns(table(), {"median"}), inColumn), headsOf(table(), inColumn))
      << "a column of other tables";
}

TEST(PaperTable, KnowsTheColumnsOfStudiesAndSuites) {
  EXPECT_THAT(paperColumnKeys(), IsSupersetOf({"error_rate", "interval", "false_shadow", "bytes",
                                               "mean", "percentile95", "ranks"}));
}

TEST(PaperTable, HasTheChosenRowsInItsOwnOrder) {
  const Table chosen = withRows(table(), {"close", "best", "nosuch"});
  ASSERT_THAT(chosen.rows, SizeIs(2));
  EXPECT_EQ(nameOf(chosen, chosen.rows[0]), "best");
  EXPECT_THAT(withRows(table(), {"nosuch"}).rows, SizeIs(3));
  EXPECT_THAT(latexTabular(chosen), Not(HasSubstr("rough")));
}

TEST(ChosenMethods, AreAllThatPlotsAreMadeOf) {
  study::StudyRecord record = test::sampleRecord();
  record.bins = {{"best", "camera", "all", "elevation", {}, 0, test::countsOf(10, 1, 0)},
                 {"close", "camera", "all", "elevation", {}, 0, test::countsOf(10, 1, 0)}};
  const study::StudyRecord chosen = withMethods(record, {"close"});
  ASSERT_THAT(chosen.methods, SizeIs(1));
  ASSERT_THAT(chosen.bins, SizeIs(1));
  EXPECT_EQ(chosen.bins[0].method, "close");
  EXPECT_THAT(chosen.cost, SizeIs(1));
  for (const study::ResultRecord& row : chosen.results) EXPECT_EQ(row.method, "close");
  EXPECT_EQ(chosen.truth.flips.size(), record.truth.flips.size());
  EXPECT_THAT(withMethods(record, {"nosuch"}).methods, SizeIs(3));
}

}  // namespace
}  // namespace gnomon::report
