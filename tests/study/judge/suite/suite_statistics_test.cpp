#include "study/judge/suite/suite_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "study/judge/distinguish.h"
#include "study/judge/suite/suite_studies.h"

namespace gnomon::study {
namespace {

using test::drawnStudies;
using test::randomStudies;

SuiteStatistics statisticsOf(const std::vector<StudyMeans>& studies) {
  return suiteStatistics("drawn", studies);
}

std::vector<std::string> labelsIn(const SuiteStatistics& statistics) {
  std::vector<std::string> labels;
  for (const SuiteMethod& method : statistics.methods) labels.push_back(method.label);
  return labels;
}

// ---- which studies

TEST(Suite, IsTheOneThatEnoughStudiesWereDrawnFor) {
  std::vector<StudyMeans> studies = drawnStudies(20, 1, [](auto, auto) { return 0.1; });
  EXPECT_EQ(suiteOf(studies), "drawn");
  // A study of no suite does not matter.
  studies.emplace_back();
  EXPECT_EQ(suiteOf(studies), "drawn");
  EXPECT_EQ(statisticsOf(studies).table.scenes.size(), 20U);
  // One of another suite does: they are two populations.
  studies.back().suite = "other";
  EXPECT_EQ(suiteOf(studies), "");
  studies.resize(19);
  EXPECT_EQ(suiteOf(studies), "");
  EXPECT_EQ(suiteOf({}), "");
}

// ---- methods

/// m1 has a tenth of m0's error everywhere, and m2 is between them.
std::vector<StudyMeans> certainStudies() {
  return drawnStudies(40, 3, [](std::size_t s, std::size_t m) {
    const double scene = 0.001 * static_cast<double>(s + 1);
    return m == 0 ? 10 * scene : (m == 1 ? scene : 5 * scene);
  });
}

TEST(SuiteStatistics, RanksByTheMeanOverScenes) {
  const SuiteStatistics statistics = statisticsOf(certainStudies());
  EXPECT_EQ(labelsIn(statistics), (std::vector<std::string>{"m1", "m2", "m0"}));
  const SuiteMethod& best = statistics.methods[0];
  EXPECT_EQ(best.rank->rank, 1U);
  EXPECT_EQ(best.rank->stability, 1);
  EXPECT_NEAR(best.spread.mean, 0.0205, 1e-12);
  EXPECT_NEAR(best.spread.median, 0.0205, 1e-12);
  EXPECT_NEAR(best.spread.worstTwentieth, 0.0395, 1e-12);
  EXPECT_EQ(best.worstScene, "scene-039");
  ASSERT_TRUE(best.interval);
  EXPECT_TRUE(best.interval->holds(0.0205));
}

TEST(SuiteStatistics, TellsApartWhatDiffersOnEveryScene) {
  const SuiteStatistics statistics = statisticsOf(certainStudies());
  ASSERT_EQ(statistics.pairs.size(), 3U);
  EXPECT_EQ(statistics.comparisons, 3U);
  for (const SuitePair& pair : statistics.pairs) {
    EXPECT_EQ(pair.verdict, DifferenceVerdict::better) << pair.first << " " << pair.second;
    EXPECT_EQ(pair.wins.probability, 1);
    EXPECT_LT(pair.adjusted, 0.001);
    EXPECT_GE(pair.adjusted, pair.probability);
    // The correction widens.
    EXPECT_LE(pair.corrected->low, pair.interval->low);
    EXPECT_GE(pair.corrected->high, pair.interval->high);
  }
  const auto swapped = findPair(statistics, "m0", "m1");
  EXPECT_EQ(swapped->verdict, DifferenceVerdict::worse);
  EXPECT_EQ(swapped->wins.probability, 0);
  EXPECT_NEAR(swapped->difference, 9 * 0.0205, 1e-12);
  EXPECT_GT(swapped->interval->low, 0);
  EXPECT_FALSE(findPair(statistics, "m0", "m9"));
}

TEST(SuiteStatistics, AMethodWithItselfIsNeverDistinguishable) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::vector<StudyMeans> studies = randomStudies(30, {1}, seed);
    for (StudyMeans& study : studies) {
      study.methods.push_back(study.methods.front());
      study.methods.back().label = "again";
    }
    const SuiteStatistics statistics = statisticsOf(studies);
    ASSERT_EQ(statistics.pairs.size(), 1U);
    const SuitePair& pair = statistics.pairs.front();
    EXPECT_EQ(pair.verdict, DifferenceVerdict::notDistinguishable);
    EXPECT_EQ(pair.difference, 0);
    EXPECT_EQ(pair.wins.probability, 0.5);
    EXPECT_EQ(pair.reason, "every scene gives the same");
    EXPECT_EQ(statistics.methods[0].rank->rank, 1U);
    EXPECT_EQ(statistics.methods[1].rank->rank, 1U);
  }
}

