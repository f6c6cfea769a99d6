#include "study/record/record_fields.h"

#include <gtest/gtest.h>

namespace gnomon::study {
namespace {

/// A record with something in every list, no two members alike.
StudyRecord sample() {
  StudyRecord record;
  record.name = "small/5";
  record.title = "a title";
  record.environment.cpu = "a processor";
  record.environment.threads = 7;
  record.radius = {12.5, "a rule"};
  record.truth.microTriangles = 1'000'003;
  record.truth.flips = {{"camera", "evening", 0.25, 0.5, {}}};
  for (const compare::MetricId id : compare::metricsOfKinds({compare::MetricKind::boundary})) {
    record.truth.flips[0].boundaries.push_back({id, 0.125, {}});
  }
  record.truth.flips[0].boundaries[0] = {"assd", {}, compare::boundaryReasons()[0]};
  record.methods = {{"ours", "onoue-2004", "title", "citation", {"curvature", "circle"}}};
  record.refused = {{"theirs", "a reason"}};
  ResultRecord result;
  result.method = "ours";
  result.counts = {1, 2, 3, 4, 10};
  result.lengths = compare::ShadowLengths{100, 1.5, {}, 2.5, 3.5};
  result.boundaries = record.truth.flips[0].boundaries;
  result.answer = Answer::test;
  record.results = {result, result};
  record.confidence = {{"ours", "camera", "all", 0.5, compare::Interval{0.25, 0.75}, "", 144, 8}};
  record.differences = {
      {"camera", "all", "ours", "theirs", -0.5, {}, "too few", 0.125, DifferenceVerdict::worse}};
  record.bins = {{"ours", "camera", "all", "axis", {}, 0.5, {1, 1, 1, 1, 4}}};
  record.cost = {{"ours", 1, 2, 3, 4.5, 4, 17.5, 2, "2026-01-01"}};
  record.timings = {{"truth", 1.25}};
  Gate gate{"ours",       "evening", "camera", "all",
            "error_rate", {},        0.9,      Threshold{12, false, {}},
            Answer::test, "small/5"};
  record.judgements = {{gate, GateVerdict::failed, 0.95, "why"}};
  record.problems = {{"method", ExitStatus::internal, "a message"}};
  record.claims = {{"text",
                    "source",
                    Verdict::held,
                    "detail",
                    ClaimSpread{3, 2, 1, 1, "ratio", Quartiles{1, 2, 3, 4, 5}, true, Verdict::held},
                    {"ours", "theirs"}}};
  const BudgetShare share{0.5, compare::Interval{0, 1}, "none",
                          DifferenceVerdict::notDistinguishable};
  record.budgets = {{"ours",
                     "camera",
                     "all",
                     0.1,
                     200,
                     share,
                     {{"cause", "change", share, share}},
                     {{"global", share}, {"other", share}},
                     {{0.1, 0.2, 0.3}},
                     {{0.4, 0.5, 0.6}}}};
  PictureRecord picture;
  picture.kind = PictureRecord::Kind::difference;
  picture.embedded = std::string("\0\1binary", 8);
  picture.layers = 1;
  picture.truth = TruthFilesRecord{"m", "r", "", "w"};
  picture.worst = {{1, 2, 64, 0.5, "answer", "right"}};
  record.panels = {{"camera", "evening", 64, 32, {picture}, {{"lit", "dark"}}}};
  record.notices = {"a notice", ""};
  record.undefinedSamples = 5;
  record.cache = cache::CacheCounts{1, 2, 3};
  return record;
}

TEST(RecordFields, ComeBackToTheBit) {
  const StudyRecord record = sample();
  const std::string bytes = cache::bytesOf(record);
  const auto read = cache::valueOf<StudyRecord>(bytes);
  EXPECT_EQ(cache::bytesOf(read), bytes);
  EXPECT_EQ(read.name, "small/5");
  EXPECT_EQ(read.truth.flips[0].boundaries[0].reason, compare::boundaryReasons()[0]);
  EXPECT_EQ(read.truth.flips[0].boundaries[1].name(), "hd95");
  EXPECT_EQ(read.truth.flips[0].boundaries[1].value, 0.125);
  EXPECT_EQ(read.results[1].lengths, record.results[1].lengths);
  EXPECT_EQ(read.results[1].answer, Answer::test);
  EXPECT_EQ(read.judgements[0].gate, record.judgements[0].gate);
  EXPECT_EQ(read.judgements[0].value, 0.95);
  EXPECT_EQ(read.panels[0].pictures[0].embedded, record.panels[0].pictures[0].embedded);
  EXPECT_EQ(read.panels[0].pictures[0].truth->weights, "w");
  EXPECT_EQ(read.panels[0].pictures[0].worst[0].truth, "right");
  EXPECT_EQ(read.panels[0].layers, record.panels[0].layers);
  EXPECT_EQ(read.budgets[0].backward[0].falseLight, 0.6);
  EXPECT_EQ(read.claims[0].spread->quartiles->most, 5);
  EXPECT_EQ(read.differences[0].verdict, DifferenceVerdict::worse);
  EXPECT_EQ(read.cache->damaged, 3U);
}

TEST(RecordFields, EveryMemberIsInTheBytes) {
  const std::string bytes = cache::bytesOf(sample());
  const auto differs = [&](const auto& change) {
    StudyRecord record = sample();
    change(record);
    return cache::bytesOf(record) != bytes;
  };
  EXPECT_TRUE(differs([](StudyRecord& r) { r.undefinedSamples = 6; }));
  EXPECT_TRUE(differs([](StudyRecord& r) { r.truth.askedStepTexels = 6; }));
  EXPECT_TRUE(differs([](StudyRecord& r) { r.problems[0].status = ExitStatus::noGl; }));
  EXPECT_TRUE(differs([](StudyRecord& r) { r.confidence[0].blockSide = 6; }));
  EXPECT_TRUE(differs([](StudyRecord& r) { r.bins[0].high = 6; }));
  EXPECT_TRUE(differs([](StudyRecord& r) { r.referencePictures.emplace_back(); }));
}

TEST(RecordFields, BytesThatAreCutAreNoRecord) {
  const std::string bytes = cache::bytesOf(sample());
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    EXPECT_THROW((void)cache::valueOf<StudyRecord>(std::string_view(bytes).substr(0, size)),
                 cache::DamagedBytes);
  }
}

TEST(RecordFields, OnlyThresholdsAreKept) {
  StudyRecord record = sample();
  record.judgements[0].gate.origin = Reference{};
  EXPECT_THROW((void)cache::bytesOf(record), InternalError);
}

}  // namespace
}  // namespace gnomon::study
