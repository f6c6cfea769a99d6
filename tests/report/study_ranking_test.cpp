#include "study/judge/ranking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/error.h"
#include "report/json/results_json.h"
#include "report/page/overview_html.h"
#include "report/sample_record.h"
#include "report/tables/ranked_table.h"
#include "report/tables/table.h"
#include "report/terminal_page.h"
#include "report/terminal_report.h"

namespace gnomon::report {
namespace {

using test::countsOf;
using test::result;
using ::testing::HasSubstr;
using ::testing::Not;

/// A study in which every method has one error rate under each of two lights, in thousandths.
study::StudyRecord study(
    const std::string& name,
    const std::vector<std::pair<std::string, std::pair<double, double>>>& errors,
    double uncertainty = 0.001) {
  study::StudyRecord record;
  record.name = name;
  record.title = "Title of <" + name + ">";
  record.truth.uncertainty = uncertainty;
  for (const auto& [label, rates] : errors) {
    record.methods.push_back({label, label, "", ""});
    record.results.push_back(
        result(label, "noon", "camera", "all", countsOf(1000, rates.first, 0)));
    record.results.push_back(
        result(label, "dusk", "camera", "all", countsOf(1000, 0, rates.second)));
    // Regions must not count.
    record.results.push_back(result(label, "dusk", "camera", "cast", countsOf(1000, 0, 250)));
  }
  test::addDifferences(record, 1e-6);
  return record;
}

std::vector<study::StudyMeans> meansOf(const std::vector<study::StudyRecord>& records) {
  std::vector<study::StudyMeans> means;
  for (const study::StudyRecord& record : records) means.push_back(study::studyMeans(record));
  return means;
}

/// flat: 0.02, 0.10 and 0.06; curved: 0.03, 0.02, 0.01; new: only in the second, 0.015.
std::vector<study::StudyMeans> threeStudies() {
  return meansOf(
      {study("a", {{"flat", {10, 30}}, {"curved", {30, 30}}}, 0.001),
       study("b", {{"flat", {100, 100}}, {"curved", {10, 30}}, {"new", {15, 15}}}, 0.002),
       study("c", {{"curved", {10, 10}}, {"flat", {60, 60}}}, 0.006)});
}

TEST(StudyRanking, EachStudyHasTheSameWeight) {
  // Two lights in one study, four in the other: the mean of means, not of the lights.
  study::StudyRecord many = study("many", {{"m", {10, 10}}});
  for (const char* light : {"morning", "evening"}) {
    many.results.push_back(result("m", light, "camera", "all", countsOf(1000, 50, 0)));
  }
  const auto ranked = study::rankOverStudies(meansOf({many, study("few", {{"m", {60, 80}}})}));
  ASSERT_EQ(ranked.size(), 1U);
  EXPECT_DOUBLE_EQ(*ranked[0].meanError, (0.03 + 0.07) / 2);
  EXPECT_DOUBLE_EQ(*ranked[0].worstError, 0.07);
  EXPECT_EQ(ranked[0].worstStudy, "few");
}

TEST(StudyRanking, RanksWhatWasMeasuredEverywhereByItsMean) {
  const auto ranked = study::rankOverStudies(threeStudies());
  ASSERT_EQ(ranked.size(), 3U);
  EXPECT_EQ(ranked[0].label, "curved");
  EXPECT_EQ(ranked[0].rank, 1U);
  EXPECT_DOUBLE_EQ(*ranked[0].meanError, 0.02);
  EXPECT_DOUBLE_EQ(*ranked[0].worstError, 0.03);
  EXPECT_EQ(ranked[0].worstStudy, "a");
  EXPECT_EQ(ranked[0].studies, 3U);
  EXPECT_DOUBLE_EQ(*ranked[0].uncertainty, 0.003);
  EXPECT_EQ(ranked[1].label, "flat");
  EXPECT_EQ(ranked[1].rank, 2U);
  EXPECT_DOUBLE_EQ(*ranked[1].meanError, 0.06);
  EXPECT_EQ(ranked[1].worstStudy, "b");
}

TEST(StudyRanking, AMethodThatIsMissingSomewhereHasNoRankHoweverSmallItsError) {
  const auto ranked = study::rankOverStudies(threeStudies());
  EXPECT_EQ(ranked[2].label, "new");
  EXPECT_FALSE(ranked[2].rank);
  EXPECT_EQ(ranked[2].studies, 1U);
  EXPECT_DOUBLE_EQ(*ranked[2].meanError, 0.015);
  // The best method on study b alone.
  EXPECT_DOUBLE_EQ(*ranked[2].leaderError, 0.02);
  EXPECT_FALSE(ranked[0].leaderError);
}

/// "easy" is never wrong, but answers under one light of two in the second study: there "curved"
/// has 10 of 1000 wrong, under the other light 30.
std::vector<study::StudyMeans> studiesWithAnEasyCase() {
  study::StudyRecord a = study("a", {{"curved", {30, 30}}, {"easy", {1, 1}}});
  study::StudyRecord b = study("b", {{"curved", {10, 30}}, {"easy", {1, 1}}});
  std::erase_if(b.results, [](const study::ResultRecord& row) {
    return row.method == "easy" && row.light == "dusk";
  });
  return meansOf({a, b});
}

TEST(StudyRanking, AMethodThatLacksACaseOfAStudyHasNoRankHoweverSmallItsError) {
  const auto ranked = study::rankOverStudies(studiesWithAnEasyCase());
  ASSERT_EQ(ranked.size(), 2U);
  EXPECT_EQ(ranked[0].label, "curved");
  EXPECT_EQ(ranked[0].rank, 1U);
  EXPECT_EQ(ranked[1].label, "easy");
  EXPECT_FALSE(ranked[1].rank);
  EXPECT_FALSE(ranked[1].toBest);
  EXPECT_EQ(ranked[1].studies, 2U);
  EXPECT_EQ(ranked[1].cases, 3U);
  EXPECT_EQ(ranked[1].allCases, 4U);
  EXPECT_DOUBLE_EQ(*ranked[1].meanError, 0.001);
  // "curved" over the same cases: both of the first study, one of the second.
  EXPECT_DOUBLE_EQ(*ranked[1].leaderError, (0.03 + 0.01) / 2);
}

TEST(StudyRanking, MoreStudiesComeFirstAmongThoseWithoutARank) {
  const auto ranked = study::rankOverStudies(
      meansOf({study("a", {{"once", {1, 1}}}), study("b", {{"twice", {90, 90}}}),
               study("c", {{"twice", {90, 90}}})}));
  ASSERT_EQ(ranked.size(), 2U);
  EXPECT_EQ(ranked[0].label, "twice");
  EXPECT_FALSE(ranked[0].rank);
  EXPECT_FALSE(ranked[1].leaderError) << "nobody is first";
}

TEST(StudyRanking, AStudyThatDefinesNoErrorDoesNotCount) {
  study::StudyRecord empty = study("empty", {{"m", {1, 1}}, {"n", {5, 5}}});
  for (study::ResultRecord& row : empty.results) {
    if (row.method == "m") row.counts = {};
  }
  const auto ranked =
      study::rankOverStudies(meansOf({empty, study("b", {{"m", {2, 2}}, {"n", {9, 9}}})}));
  EXPECT_EQ(ranked[0].label, "n");
  EXPECT_EQ(ranked[1].studies, 1U);
  EXPECT_FALSE(ranked[1].rank);
  EXPECT_DOUBLE_EQ(*ranked[1].leaderError, 0.009);
}

TEST(StudyRanking, MarksWhatTheTruthCannotTellFromTheBest) {
  const auto ranked = study::rankOverStudies(
      meansOf({study("a", {{"best", {10, 10}}, {"close", {12, 12}}, {"far", {20, 20}}}, 0.004),
               study("b", {{"best", {10, 10}}, {"close", {12, 12}}, {"far", {20, 20}}}, 0.002)}));
  EXPECT_FALSE(ranked[0].toBest);
  EXPECT_EQ(ranked[1].toBest->verdict, study::DifferenceVerdict::notDistinguishable);
  EXPECT_EQ(ranked[2].toBest->verdict, study::DifferenceVerdict::worse);
}

TEST(StudyRanking, SaysWhichStudiesHaveNoInterval) {
  const auto studyOf = [](const std::string& name) {
    study::StudyRecord record = study(name, {{"best", {10, 10}}, {"far", {90, 90}}}, 0);
    test::addDifferences(record, 0.001);
    return record;
  };
  study::SweepRecord sweep;
  sweep.name = "bumps";
  sweep.keys = {{"relief.height", "height"}};
  for (const double value : {0.5, 2.0}) {
    sweep.cases.push_back({study::sweptNumber(value).text, {study::sweptNumber(value)}});
  }
  sweep.steps = {studyOf("bumps/0.5"), studyOf("bumps/2")};
  for (study::DifferenceRecord& row : sweep.steps[1].differences) {
    row.interval.reset();
    row.reason = "too few blocks";
  }
  const std::vector<study::StudyMeans> studies = {study::studyMeans(studyOf("plain")),
                                                  study::studyMeans(sweep)};
  const auto ranked = study::rankOverStudies(studies);
  EXPECT_EQ(ranked[1].toBest->verdict, study::DifferenceVerdict::noInterval);
  EXPECT_EQ(ranked[1].toBest->reason, "on bumps: at 2: too few blocks");
  const std::string note =
      "? No interval of the difference of “far”: on bumps: at 2: too few blocks.";
  EXPECT_THAT(rankingHtml(studies, "").text(), HasSubstr(note));
  const std::string text = terminalReport(studies, false);
  EXPECT_THAT(text, HasSubstr("  " + note));
  EXPECT_EQ(text.find("≈"), text.rfind("≈")) << "in the explanation alone";
  EXPECT_THAT(rankingJson(studies, ""),
              HasSubstr("\"to_best\": \"no interval\",\n      \"reason\": \"on bumps: at 2"));
}

TEST(StudyRanking, MarksWhatTheIntervalsCannotTellFromTheBest) {
  study::StudyRecord a =
      study("a", {{"best", {10, 10}}, {"close", {12, 12}}, {"far", {20, 20}}}, 0);
  study::StudyRecord b = a;
  // The mean interval of "close" less "best" is -0.001 to 0.005.
  test::addDifferences(a, 0.005);
  test::addDifferences(b, 0.001);
  const auto ranked = study::rankOverStudies(meansOf({a, b}));
  EXPECT_EQ(ranked[1].toBest->verdict, study::DifferenceVerdict::notDistinguishable);
  EXPECT_EQ(ranked[2].toBest->verdict, study::DifferenceVerdict::worse);
  test::addDifferences(a, 0.001);
  EXPECT_EQ(study::rankOverStudies(meansOf({a, b}))[1].toBest->verdict,
            study::DifferenceVerdict::worse);
}

TEST(StudyRanking, LabelsThatAreNotNamesSayWhatTheyStandFor) {
  study::StudyRecord a = study("a", {{"ours", {1, 1}}});
  study::StudyRecord b = a;
  a.methods[0].name = "onoue-2004";
  b.methods[0].name = "onoue-exact";
  const auto firstOf = [](const std::vector<study::StudyMeans>& studies) {
    const study::RankedOverStudies first = study::rankOverStudies(studies)[0];
    return study::labelWithName(first.label, first.names);
  };
  EXPECT_EQ(firstOf(meansOf({a, a})), "ours (onoue-2004)");
  EXPECT_EQ(firstOf(meansOf({a, b})), "ours (onoue-2004, onoue-exact)");
  EXPECT_EQ(firstOf(threeStudies()), "curved");
  EXPECT_EQ(study::labelWithName("onoue-2004, chosen", {"onoue-2004"}), "onoue-2004, chosen");
  EXPECT_EQ(study::labelWithName("onoue-2004", {"onoue-2004", "onoue-exact"}),
            "onoue-2004 (onoue-2004, onoue-exact)");
}

TEST(StudyRanking, NothingIsNotRanked) {
  EXPECT_TRUE(study::rankOverStudies({}).empty());
  EXPECT_TRUE(study::rankOverStudies(meansOf({study::StudyRecord{}})).empty());
}

// ---- as text

// ---- as files

TEST(RankingJson, RefusesFiguresThatAreNotFinite) {
  std::vector<study::StudyMeans> studies = threeStudies();
  studies[0].methods[0].uncertainty = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(rankingJson(studies, ""), InternalError);
  EXPECT_THROW(csvTable(studyMeansTable(studies)), InternalError);
}

TEST(RankingCsv, HasARowAMethodAndStudy) {
  std::vector<study::StudyMeans> studies = threeStudies();
  studies[2].methods[1].uncertainty.reset();
  const std::string csv = csvTable(studyMeansTable(studies));
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "study,method,error_rate,false_shadow,false_light,uncertainty,cases,all_cases");
  EXPECT_THAT(csv, HasSubstr("\na,flat,0.02,0.005,0.015,0.001,2,2\n"));
  EXPECT_THAT(csv, HasSubstr("\nc,flat,0.06,0.03,0.03,,2,2\n"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 8);
}

TEST(RankingHtml, LinksEveryStudyAndListsAllClaims) {
  std::vector<study::StudyMeans> studies = threeStudies();
  studies[0].claims = {{"First <claim>", "§4", study::Verdict::held, ""}};
  studies[2].claims = {{"Second claim", "§5", study::Verdict::failed, ""}};
  const std::string html = rankingHtml(studies, "gnomon run a & b").text();
  for (const char* part :
       {"href=\"a/report.html\"", "href=\"b/report.html\"", "href=\"c/report.html\"",
        "First &lt;claim&gt;", "Second claim", "tag failed\">failed<", "gnomon run a &amp; b",
        "in 3 studies, <b>curved</b>", "in 2 of 6 cases: no rank; curved has 2.00 % on the same",
        "Title of &lt;a&gt;"}) {
    EXPECT_THAT(html, HasSubstr(part));
  }
  for (const char* fetch : {"http://", "https://", "<link", "<script src", "@import", "url("}) {
    EXPECT_THAT(html, Not(HasSubstr(fetch)));
  }
}

}  // namespace
}  // namespace gnomon::report
