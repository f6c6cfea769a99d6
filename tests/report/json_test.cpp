#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <limits>
#include <sstream>

#include "common/error.h"
#include "report/json/mask_comparison.h"
#include "report/json/results_json.h"
#include "report/json/summary_json.h"
#include "report/sample_record.h"
#include "report/terminal_page.h"
#include "study/judge/gates.h"
#include "study/record/record.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::report {
namespace {

using nlohmann::ordered_json;
using test::sampleRecord;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

study::StudyRecord recordWithPanel() {
  study::StudyRecord record = sampleRecord();
  using Kind = study::PictureRecord::Kind;
  record.panels = {{"camera",
                    "elevation 15°",
                    64,
                    48,
                    {{Kind::shaded, "best", "a", "images/a.png"},
                     {Kind::difference, "best", "b", "images/b.png"},
                     {Kind::displaced, "truth", "c", "images/c.png"}}}};
  return record;
}

ordered_json written(const study::StudyRecord& record) {
  return ordered_json::parse(summaryJson(record));
}

std::vector<std::string> keysOf(const ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

using Keys = std::vector<std::string>;

TEST(SummaryJson, ValuesSurviveTheTrip) {
  const study::StudyRecord record = recordWithPanel();
  const ordered_json json = written(record);
  EXPECT_EQ(json["study"]["title"], record.title);
  EXPECT_EQ(json["study"]["command"], record.command);
  EXPECT_EQ(json["truth"]["micro_triangles"], 2'000'000);
  EXPECT_EQ(json["truth"]["step_texels"], 0.125);
  EXPECT_EQ(json["undefined_samples"], 12);
  ASSERT_EQ(json["results"].size(), record.results.size());
  const ordered_json& first = json["results"][0];
  EXPECT_EQ(first["light"], "elevation 15°");
  EXPECT_EQ(first["samples"], 1000);
  EXPECT_EQ(first["tp"], 230);
  EXPECT_EQ(first["fp"], 80);
  EXPECT_EQ(first["fn"], 20);
  EXPECT_EQ(first["tn"], 670);
  EXPECT_EQ(first["error_rate"].get<double>(), 0.1);
  EXPECT_EQ(first["iou"].get<double>(), 230.0 / 330);
  EXPECT_TRUE(first["undefined"].empty());
  EXPECT_EQ(first["assd"], 10);
  EXPECT_EQ(first["hd95"], 40);
  EXPECT_EQ(first["boundary_iou_1"], 0.5);
  EXPECT_EQ(first["surface_dice_4"], 0.5);
  EXPECT_EQ(first["shadow_length_ratio"], 1.8);
  EXPECT_EQ(first["shadow_length_q1"], 0.5);
  EXPECT_EQ(first["shadow_length_q3"], 2.0);
  EXPECT_EQ(first["shadow_runs"], 400);
  EXPECT_EQ(json["truth"]["flips"][0]["length_error"], 0.01);
  EXPECT_EQ(json["truth"]["flips"][0]["boundaries"]["assd"], 0.25);
  EXPECT_EQ(json["truth"]["flips"][0]["boundaries"]["surface_dice_1"], 0.75);
  EXPECT_TRUE(json["truth"]["flips"][0]["boundaries"]["undefined"].empty());
  EXPECT_EQ(json["cost"][0]["frame_ms"], 1.25);
  EXPECT_TRUE(json["cost"][1]["frame_ms"].is_null());
  EXPECT_EQ(json["panels"][0]["pictures"][2]["kind"], "displaced");
  EXPECT_EQ(json["claims"][0]["verdict"], "held");
  EXPECT_EQ(json["claims"][1]["verdict"], "failed");
  EXPECT_EQ(json["claims"][2]["verdict"], "not distinguishable");
  EXPECT_EQ(json["claims"][3]["verdict"], "not evaluated");
}

TEST(SummaryJson, AClaimTellsHowItFaresOverTheCases) {
  study::StudyRecord record = sampleRecord();
  record.claims[0].spread =
      study::ClaimSpread{27,      25,
                         1,       1,
                         "ratio", study::Quartiles{0.25, 0.375, 0.5, 0.625, 0.75},
                         true,    study::Verdict::notDistinguishable};
  record.claims[1].spread = study::ClaimSpread{2, 0, 1, 1, "value", {}, false};
  const ordered_json claims = written(record)["claims"];
  EXPECT_EQ(
      claims[0]["spread"].dump(),
      R"({"cases":27,"held":25,"failed":1,"equal":0,"not_distinguishable":1,"no_interval":0,"intervals":true,)"
      R"("together":"not distinguishable","quantity":"ratio","least":0.25,"quartile_1":0.375,"median":0.5,"quartile_3":0.625,)"
      R"("most":0.75})");
  EXPECT_FALSE(claims[1]["spread"]["intervals"]);
  EXPECT_TRUE(claims[1]["spread"]["median"].is_null());
  EXPECT_TRUE(claims[1]["spread"]["together"].is_null());
  EXPECT_TRUE(claims[2]["spread"].is_null());
}

TEST(SummaryJson, SettingsAreTheStudysOwnAndInputsHaveTheirHashes) {
  study::StudyRecord record = sampleRecord();
  record.reproduction = {
      "sample.toml",
      toml::parse("[relief]\nheight = 0.1\ninvert = false\nrepeats = [2, 1.5]\n[[light]]\nname = "
                  "'a'\n[[light]]\nname = 'b'\n"),
      {{study::InputRecord::Kind::mesh, "../cage.obj", "00ff"},
       {study::InputRecord::Kind::shader, "shaders/common/mask.frag", "11ee"}}};
  const ordered_json study = written(record)["study"];
  EXPECT_EQ(study["copy"], "sample.toml");
  EXPECT_EQ(study["settings"]["relief"]["height"].get<double>(), 0.1);
  EXPECT_EQ(study["settings"]["relief"]["invert"], false);
  EXPECT_EQ(study["settings"]["relief"]["repeats"], (ordered_json{2, 1.5}));
  EXPECT_TRUE(study["settings"]["relief"]["repeats"][0].is_number_integer());
  EXPECT_EQ(study["settings"]["light"][1]["name"], "b");
  ASSERT_EQ(study["inputs"].size(), 2U);
  EXPECT_EQ(keysOf(study["inputs"][0]), (Keys{"kind", "file", "sha256"}));
  EXPECT_EQ(study["inputs"][0]["kind"], "mesh");
  EXPECT_EQ(study["inputs"][1]["kind"], "shader");
}

TEST(SummaryJson, AReferenceThatFailsFailsTheRun) {
  study::StudyRecord record = sampleRecord();
  record.judgements.pop_back();
  EXPECT_EQ(written(record)["status"], "pass");
  EXPECT_TRUE(written(record)["baseline"].is_null());
  record.baseline = "reference/sample.json";
  const study::Gate gate = study::referenceGate(
      {"best", "elevation 15°", "camera", "all", "error_rate", {}, {}}, {0.004, 0.001, 0.002});
  record.judgements.push_back(study::judge(gate, {"error_rate", 0.01, {}}));
  const ordered_json json = written(record);
  EXPECT_EQ(json["status"], "fail");
  EXPECT_EQ(json["baseline"], "reference/sample.json");
  EXPECT_EQ(keysOf(json["references"][0]),
            (Keys{"method", "light", "view", "answer", "metric", "committed", "value", "minimum",
                  "maximum", "verdict", "reason"}));
  EXPECT_EQ(json["references"][0]["verdict"], "fail");
  EXPECT_EQ(json["references"][0]["committed"], 0.004);
  record.judgements.pop_back();
  record.problems = {{"baseline", ExitStatus::badInput, "reference/sample.json: missing"}};
  EXPECT_EQ(written(record)["status"], "fail");
  EXPECT_EQ(keysOf(written(record)["problems"][0]), (Keys{"part", "message"}));
  record.problems.clear();
  record.judgements.clear();
  EXPECT_EQ(written(record)["status"], "not judged");
}

TEST(SummaryJson, UndefinedIsNullWithAReason) {
  const ordered_json json = written(sampleRecord());
  const ordered_json& lit = json["results"][1];
  ASSERT_EQ(lit["region"], "lit");
  EXPECT_TRUE(lit["fnr"].is_null());
  EXPECT_EQ(lit["undefined"].value("fnr", ""), "the truth has no shadow");
  EXPECT_FALSE(lit["undefined"].contains("error_rate"));
  const ordered_json& distant = json["results"][2];
  using enum compare::MetricKind;
  for (const compare::MetricId id : compare::metricsOfKinds({rate, boundary, length})) {
    const std::string name(id.name());
    EXPECT_TRUE(distant[name].is_null()) << name;
    EXPECT_EQ(distant["undefined"].value(name, ""),
              id.kind() == rate ? "no samples" : "measured over all samples together only")
        << name;
  }
  EXPECT_TRUE(json["thresholds"][1]["value"].is_null());
  EXPECT_TRUE(json["thresholds"][1]["maximum"].is_null());
}

TEST(SummaryJson, EmptyListsAreListsAndNotNull) {
  const ordered_json json = written(study::StudyRecord{});
  for (const char* key :
       {"methods", "results", "cost", "timings", "thresholds", "claims", "panels"}) {
    EXPECT_TRUE(json[key].is_array()) << key;
  }
}

TEST(SummaryJson, RefusesNumbersThatAreNotFinite) {
  using Spoil = void (*)(study::StudyRecord&, double);
  constexpr Spoil spoils[] = {
      [](study::StudyRecord& record, double bad) { record.truth.uncertainty = bad; },
      [](study::StudyRecord& record, double bad) { record.truth.flips[1].flipRate = bad; },
      [](study::StudyRecord& record, double bad) { record.truth.flips[1].lengthError = bad; },
      [](study::StudyRecord& record, double bad) { record.results[0].lengths->ratio = bad; },
      [](study::StudyRecord& record, double bad) { record.results[0].boundaries[0].value = bad; },
      [](study::StudyRecord& record, double bad) {
        record.truth.flips[1].boundaries[1].value = bad;
      },
      [](study::StudyRecord& record, double bad) { record.truth.stepTexels = bad; },
      [](study::StudyRecord& record, double bad) { record.results[0].counts.truePositive = bad; },
      [](study::StudyRecord& record, double bad) { record.timings[0].seconds = bad; },
      [](study::StudyRecord& record, double bad) { record.cost[0].frameMs = bad; },
      [](study::StudyRecord& record, double bad) { record.judgements[0].value = bad; },
      [](study::StudyRecord& record, double bad) { record.judgements[0].gate.maximum = bad; }};
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const Spoil spoil : spoils) {
      study::StudyRecord record = sampleRecord();
      spoil(record, bad);
      EXPECT_THROW(summaryJson(record), InternalError);
    }
  }
}

