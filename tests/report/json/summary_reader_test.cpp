#include "report/json/summary_json.h"

#include <gtest/gtest.h>

#include "common/error.h"
#include "compare/answer_metrics.h"
#include "report/sample_record.h"
#include "support/error_messages.h"

namespace gnomon::report {
namespace {

/// A record with what only some studies have.
study::StudyRecord fullRecord() {
  study::StudyRecord record = test::sampleRecord();
  record.reproduction.settings.insert("study", toml::table{{"suite", "suite-9"}});
  record.reproduction.inputs = {{{}, "a.toml", std::string(64, 'a')}};
  study::ResultRecord& soft = record.results.front();
  for (const compare::MetricId name : compare::metricsOfKinds({compare::MetricKind::share})) {
    soft.shares.push_back({name, 1.0 / 3, {}});
  }
  soft.shares.back() = {soft.shares.back().id, {}, compare::shareReasons().front()};
  soft.boundaries.front() = {compare::MetricId("assd"), {}, compare::boundaryReasons().front()};
  study::UncertaintyRecord& flip = record.truth.flips.front();
  flip.shares = soft.shares;
  flip.percentile99 = 0.1;
  flip.percentile999 = 0.2;
  flip.brightening = -0.01;
  record.problems = {{"method", ExitStatus::internal, "a message"}};
  record.notices = {"a notice"};
  return record;
}

Json summaryOf(const study::StudyRecord& record) {
  return Json::parse(summaryJson(record));
}

/// What is read tells the same again.
TEST(SummaryReader, ReadsEveryFigureToTheBit) {
  const study::StudyRecord record = fullRecord();
  const Json json = summaryOf(record);
  const study::StudyRecord found = readSummary(JsonReader(json, "summary.json", ""));
  const Json again = summaryOf(found);
  for (const char* key : {"status", "environment", "methods", "results", "confidence",
                          "differences", "bins", "cost", "thresholds", "problems", "notices"}) {
    EXPECT_EQ(again.at(key), json.at(key)) << key;
  }
  EXPECT_EQ(again.at("truth").at("flips"), json.at("truth").at("flips"));
  EXPECT_EQ(again.at("truth").at("uncertainty"), json.at("truth").at("uncertainty"));
  for (const char* key : {"name", "title", "source", "file", "command", "settings"}) {
    EXPECT_EQ(again.at("study").at(key), json.at("study").at(key)) << key;
  }
  EXPECT_EQ(found.reproduction.inputs.front().sha256, std::string(64, 'a'));
}

TEST(SummaryReader, NamesWhatIsDamaged) {
  Json json = summaryOf(fullRecord());
  json.at("results").at(0).at("tp") = -1;
  EXPECT_THAT(
      messageOf<InputError>([&] { (void)readSummary(JsonReader(json, "summary.json", "")); }),
      ::testing::HasSubstr("summary.json: results.0.tp: -1 found, a count expected"));
}

}  // namespace
}  // namespace gnomon::report
