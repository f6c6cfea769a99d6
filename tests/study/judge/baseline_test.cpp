#include "study/judge/gates.h"

#include <algorithm>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;

/// 1000 samples, 300 shadowed in the truth.
compare::Counts counts(double falseShadow, double falseLight) {
  return {300 - falseLight, falseShadow, falseLight, 700 - falseShadow, 1000};
}

ResultRecord row(const std::string& method, double falseShadow, double falseLight,
                 double lengthRatio = 1.1) {
  ResultRecord result{method, "dusk", "camera", "all", counts(falseShadow, falseLight)};
  result.lengths = compare::ShadowLengths{400, lengthRatio, 0.9, 1.2, 8.0};
  return result;
}

/// Truth's uncertainty 0.004, of lengths 0.03.
StudyRecord record(std::vector<ResultRecord> results, const std::string& name = "study") {
  StudyRecord study;
  study.name = name;
  study.truth.uncertainty = 0.004;
  study.truth.flips = {{"camera", "dusk", 0.004, 0.03}};
  study.results = std::move(results);
  return study;
}

Baseline baselineOf(const std::vector<StudyRecord>& steps) {
  return {"study", false, {}, {{"first", "1", ""}}, referenceGates(steps)};
}

const Judgement& judgementOn(const std::vector<Judgement>& judgements, compare::MetricId metric,
                             const std::string& method = "a") {
  const auto found =
      std::find_if(judgements.begin(), judgements.end(), [&](const Judgement& judgement) {
        return judgement.gate.metric == metric && judgement.gate.method == method;
      });
  if (found == judgements.end())
    throw std::runtime_error("no gate on " + std::string(metric.name()));
  return *found;
}

/// The verdict on one metric of a run against the baseline of another.
GateVerdict verdict(compare::MetricId metric, const ResultRecord& committed,
                    const ResultRecord& now) {
  const Baseline baseline = baselineOf({record({committed})});
  return judgementOn(judgeBaseline(baseline, record({now}), {}), metric).verdict;
}

TEST(Baseline, ToleranceIsWiderThanTheSpreadWhateverThatIs) {
  for (const compare::MetricId metric :
       std::initializer_list<compare::MetricId>{"error_rate", "shadow_length_ratio"}) {
    for (const double spread : {0.0, 1e-6, 0.001, 0.05, 3.0}) {
      EXPECT_GT(toleranceOf(metric, spread), spread) << metric.name();
    }
  }
  EXPECT_EQ(toleranceOf("error_rate", 0), leastRateTolerance);
  EXPECT_EQ(toleranceOf("error_rate", 0.004), 0.008);
  EXPECT_EQ(toleranceOf("shadow_length_ratio", 0), leastLengthTolerance);
}

TEST(Baseline, HoldsEveryMetricOfTheWholeRegionWithItsSpread) {
  std::vector<ResultRecord> results = {row("a", 20, 30)};
  results.push_back(results.front());
  results.back().region = "cast";
  const std::vector<Gate> gates = baselineOf({record(results)}).gates;
  ASSERT_EQ(gates.size(), baselineMetrics(Answer::drawn).size());
  for (const Gate& gate : gates) {
    const auto [committed, spread, tolerance] = referenceOf(gate);
    EXPECT_EQ(gate.step, "study");
    EXPECT_EQ(gate.region, "all");
    EXPECT_EQ(spread, gate.metric == "shadow_length_ratio" ? 0.03 : 0.004);
    EXPECT_EQ(tolerance, toleranceOf(gate.metric, spread));
  }
  EXPECT_EQ(gates.at(0).metric, compare::metrics::errorRate);
  EXPECT_DOUBLE_EQ(referenceOf(gates.at(0)).committed, 0.05);
}

TEST(Baseline, LeavesOutWhatIsUndefinedOrHasNoSpread) {
  StudyRecord study = record({row("a", 20, 30), row("b", 1, 1)});
  study.results.at(1).counts = compare::Counts{};
  study.truth.flips.at(0).lengthError.reset();
  const std::vector<Gate> gates = baselineOf({study}).gates;
  ASSERT_EQ(gates.size(), 4U);
  for (const Gate& gate : gates) {
    EXPECT_EQ(gate.method, "a");
    EXPECT_NE(gate.metric, compare::metrics::shadowLengthRatio);
  }
}

TEST(Baseline, TheSameRunPasses) {
  const StudyRecord run = record({row("a", 20, 30), row("b", 5, 5)});
  const std::vector<Judgement> judgements = judgeBaseline(baselineOf({run}), run, {});
  EXPECT_EQ(judgements.size(), 10U);
  for (const Judgement& judgement : judgements) {
    EXPECT_EQ(judgement.verdict, GateVerdict::passed) << judgement.gate.metric.name();
  }
  EXPECT_TRUE(betterThan(judgements).empty());
}

TEST(Baseline, ARateMayRiseByTheToleranceAndNoMore) {
  // 0.05 committed, a tolerance of 0.008.
  EXPECT_EQ(verdict("error_rate", row("a", 20, 30), row("a", 20, 37)), GateVerdict::passed);
  EXPECT_EQ(verdict("error_rate", row("a", 20, 30), row("a", 20, 39)), GateVerdict::failed);
  EXPECT_EQ(verdict("false_light", row("a", 20, 30), row("a", 0, 39)), GateVerdict::failed);
  EXPECT_EQ(verdict("false_shadow", row("a", 20, 30), row("a", 29, 0)), GateVerdict::failed);
  EXPECT_EQ(verdict("error_rate", row("a", 20, 30), row("a", 0, 0)), GateVerdict::passed);
}