TEST(SummaryJson, BytesThatAreNoUtf8DoNotStopIt) {
  study::StudyRecord record = sampleRecord();
  record.file = "scenes/\xff.toml";
  EXPECT_EQ(written(record)["study"]["file"], "scenes/\uFFFD.toml");
}

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

study::Gate sampleGate(compare::MetricId metric, const study::Reference& reference) {
  study::Gate row{"a, b", "elevation 30°", "camera", "", metric, {}, {}};
  row.step = "sample/1";
  return study::referenceGate(row, reference);
}

study::Baseline sampleBaseline() {
  return {
      "sample",
      false,
      {"0.1.0", "0123abc", "a cpu", 8, "a \"renderer\"", "4.5", "3.13.5", "3.5.0", "wall clock"},
      {{"first \"values\"\nof all", "0.0.9", "000"}, {"a better bake", "0.1.0", "0123abc"}},
      {sampleGate("error_rate", {0.1, 0.0125, 0.025}),
       sampleGate("prevalence", {1.0 / 3, 0, 0.001})}};
}

class BaselineFile : public TemporaryFolder {
 protected:
  study::Baseline read(const std::string& text) {
    std::ofstream(file("sample.json"), std::ios::binary) << text;
    return readBaseline(file("sample.json"));
  }
  /// The message, without the folder.
  std::string failure(const std::string& text) {
    const std::string message = messageOf<InputError>([&] { (void)read(text); });
    const std::string prefix = folder().string() + "/";
    EXPECT_TRUE(message.starts_with(prefix)) << message;
    return message.substr(std::min(prefix.size(), message.size()));
  }
  std::string failureWith(const char* pointer, const nlohmann::json& value) {
    nlohmann::json json = nlohmann::json::parse(baselineJson(sampleBaseline()));
    json.at(nlohmann::json::json_pointer(pointer)) = value;
    return failure(json.dump());
  }
};