/// On every scene the same answers: equal. On one scene others, of the same error: no longer known.
TEST(SuiteStatistics, MethodsThatAnswerAlikeOnEverySceneAreEqual) {
  std::vector<StudyMeans> studies = randomStudies(30, {1}, 1);
  for (StudyMeans& study : studies) {
    study.methods.push_back(study.methods.front());
    study.methods.back().label = "again";
    DifferenceRecord& alike = study.differences.emplace_back();
    alike.first = study.methods.front().label;
    alike.second = "again";
    alike.verdict = DifferenceVerdict::equal;
  }
  EXPECT_EQ(statisticsOf(studies).pairs.front().verdict, DifferenceVerdict::equal);
  studies[7].differences.front().verdict = DifferenceVerdict::notDistinguishable;
  EXPECT_EQ(statisticsOf(studies).pairs.front().verdict, DifferenceVerdict::notDistinguishable);
}

/// The scenes agree that one is better, but by less than the truth itself may be wrong.
TEST(SuiteStatistics, DifferencesBelowTheTruthsUncertaintyAreNone) {
  const auto errors = [](std::size_t s, std::size_t m) {
    return 0.1 + 0.001 * static_cast<double>(m) + 0.0001 * static_cast<double>(s * (m + 1));
  };
  const SuiteStatistics sure = statisticsOf(drawnStudies(30, 2, errors, 0.001));
  EXPECT_EQ(sure.pairs.front().verdict, DifferenceVerdict::better);
  const SuiteStatistics unsure = statisticsOf(drawnStudies(30, 2, errors, 0.01));
  EXPECT_EQ(unsure.pairs.front().verdict, DifferenceVerdict::notDistinguishable);
  EXPECT_FALSE(unsure.pairs.front().corrected->holds(0));
  EXPECT_EQ(unsure.pairs.front().wins.ties, 30U);
  EXPECT_EQ(unsure.pairs.front().wins.probability, 0.5);
}

// ---- what is missing

TEST(SuiteStatistics, AMethodThatLacksASceneHasNoRankButPairs) {
  std::vector<StudyMeans> studies = certainStudies();
  std::erase_if(studies[5].methods, [](const MethodMeans& m) { return m.label == "m1"; });
  // One light of two: its mean there cannot be compared.
  studies[7].methods[2].caseErrors.emplace_back();
  const SuiteStatistics statistics = statisticsOf(studies);
  EXPECT_EQ(labelsIn(statistics), (std::vector<std::string>{"m0", "m1", "m2"}));
  EXPECT_TRUE(statistics.methods[0].rank);
  EXPECT_FALSE(statistics.methods[1].rank);
  EXPECT_FALSE(statistics.methods[2].rank);
  EXPECT_EQ(statistics.methods[1].spread.scenes, 39U);
  EXPECT_EQ(findPair(statistics, "m0", "m1")->wins.scenes, 39U);
  EXPECT_EQ(findPair(statistics, "m1", "m2")->wins.scenes, 38U);
}

