#include "report/json/mask_comparison.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "common/error.h"
#include "report/text/text_width.h"
#include "study/judge/gates.h"
#include "support/error_messages.h"

namespace gnomon::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const Mask mask{2, 2, {Shade::lit, Shade::shadowed, Shade::none, Shade::lit}};

/// A third of the pixels wrong; iou is not defined.
MaskComparison sampleComparison() {
  MaskComparison comparison{{"mine.exr", mask, 3}, {"truth.png", mask, 0}};
  comparison.width = comparison.height = 2;
  comparison.withoutSample = 1;
  comparison.counts = {0, 1, 0, 2, 3};
  comparison.metrics = {{"error_rate", 1.0 / 3, {}}, {"iou", std::nullopt, "there is no shadow"}};
  return comparison;
}

/// With the gates error_rate ≤ 0.1, which fails, and iou ≤ 1, which is undefined.
MaskComparison judgedComparison() {
  MaskComparison comparison = sampleComparison();
  for (const compare::Metric& metric : comparison.metrics) {
    study::Gate gate;
    gate.metric = metric.id;
    gate.maximum = metric.id == "iou" ? 1 : 0.1;
    gate.origin = study::CompareOption{"--max"};
    comparison.judgements.push_back(study::judge(gate, metric));
  }
  return comparison;
}

TEST(MaskComparison, PassesOnlyWhereEveryGateDoes) {
  MaskComparison comparison = judgedComparison();
  EXPECT_FALSE(comparison.passed());
  comparison.judgements.pop_back();
  comparison.judgements[0].gate.maximum = 0.34;
  comparison.judgements[0] = study::judge(comparison.judgements[0].gate, comparison.metrics[0]);
  EXPECT_TRUE(comparison.passed());
  EXPECT_TRUE(sampleComparison().passed()) << "without a gate";
}

TEST(MaskComparison, JsonHoldsWhatWasFound) {
  const auto json = nlohmann::json::parse(maskComparisonJson(judgedComparison()));
  EXPECT_EQ(json.at("schema"), "gnomon-comparison/1");
  EXPECT_EQ(json.at("status"), "fail");
  EXPECT_EQ(
      json.at("candidate"),
      nlohmann::json(
          {{"file", "mine.exr"}, {"lit", 2}, {"shadowed", 1}, {"none", 1}, {"binarised", 3}}));
  EXPECT_TRUE(json.at("roi").is_null());
  EXPECT_EQ(json.at("samples"), 3);
  EXPECT_EQ(json.at("fp"), 1);
  EXPECT_EQ(json.at("error_rate"), 1.0 / 3);
  EXPECT_TRUE(json.at("iou").is_null());
  EXPECT_EQ(json.at("undefined").at("iou"), "there is no shadow");
  EXPECT_FALSE(json.at("undefined").contains("error_rate"));
  EXPECT_EQ(json.at("gates").at(0).at("maximum"), 0.1);
  EXPECT_EQ(json.at("gates").at(0).at("value"), 1.0 / 3);
  EXPECT_EQ(json.at("gates").at(0).at("passed"), false);
  EXPECT_TRUE(json.at("gates").at(1).at("value").is_null());
}

TEST(MaskComparison, TableFitsTheTerminalAndSaysWhy) {
  MaskComparison comparison = judgedComparison();
  comparison.candidate.file = std::string(150, 'm') + ".exr";
  const std::string table = maskComparisonTable(comparison, false);
  EXPECT_THAT(table, AllOf(HasSubstr("2 × 2 pixels: 3 compared, 1 without a sample"),
                           HasSubstr("3 by the threshold"), HasSubstr("33.3333 %"),
                           HasSubstr("there is no shadow"), HasSubstr("Gates: 0 of 2 met"),
                           HasSubstr("error_rate is 33.3333333333 %, at most 10 % allowed"),
                           HasSubstr("iou is undefined: there is no shadow, at most 100 % allowed"),
                           Not(HasSubstr("\033"))));
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(displayWidth(line), 100U) << line;
  EXPECT_THAT(maskComparisonTable(comparison, true), HasSubstr("\033"));
}

TEST(MaskComparison, ADifferenceIsNeverRoundedAway) {
  MaskComparison comparison = sampleComparison();
  comparison.metrics = {{"iou", 1 - 1e-9, {}}, {"error_rate", 1e-9, {}}};
  EXPECT_THAT(maskComparisonTable(comparison, false),
              AllOf(HasSubstr("99.9999999 %"), HasSubstr("1e-07 %")));
}

}  // namespace
}  // namespace gnomon::report