TEST_F(BaselineFile, IsReadBackAsItWas) {
  const study::Baseline baseline = read(baselineJson(sampleBaseline()));
  EXPECT_EQ(baselineJson(baseline), baselineJson(sampleBaseline()));
  EXPECT_EQ(baseline.study, "sample");
  EXPECT_FALSE(baseline.quick);
  EXPECT_EQ(baseline.environment.glRenderer, "a \"renderer\"");
  ASSERT_EQ(baseline.history.size(), 2U);
  EXPECT_EQ(baseline.history.at(0).text, "first \"values\"\nof all");
  EXPECT_EQ(baseline.gates, sampleBaseline().gates) << "to the last bit";
  study::Baseline quick = sampleBaseline();
  quick.quick = true;
  EXPECT_TRUE(read(baselineJson(quick)).quick);
}

// Of two values of one key readers take the first or the last: a hand-edited limit would not hold.
TEST_F(BaselineFile, AKeyStandsOnce) {
  const std::string text = baselineJson(sampleBaseline());
  const auto doubled = [&](const std::string& part) {
    std::string twice = text;
    twice.insert(twice.find(part), part + ",\n");
    return failure(twice);
  };
  const auto line = [&](const std::string& part) {
    return 2 + std::count(text.begin(), text.begin() + static_cast<long>(text.find(part)), '\n');
  };
  for (const std::string part : {"\"form\": \"full\"", "\"tolerance\":0.025"}) {
    const std::string key = part.substr(0, part.find(':'));
    EXPECT_EQ(doubled(part), "sample.json:" + std::to_string(line(part)) + ": " + key +
                                 ": a second time in one object, one expected");
  }
  EXPECT_EQ(failure("{\"a\": {\"b\": 1}, \"\\u0061\": 2}"),
            "sample.json:1: \"a\": a second time in one object, one expected")
      << "however it is spelled";
}