TEST(SuiteStatistics, TooFewSharedScenesHaveNoInterval) {
  std::vector<StudyMeans> studies = certainStudies();
  for (std::size_t s = 0; s < studies.size(); ++s) {
    std::erase_if(studies[s].methods, [&](const MethodMeans& m) {
      return (m.label == "m1" && s >= 25) || (m.label == "m2" && s < 15);
    });
  }
  const SuiteStatistics statistics = statisticsOf(studies);
  const auto pair = findPair(statistics, "m1", "m2");
  EXPECT_EQ(pair->wins.scenes, 10U);
  EXPECT_EQ(pair->reason, "fewer than 20 scenes");
  EXPECT_EQ(pair->verdict, DifferenceVerdict::noInterval);
  EXPECT_EQ(statistics.comparisons, 2U);
}

// ---- order

/// Neither the order of scenes nor that of methods changes a bit of any figure.
TEST(SuiteStatistics, DoNotDependOnAnyOrder) {
  std::vector<StudyMeans> studies = randomStudies(35, {1, 1.1, 1.5, 0.9}, 3, 0.0005);
  const SuiteStatistics before = statisticsOf(studies);
  std::reverse(studies.begin(), studies.end());
  std::swap(studies[3], studies[20]);
  for (std::size_t s = 0; s < studies.size(); ++s) {
    std::rotate(studies[s].methods.begin(),
                studies[s].methods.begin() + static_cast<std::ptrdiff_t>(s % 4),
                studies[s].methods.end());
  }
  const SuiteStatistics after = statisticsOf(studies);
  ASSERT_EQ(labelsIn(before), labelsIn(after));
  for (std::size_t m = 0; m < before.methods.size(); ++m) {
    EXPECT_EQ(before.methods[m].spread, after.methods[m].spread);
    EXPECT_EQ(before.methods[m].interval->low, after.methods[m].interval->low);
    EXPECT_EQ(before.methods[m].rank->stability, after.methods[m].rank->stability);
  }
  ASSERT_EQ(before.pairs.size(), after.pairs.size());
  for (std::size_t p = 0; p < before.pairs.size(); ++p) {
    EXPECT_EQ(before.pairs[p].first, after.pairs[p].first);
    EXPECT_EQ(before.pairs[p].difference, after.pairs[p].difference);
    EXPECT_EQ(before.pairs[p].probability, after.pairs[p].probability);
    EXPECT_EQ(before.pairs[p].adjusted, after.pairs[p].adjusted);
    EXPECT_EQ(before.pairs[p].corrected->high, after.pairs[p].corrected->high);
  }
  EXPECT_EQ(before.scenes.front().name, after.scenes.front().name);
}

// ---- controls

/// Methods of one distribution: in at most 5 of 100 suites any two of them are told apart, in spite
/// of ten comparisons in each. of 120 suites 6, and by chance not more than 11.
TEST(SuiteControl, EqualMethodsAreSeldomToldApart) {
  int suites = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    const SuiteStatistics statistics = statisticsOf(randomStudies(30, {1, 1, 1, 1, 1}, seed));
    suites += std::any_of(statistics.pairs.begin(), statistics.pairs.end(),
                          [](const auto& pair) { return isDistinguishable(pair.verdict); });
  }
  EXPECT_LE(suites, 0.05 * 120 + 5);
}

/// Without a correction they would be: the control of the control.
TEST(SuiteControl, WithoutCorrectionEqualMethodsWouldOftenBe) {
  int suites = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const SuiteStatistics statistics = statisticsOf(randomStudies(30, {1, 1, 1, 1, 1}, seed));
    suites += std::any_of(statistics.pairs.begin(), statistics.pairs.end(),
                          [](const auto& pair) { return pair.probability <= 0.05; });
  }
  EXPECT_GE(suites, 0.12 * 40);
}

/// A method of half the error comes first. That it is distinguishable takes more: a single scene
/// that is ten times as hard as the others widens the interval of every difference.
TEST(SuiteControl, AMethodOfHalfTheErrorIsFound) {
  int first = 0;
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SuiteStatistics statistics = statisticsOf(randomStudies(100, {1, 1, 0.5}, seed));
    first += statistics.methods.front().label == "m2" ? 1 : 0;
    const auto pair = findPair(statistics, "m2", "m0");
    found += pair->verdict == DifferenceVerdict::better ? 1 : 0;
    EXPECT_NE(pair->verdict, DifferenceVerdict::worse);
    EXPECT_GT(pair->wins.interval.low, 0.5);
  }
  EXPECT_EQ(first, 20);
  EXPECT_GE(found, 14);
}

