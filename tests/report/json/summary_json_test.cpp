#include "report/json/summary_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "common/error.h"
#include "report/sample_record.h"
#include "study/judge/baseline.h"
#include "study/record/result_metrics.h"

namespace gnomon::report {
namespace {

using nlohmann::ordered_json;
using test::sampleRecord;

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

TEST(SummaryJson, ARefinementIsThereWithAllItsLevels) {
  study::StudyRecord record = sampleRecord();
  record.truth.wantedUncertainty = 0.001;
  record.truth.refinement = {{1, 61'440, std::nullopt}, {0.5, 245'760, 0.0124}};
  const ordered_json truth = written(record)["truth"];
  EXPECT_EQ(truth["wanted_uncertainty"], 0.001);
  ASSERT_EQ(truth["refinement"].size(), 2U);
  EXPECT_EQ(keysOf(truth["refinement"][1]), (Keys{"step_texels", "micro_triangles", "flip_rate"}));
  EXPECT_TRUE(truth["refinement"][0]["flip_rate"].is_null());
  EXPECT_EQ(truth["refinement"][1]["flip_rate"], 0.0124);
  EXPECT_EQ(truth["refinement"][1]["micro_triangles"], 245'760);
}

TEST(SummaryJson, UndefinedIsNullWithAReason) {
  const ordered_json json = written(sampleRecord());
  const ordered_json& lit = json["results"][1];
  ASSERT_EQ(lit["region"], "lit");
  EXPECT_TRUE(lit["fnr"].is_null());
  EXPECT_EQ(lit["undefined"].value("fnr", ""), "the truth has no shadow");
  EXPECT_FALSE(lit["undefined"].contains("error_rate"));
  const ordered_json& distant = json["results"][2];
  for (const std::string_view name : study::pointLightMetricNames()) {
    EXPECT_TRUE(distant[std::string(name)].is_null()) << name;
    EXPECT_EQ(distant["undefined"].value(std::string(name), ""),
              study::isRate(name) ? "no samples" : "measured over all samples together only")
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
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    study::StudyRecord record = sampleRecord();
    record.truth.uncertainty = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.truth.flips[1].flipRate = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.truth.flips[1].lengthError = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.results[0].lengths->ratio = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.results[0].boundaries[0].value = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.truth.flips[1].boundaries[1].value = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.truth.stepTexels = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.results[0].counts.truePositive = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.timings[0].seconds = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.cost[0].frameMs = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.judgements[0].value = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
    record = sampleRecord();
    record.judgements[0].gate.maximum = bad;
    EXPECT_THROW(summaryJson(record), InternalError);
  }
}

TEST(SummaryJson, BytesThatAreNoUtf8DoNotStopIt) {
  study::StudyRecord record = sampleRecord();
  record.file = "scenes/\xff.toml";
  EXPECT_EQ(written(record)["study"]["file"], "scenes/\uFFFD.toml");
}

}  // namespace
}  // namespace gnomon::report