TEST_F(BaselineFile, HasALineForEachValueAndNothingOfTheMachine) {
  const std::string text = baselineJson(sampleBaseline());
  EXPECT_THAT(text,
              HasSubstr("\n    {\"study\":\"sample/1\",\"method\":\"a, b\",\"view\":\"camera\","
                        "\"light\":\"elevation "
                        "30°\",\"answer\":\"drawn\",\"metric\":\"error_rate\",\"value\":0.1,"
                        "\"spread\":0.0125,\"tolerance\":0.025},\n"));
  EXPECT_THAT(text, EndsWith("]\n}\n"));
  study::Baseline elsewhere = sampleBaseline();
  elsewhere.environment.threads = 1;
  elsewhere.environment.cpu = "another";
  elsewhere.environment.frameClock = "GL timer queries";
  EXPECT_EQ(baselineJson(elsewhere), text);
}

TEST_F(BaselineFile, ThatIsNoJsonIsRefusedWithItsLine) {
  std::string text = baselineJson(sampleBaseline());
  const std::size_t at = text.find("\"values\"");
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
  text.insert(at, "?");
  EXPECT_THAT(failure(text), HasSubstr("sample.json:" + std::to_string(line) + ": no JSON: "));
  EXPECT_THAT(failure(""), HasSubstr("sample.json:1: no JSON: "));
  EXPECT_THAT(failure(baselineJson(sampleBaseline()).substr(0, 300)), HasSubstr(": no JSON: "));
  EXPECT_THAT(failure("{\"values\": 1e999}"), HasSubstr(": no JSON: "));
}