// ---- scenes and bins

TEST(SuiteStatistics, TheHardestScenesComeFirst) {
  const SuiteStatistics statistics = statisticsOf(certainStudies());
  ASSERT_EQ(statistics.scenes.size(), 40U);
  const SuiteScene& hardest = statistics.scenes.front();
  EXPECT_EQ(hardest.name, "scene-039");
  EXPECT_NEAR(*hardest.median, 0.2, 1e-12);
  EXPECT_EQ(hardest.best, "m1");
  EXPECT_NEAR(*hardest.bestError, 0.04, 1e-12);
  EXPECT_NEAR(*hardest.leaderError, 0.04, 1e-12);
}

/// m0 errs below 10° alone: half of the samples of each scene but the last, which has none there.
TEST(SuiteStatistics, BinsAreOverTheScenesSamples) {
  std::vector<StudyMeans> studies =
      drawnStudies(30, 1, [](std::size_t s, auto) { return 0.1 + 0.001 * static_cast<double>(s); });
  for (std::size_t s = 0; s < studies.size(); ++s) {
    const double error = *studies[s].methods[0].errorRate;
    if (s + 1 < studies.size()) {
      studies[s].bins.push_back({"m0", "elevation", {}, 10, {0.5, error}});
    }
    studies[s].bins.push_back({"m0", "elevation", 10, {}, {s + 1 < studies.size() ? 0.5 : 1, 0}});
  }
  const SuiteStatistics statistics = statisticsOf(studies);
  ASSERT_EQ(statistics.bins.size(), 2U);
  EXPECT_FALSE(statistics.bins[0].low);
  EXPECT_EQ(statistics.bins[0].error.scenes, 29U);
  EXPECT_NEAR(statistics.bins[0].error.errorRate, 2 * 0.114, 1e-12);
  EXPECT_TRUE(statistics.bins[0].error.interval->holds(2 * 0.114));
  EXPECT_EQ(statistics.bins[1].error.scenes, 30U);
  EXPECT_EQ(statistics.bins[1].error.errorRate, 0);
}

/// What a record's bins come to: means over views, of shares that add up.
TEST(SceneBins, AddUpToTheErrorOfTheirSamples) {
  StudyRecord record;
  const auto bin = [](const char* view, std::optional<double> low, std::optional<double> high,
                      double right, double wrong) {
    return BinRecord{"m", view, "all", "elevation", low, high, {0, wrong, 0, right, 10}};
  };
  record.bins = {bin("near", {}, 10, 6, 2), bin("near", 10, {}, 2, 0), bin("far", {}, 10, 0, 20),
                 bin("far", 10, {}, 10, 10)};
  const std::vector<SceneBin> bins = sceneBins(record);
  ASSERT_EQ(bins.size(), 2U);
  EXPECT_DOUBLE_EQ(bins[0].share.weight, (0.8 + 0.5) / 2);
  EXPECT_DOUBLE_EQ(bins[0].share.wrong, (0.2 + 0.5) / 2);
  EXPECT_DOUBLE_EQ(bins[0].share.weight + bins[1].share.weight, 1);
  EXPECT_DOUBLE_EQ(bins[0].share.wrong + bins[1].share.wrong, (2.0 / 10 + 30.0 / 40) / 2);
}

TEST(SceneBins, AreOfStudiesThatWereDrawn) {
  StudyRecord record;
  record.bins = {{"m", "camera", "all", "elevation", {}, 10, {0, 1, 0, 9, 10}}};
  EXPECT_EQ(studyMeans(record).suite, "");
  EXPECT_TRUE(studyMeans(record).bins.empty());
  record.reproduction.settings.insert("study", toml::table{{"suite", "drawn"}});
  EXPECT_EQ(studyMeans(record).suite, "drawn");
  EXPECT_EQ(studyMeans(record).bins.size(), 1U);
}

}  // namespace
}  // namespace gnomon::study
