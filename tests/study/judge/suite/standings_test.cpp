#include "study/judge/suite/standings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "study/judge/distinguish.h"
#include "study/judge/suite/suite_statistics.h"
#include "study/judge/suite/suite_studies.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;

constexpr const char* suites =
    "suite,seed,scenes,sha256,errors\n"
    "small,1,2,abc,drawn-1\n"
    "old,1,2,abc,drawn-0\n";
constexpr const char* table =
    "scene,method,error_rate,false_shadow,false_light,uncertainty,rank\n"
    "small-test-0001,\"max-forsyth, chosen\",0.0625,0.0625,0,0.001,1\n"
    "small-test-0001,unshadowed,0.125,0,0.125,0.001,2\n"
    "small-test-0002,shadow-volume,,,,0.002,\n"
    "small-test-0002,unshadowed,0.3,0.1,0.2,0.002,1\n";

class StandingsFiles : public TemporaryFolder {
 protected:
  void SetUp() override { put(table); }
  void put(const std::string& text) const {
    std::filesystem::create_directories(file("small"));
    std::ofstream(file("suites.csv")) << suites;
    std::ofstream(file("small/suite.csv")) << text;
  }
  [[nodiscard]] std::string refusal(const std::string& suite) const {
    return messageOf<InputError>([&] { (void)readStandings(folder(), suite); });
  }
};

StudyMeans measured(const std::string& scene, double control, double entry) {
  StudyMeans means;
  means.name = scene;
  means.suite = "small-test";
  means.methods = {{"unshadowed", "unshadowed", control, 0, control, 0.001},
                   {"mine", "mine", entry, entry, 0, 0.001}};
  for (MethodMeans& method : means.methods) method.caseErrors = {method.errorRate};
  return means;
}

TEST_F(StandingsFiles, AreReadByTheirColumns) {
  const Standings standings = readStandings(folder(), "small");
  EXPECT_EQ(standings.seed, "1");
  EXPECT_EQ(standings.scenes, 2);
  EXPECT_EQ(standings.sha256, "abc");
  ASSERT_EQ(standings.means.size(), 2U);
  const MethodMeans* chosen = findMeans(standings.means[0], "max-forsyth, chosen");
  ASSERT_NE(chosen, nullptr);
  EXPECT_EQ(chosen->errorRate, 0.0625);
  EXPECT_EQ(chosen->name, "max-forsyth");
  EXPECT_FALSE(chosen->mark.family.empty());
  // No error on a scene is none, and no zero.
  EXPECT_FALSE(findMeans(standings.means[1], "shadow-volume")->errorRate);
}

TEST_F(StandingsFiles, AreRefusedWhereTheyAreDamagedOrOfAnotherError) {
  EXPECT_THAT(refusal("nowhere"), HasSubstr("no row of \"nowhere\" found"));
  EXPECT_THAT(refusal("old"), HasSubstr("\"drawn-0\", \"drawn-1\" expected"));
  put("scene,method,error_rate\nsmall-test-0001,unshadowed,0.1\n");
  EXPECT_THAT(refusal("small"), HasSubstr("suite.csv:2: 3 fields found, 3 with `false_shadow`"));
  put(std::string(table) + "small-test-0003,unshadowed,many,0,0,0.001,1\n");
  EXPECT_THAT(refusal("small"), HasSubstr("suite.csv:6: error_rate: \"many\" found, a number"));
  put(std::string(table) + "small-test-0003,unshadowed\n");
  EXPECT_THAT(refusal("small"), HasSubstr("suite.csv:6: 2 fields found, 7"));
  put("");
  EXPECT_THAT(refusal("small"), HasSubstr("suite.csv: empty"));
}

TEST_F(StandingsFiles, AreJoinedWhereTheControlIsTheSameToTheLastBit) {
  const Standings standings = readStandings(folder(), "small");
  const std::vector<StudyMeans> scenes =
      joined(standings, std::vector{measured("small-test-0001", 0.125, 0.25)}, {"mine"});
  ASSERT_EQ(scenes.size(), 1U);
  ASSERT_EQ(scenes[0].methods.size(), 3U);
  EXPECT_EQ(findMeans(scenes[0], "mine")->errorRate, 0.25);
  EXPECT_EQ(findMeans(scenes[0], "max-forsyth, chosen")->errorRate, 0.0625);

  const auto refused = [&](const StudyMeans& scene) {
    return messageOf<InputError>([&] { (void)joined(standings, std::vector{scene}, {"mine"}); });
  };
  EXPECT_THAT(refused(measured("small-test-0001", std::nextafter(0.125, 1), 0.25)),
              HasSubstr("small-test-0001: error rate of `unshadowed`: 0.12500000000000003 found"));
  StudyMeans scene = measured("small-test-0001", 0.125, 0.25);
  scene.methods[0].uncertainty = 0.002;
  EXPECT_THAT(refused(scene), HasSubstr("the truth's uncertainty of `unshadowed`: 0.002 found"));
  EXPECT_THAT(refused(measured("small-test-0009", 0.125, 0.25)),
              HasSubstr("small-test-0009: no committed errors of small found"));
  scene = measured("small-test-0001", 0.125, 0.25);
  scene.methods.pop_back();
  EXPECT_THAT(refused(scene), HasSubstr("\"mine\" has an error on none of the 1 scenes"));
  // One that lacks a scene, as a method that needs a camera lacks an atlas, is joined without it.
  StudyMeans other = measured("small-test-0002", 0.3, 0.25);
  other.methods[0] = {"unshadowed", "unshadowed", 0.3, 0.1, 0.2, 0.002};
  const auto both = joined(standings, std::vector{scene, other}, {"mine"});
  EXPECT_EQ(findMeans(both[0], "mine"), nullptr);
  EXPECT_EQ(findMeans(both[1], "mine")->errorRate, 0.25);
}

/// The comparisons with one method are fewer than all: the correction allows each a larger error.
TEST(SuiteEntries, AreComparedByThemselves) {
  const std::vector<StudyMeans> studies = test::randomStudies(40, {1, 1.3, 2, 4, 8, 16}, 3);
  const SuiteStatistics all = suiteStatistics("drawn", studies);
  const std::string entry = all.methods.front().label;
  const SuiteStatistics asked = suiteStatistics("drawn", studies, {entry});
  EXPECT_EQ(all.comparisons, 15U);
  EXPECT_EQ(asked.comparisons, 10U);
  for (std::size_t i = 1; i < all.methods.size(); ++i) {
    const auto wide = findPair(all, entry, all.methods[i].label);
    const auto own = findPair(asked, entry, all.methods[i].label);
    ASSERT_TRUE(wide && own);
    EXPECT_EQ(own->difference, wide->difference);
    EXPECT_LE(own->adjusted, wide->adjusted);
  }
  // Without entries nothing changes.
  EXPECT_EQ(suiteStatistics("drawn", studies, {}).comparisons, all.comparisons);
}

}  // namespace
}  // namespace gnomon::study