TEST_F(BaselineFile, WithAKeyThatIsMissingOrWrongIsRefused) {
  EXPECT_EQ(failure("[]"), "sample.json: schema: missing, a string expected");
  EXPECT_EQ(failure("{}"), "sample.json: schema: missing, a string expected");
  EXPECT_EQ(failureWith("/schema", "gnomon-baseline/1"),
            "sample.json: schema: \"gnomon-baseline/1\" found, \"gnomon-baseline/2\" expected");
  EXPECT_EQ(failureWith("/form", "half"),
            "sample.json: form: \"half\" found, full or quick expected");
  EXPECT_EQ(failureWith("/form", "full\nor quick"),
            "sample.json: form: \"full or quick\" found, full or quick expected");
  EXPECT_EQ(failureWith("/values", 3), "sample.json: values: number found, a list expected");
  EXPECT_EQ(failureWith("/values/1", nullptr),
            "sample.json: values.1.study: missing, a string expected");
  EXPECT_EQ(failureWith("/values/1/answer", "both"),
            "sample.json: values.1.answer: \"both\" found, drawn or test expected");
  EXPECT_EQ(failureWith("/values/1/value", "0.1"),
            "sample.json: values.1.value: string found, a number expected");
  EXPECT_EQ(failureWith("/values/1/value", nullptr),
            "sample.json: values.1.value: null found, a number expected");
  EXPECT_EQ(failureWith("/history/0/reason", 1),
            "sample.json: history.0.reason: number found, a string expected");
  EXPECT_EQ(failureWith("/environment", "x"),
            "sample.json: environment: string found, an object expected");
}

TEST_F(BaselineFile, WithValuesThatMakeNoSenseIsRefused) {
  EXPECT_THAT(failureWith("/values/0/metric", "eror_rate"), HasSubstr("values.0.metric: \"eror_"));
  EXPECT_EQ(failureWith("/values/0/value", 3.5),
            "sample.json: values.0.value: 3.5 found, 0 to 1 expected");
  EXPECT_THAT(failureWith("/values/1/value", -0.1), HasSubstr("-0.1 found, 0 to 1 expected"));
  study::Baseline lengths = sampleBaseline();
  lengths.gates.at(0) = sampleGate("shadow_length_ratio", {1.5, 0.0125, 0.025});
  EXPECT_EQ(study::referenceOf(read(baselineJson(lengths)).gates.at(0)).committed, 1.5);
  lengths.gates.at(0) = sampleGate("shadow_length_ratio", {-1, 0.0125, 0.025});
  EXPECT_THAT(failure(baselineJson(lengths)), HasSubstr("-1 found, at least 0 expected"));
  EXPECT_THAT(failureWith("/values/0/spread", -1), HasSubstr("values.0.spread: -1 found"));
  EXPECT_EQ(failureWith("/values/0/tolerance", 0.0125),
            "sample.json: values.0.tolerance: 0.0125 found, more than the spread 0.0125 expected");
  EXPECT_EQ(
      failureWith("/values/0/tolerance", 0.026),
      "sample.json: values.0.tolerance: 0.026 found, at most 0.025 expected: twice the spread, "
      "or 0.0015");
  EXPECT_THAT(failureWith("/values/0/tolerance", 1e9), HasSubstr("at most 0.025 expected"));
  EXPECT_THAT(failureWith("/values/1/metric", "error_rate"),
              HasSubstr("values.1.metric: a second value"));
}

TEST(BaselineJson, RefusesWhatIsNoNumber) {
  study::Baseline baseline = sampleBaseline();
  baseline.gates.at(0) =
      sampleGate("error_rate", {std::numeric_limits<double>::quiet_NaN(), 0, 0.001});
  EXPECT_THROW((void)baselineJson(baseline), InternalError);
}

}  // namespace
}  // namespace gnomon::report