TEST(Baseline, ALengthMayNotMoveAwayFromOne) {
  const auto length = [](double committed, double now) {
    return verdict("shadow_length_ratio", row("a", 1, 1, committed), row("a", 1, 1, now));
  };
  // A tolerance of 0.06.
  EXPECT_EQ(length(1.1, 1.15), GateVerdict::passed);
  EXPECT_EQ(length(1.1, 1.17), GateVerdict::failed);
  EXPECT_EQ(length(1.1, 0.9), GateVerdict::passed);
  EXPECT_EQ(length(1.1, 0.83), GateVerdict::failed);
  EXPECT_EQ(length(0.9, 1.17), GateVerdict::failed);
  EXPECT_EQ(length(1.5, 1.0), GateVerdict::passed);
}

TEST(Baseline, TheTruthsShareOfShadowMayNotMoveAtAll) {
  const auto shadowed = [](double share) {
    ResultRecord result = row("a", 20, 30);
    result.counts = {1000 * share, 0, 0, 1000 - 1000 * share, 1000};
    return result;
  };
  EXPECT_EQ(verdict("prevalence", shadowed(0.3), shadowed(0.307)), GateVerdict::passed);
  EXPECT_EQ(verdict("prevalence", shadowed(0.3), shadowed(0.309)), GateVerdict::failed);
  EXPECT_EQ(verdict("prevalence", shadowed(0.3), shadowed(0.291)), GateVerdict::failed);
}

TEST(Baseline, AValueThatIsNoMoreIsNoPass) {
  ResultRecord gone = row("a", 20, 30);
  gone.counts = compare::Counts{};
  EXPECT_EQ(verdict("error_rate", row("a", 20, 30), gone), GateVerdict::undefined);
  ResultRecord without = row("a", 20, 30);
  without.lengths.reset();
  EXPECT_EQ(verdict("shadow_length_ratio", row("a", 20, 30), without), GateVerdict::undefined);
}

TEST(Baseline, AMissingReferenceIsRefused) {
  const Baseline baseline = baselineOf({record({row("a", 20, 30)})});
  const StudyRecord run = record({row("a", 20, 30), row("b", 1, 1)});
  EXPECT_EQ(messageOf<InputError>([&] { (void)judgeBaseline(baseline, run, {}); }),
            "no reference for error_rate of b, drawn, dusk, camera, study and 4 more");
}

TEST(Baseline, AReferenceOfWhatTheRunLacksIsRefused) {
  const Baseline baseline = baselineOf({record({row("a", 20, 30), row("b", 1, 1)})});
  for (ResultRecord other : {row("c", 1, 1), row("b", 1, 1)}) {
    if (other.method == "b") other.light = "dawn";
    const StudyRecord run = record({row("a", 20, 30), other});
    EXPECT_EQ(messageOf<InputError>([&] { (void)judgeBaseline(baseline, run, {}); }),
              "the run has no row for error_rate of b, drawn, dusk, camera, study and 4 more");
  }
  const StudyRecord renamed = record({row("a", 20, 30)}, "other");
  EXPECT_THAT(messageOf<InputError>([&] { (void)judgeBaseline(baseline, renamed, {}); }),
              HasSubstr("no reference for"));
}

TEST(Baseline, SkipsMethodsThatAreLeftOut) {
  const Baseline baseline = baselineOf({record({row("a", 20, 30), row("b", 1, 1)})});
  const std::vector<Judgement> judgements =
      judgeBaseline(baseline, record({row("a", 20, 30)}), {"b"});
  EXPECT_EQ(judgements.size(), 10U);
  EXPECT_EQ(judgementOn(judgements, "error_rate", "a").verdict, GateVerdict::passed);
  EXPECT_EQ(judgementOn(judgements, "error_rate", "b").verdict, GateVerdict::skipped);
}

TEST(Baseline, TellsTheStepsOfASweepApart) {
  const std::vector<StudyRecord> committed = {record({row("a", 20, 30)}, "s/1"),
                                              record({row("a", 50, 50)}, "s/2")};
  std::vector<StudyRecord> run = committed;
  std::swap(run.at(0).results, run.at(1).results);
  const auto first = judgeBaseline(baselineOf(committed), run.at(0), {});
  ASSERT_EQ(first.size(), 5U);
  EXPECT_EQ(first.at(0).gate.step, "s/1");
  EXPECT_EQ(first.at(0).verdict, GateVerdict::failed);
  const auto second = judgeBaseline(baselineOf(committed), run.at(1), {});
  EXPECT_EQ(second.at(0).gate.step, "s/2");
  EXPECT_EQ(second.at(0).verdict, GateVerdict::passed);
}

TEST(Baseline, SaysWhereItCouldBeTightened) {
  const Baseline baseline = baselineOf({record({row("a", 20, 30, 1.3)})});
  const auto noticesFor = [&](const ResultRecord& now) {
    return betterThan(judgeBaseline(baseline, record({now}), {}));
  };
  EXPECT_TRUE(noticesFor(row("a", 16, 27, 1.25)).empty()) << "better by less than the tolerance";
  const std::vector<NoticeRecord> notices = noticesFor(row("a", 2, 30, 1.0));
  ASSERT_EQ(notices.size(), 3U) << "error_rate, false_shadow and the length";
  EXPECT_THAT(notices.at(0).text, HasSubstr("error_rate for a, dusk, camera, study could be "
                                            "tightened: 0.032 now, 0.05 committed"));
}

}  // namespace
}  // namespace gnomon::study
