#include "report/json/baseline_json.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::report {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

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
