#include "report/page/terminal_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "common/error.h"
#include "report/sample_record.h"
#include "support/lines.h"

namespace gnomon::report {
namespace {

using test::sampleRecord;

/// Columns of a line whose only characters are narrow or CJK: counted from the lead bytes.
std::size_t columnsOf(const std::string& line) {
  std::size_t columns = 0;
  for (const char c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) == 0x80) continue;              // continues a character
    columns += byte >= 0xE3 && byte <= 0xE9 ? 2 : 1;  // U+3000 to U+9FFF are wide
  }
  return columns;
}

void expectFits(const std::string& text) {
  for (const std::string& line : test::linesOf(text)) {
    EXPECT_LE(columnsOf(line), 100U) << line;
  }
}

std::string lineWith(const std::string& text, const std::string& part) {
  for (const std::string& line : test::linesOf(text)) {
    if (line.find(part) != std::string::npos) return line;
  }
  return "(no line with " + part + ")";
}

TEST(TerminalReport, ShowsWhatTheRecordHolds) {
  const std::string text = terminalReport(sampleRecord(), false);
  EXPECT_NE(text.find("camera · elevation 15° (truth ± 0.20)"), std::string::npos) << text;
  EXPECT_NE(text.find("camera · elevation 30° (truth ± 0.40)"), std::string::npos);
  EXPECT_EQ(lineWith(text, "rough"),
            "  rough, \"old\"  10.00  12.00          8.00         2.00  69.70   9.33    1.80");
  EXPECT_EQ(lineWith(text, "  best"),
            "  best           1.00   3.00          0.50         0.50  96.08   1.33    1.05");
}

TEST(TerminalReport, ManyLightsMakeOneBlockAView) {
  const std::string few = terminalReport(sampleRecord(3), false);
  const std::string many = terminalReport(sampleRecord(4), false);
  EXPECT_NE(few.find("camera · elevation 45° (truth ± 0.40)"), std::string::npos) << few;
  EXPECT_NE(many.find("camera · 4 lights (truth ± 0.40 at most)"), std::string::npos) << many;
  EXPECT_EQ(many.find("camera · elevation"), std::string::npos);
  EXPECT_NE(lineWith(many, "elevation 60°").find("rough"), std::string::npos);
  expectFits(few);
  expectFits(many);
}

TEST(TerminalReport, FitsWhateverTheLabels) {
  for (const int lights : {1, 3, 5}) {
    study::StudyRecord record = sampleRecord(lights);
    std::string label = "影の長さ";
    while (label.size() < 300) label += " 影 and a very long label";
    record.title = record.source = label;
    for (study::ResultRecord& result : record.results) {
      if (result.method == "best") result.method = label;
      result.light += label;
      result.view = label;
    }
    record.claims[0].text = record.claims[0].detail = label + std::string(150, 'x');
    record.judgements[1].gate.method = label;
    expectFits(terminalReport(record, false));
  }
}

TEST(TerminalReport, ColumnsStayAlignedUnderWideLabels) {
  study::StudyRecord record = sampleRecord(1);
  for (study::ResultRecord& result : record.results) {
    if (result.method == "best") result.method = "影の長さ";
  }
  record.truth.flips[0].flipRate = 0;  // no mark at the line's end
  const std::string text = terminalReport(record, false);
  EXPECT_EQ(columnsOf(lineWith(text, "影の")), columnsOf(lineWith(text, "close")));
  EXPECT_EQ(columnsOf(lineWith(text, "影の")), columnsOf(lineWith(text, "IoU  ")));
}

TEST(TerminalReport, ColoursOnlyWhenAsked) {
  EXPECT_EQ(terminalReport(sampleRecord(), false).find('\x1b'), std::string::npos);
  std::string coloured = terminalReport(sampleRecord(), true);
  EXPECT_NE(coloured.find("\x1b[32mheld"), std::string::npos);
  // Without its escape sequences it is the plain table.
  for (std::size_t at = 0; (at = coloured.find('\x1b', at)) != std::string::npos;) {
    coloured.erase(at, coloured.find('m', at) - at + 1);
  }
  EXPECT_EQ(coloured, terminalReport(sampleRecord(), false));
}

TEST(TerminalReport, SmallRecordsDoNotStopIt) {
  EXPECT_EQ(terminalReport(study::StudyRecord{}, false), "");
  study::StudyRecord record = sampleRecord();
  record.results.clear();
  EXPECT_NE(terminalReport(record, false).find("Claims"), std::string::npos);
}

TEST(TerminalReport, RefusesCountsThatAreNotFinite) {
  study::StudyRecord record = sampleRecord();
  record.results[0].counts.falsePositive = std::numeric_limits<double>::infinity();
  EXPECT_THROW(terminalReport(record, false), InternalError);
}

}  // namespace
}  // namespace gnomon::report
