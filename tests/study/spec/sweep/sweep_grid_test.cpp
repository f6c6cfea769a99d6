// Sweeps of several keys, ranges and draws.

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "common/error.h"
#include "common/random_stream.h"
#include "study/spec/sweep/sweep.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::study {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::StartsWith;

/// Its last line is line 29.
constexpr const char* gridStudy = R"([study]
name = "bumps"
title = "Columns"
source = "a test"

[surface]
shape = "plane"
quads = [4, 2]
size = [64, 32]

[relief]
pattern = "columns"
texels = [64, 32]
height = 4
height_space = "world"

[[view]]
type = "atlas"
samples = 8

[[light]]
elevation = 30

[[method]]
name = "max-forsyth"

[[method]]
name = "onoue-2004"
label = "ours"
)";

class SweepGridFile : public TemporaryFolder {
 protected:
  StudyPlan read(const std::string& sections) {
    std::ofstream(file("bumps.toml"), std::ios::binary) << gridStudy << sections;
    return readStudyPlan(file("bumps.toml"));
  }
  std::string failure(const std::string& sections) {
    return withoutFolder(messageOf<InputError>([&] { (void)read(sections); }));
  }
};

std::string table(const std::string& key, const std::string& rest) {
  return "[[sweep]]\nkey = \"" + key + "\"\n" + rest + "\n";
}
std::string heights(const std::string& values) {
  return table("relief.height", "values = " + values);
}
std::string elevations(const std::string& values) {
  return table("light.0.elevation", "values = " + values);
}

std::vector<double> numbersOf(const StudyPlan& plan, std::size_t key = 0) {
  std::vector<double> values;
  for (const SweepCase& which : plan.sweep->cases) {
    values.push_back(which.values.at(key).number.value());
  }
  return values;
}

std::vector<std::string> names(const StudyPlan& plan) {
  std::vector<std::string> found;
  for (const StudySpec& step : plan.steps) found.push_back(step.name);
  return found;
}

// ---- ranges

TEST_F(SweepGridFile, ARangeHasBothItsEnds) {
  EXPECT_THAT(numbersOf(read(heights("\"5:25:5\""))), ElementsAre(5, 10, 15, 20, 25));
  EXPECT_THAT(numbersOf(read(heights("\"3:1:-1\""))), ElementsAre(3, 2, 1));
  // As they read, not as steps of a binary fraction add up.
  EXPECT_THAT(numbersOf(read(heights("\"0:0.5:0.1\""))), ElementsAre(0, 0.1, 0.2, 0.3, 0.4, 0.5));
  EXPECT_THAT(numbersOf(read(heights("\"-0.3:0.3:0.1\""))),
              ElementsAre(-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3));
  EXPECT_THAT(names(read(heights("\"0:0.2:0.1\""))),
              ElementsAre("bumps/0", "bumps/0.1", "bumps/0.2"));
}

TEST_F(SweepGridFile, AGeometricRangeHasBothItsEnds) {
  EXPECT_THAT(numbersOf(read(heights("\"log:0.001:1:4\""))), ElementsAre(0.001, 0.01, 0.1, 1));
  const std::vector<double> seven = numbersOf(read(heights("\"log:0.3:7:7\"")));
  ASSERT_EQ(seven.size(), 7U);
  EXPECT_EQ(seven.front(), 0.3);
  EXPECT_EQ(seven.back(), 7);
  for (std::size_t i = 0; i < 7; ++i) {
    const double exact = std::exp(std::log(0.3) + static_cast<double>(i) / 6 * std::log(7 / 0.3));
    EXPECT_NEAR(seven[i], exact, 1e-5 * exact);
  }
  EXPECT_THAT(numbersOf(read(heights("\"log:8:1:4\""))), ElementsAre(8, 4, 2, 1));
}

TEST_F(SweepGridFile, RefusesTextsThatAreNoRange) {
  for (const char* text : {"5", "5:85", "5:85:5:1", "five:85:5", "lin:1:2:3", "1:2:inf", ""}) {
    EXPECT_THAT(failure(heights("\"" + std::string(text) + "\"")),
                AllOf(StartsWith("bumps.toml:32: sweep.0.values: "), HasSubstr("expected")))
        << text;
  }
  EXPECT_THAT(failure(heights("\"5:12:5\"")),
              HasSubstr("a last value that the steps reach expected, as 10"));
  for (const char* text : {"5:1:5", "1:5:0", "1:5:-1", "3:3:1"}) {
    EXPECT_THAT(failure(heights("\"" + std::string(text) + "\"")),
                HasSubstr("leads from the first to the last"))
        << text;
  }
  EXPECT_THAT(failure(heights("\"0:1:1e-9\"")), HasSubstr("at most 100000 values expected"));
  EXPECT_THAT(failure(heights("\"log:0:1:4\"")), HasSubstr("above 0 expected"));
  EXPECT_THAT(failure(heights("\"log:1:2:1\"")), HasSubstr("a count from 2 to 100000 expected"));
  EXPECT_THAT(failure(heights("\"log:1:2:3.5\"")), HasSubstr("a count from 2 to 100000 expected"));
}

// ---- grid and zip

TEST_F(SweepGridFile, SeveralTablesAreAGridWhoseFirstKeyChangesSlowest) {
  const StudyPlan plan = read(heights("[2, 8]") + elevations("\"20:60:20\""));
  EXPECT_THAT(numbersOf(plan, 0), ElementsAre(2, 2, 2, 8, 8, 8));
  EXPECT_THAT(numbersOf(plan, 1), ElementsAre(20, 40, 60, 20, 40, 60));
  EXPECT_THAT(names(plan),
              ElementsAre("bumps/height-2_elevation-20", "bumps/height-2_elevation-40",
                          "bumps/height-2_elevation-60", "bumps/height-8_elevation-20",
                          "bumps/height-8_elevation-40", "bumps/height-8_elevation-60"));
  EXPECT_EQ(plan.steps[4].title, "Columns, relief.height = 8, light.0.elevation = 40");
  EXPECT_DOUBLE_EQ(plan.steps[4].lights[0].angles.elevation, 40.0);
  EXPECT_FLOAT_EQ(plan.steps[4].relief.field.maximum() / plan.steps[0].relief.field.maximum(), 4);
  EXPECT_EQ(plan.sweep->keys[0].dimension, 0U);
  EXPECT_EQ(plan.sweep->keys[1].dimension, 1U);
}

TEST_F(SweepGridFile, TablesWithAnotherStepWithIt) {
  const StudyPlan plan = read(heights("[2, 8]") + elevations("[20, 60, 70]") +
                              table("bake.azimuths", "values = [8, 16]\nwith = \"relief.height\""));
  EXPECT_THAT(numbersOf(plan, 0), ElementsAre(2, 2, 2, 8, 8, 8));
  EXPECT_THAT(numbersOf(plan, 1), ElementsAre(20, 60, 70, 20, 60, 70));
  EXPECT_THAT(numbersOf(plan, 2), ElementsAre(8, 8, 8, 16, 16, 16));
  EXPECT_EQ(plan.sweep->keys[2].dimension, 0U);
  EXPECT_EQ(plan.steps[5].bake.settings.azimuths, 16);
  // What repeats in one key is told apart by the other.
  const StudyPlan pairs = read(heights("[2, 2]") + table("light.0.elevation",
                                                         "values = [20, 30]\n"
                                                         "with = \"relief.height\""));
  EXPECT_THAT(names(pairs),
              ElementsAre("bumps/height-2_elevation-20", "bumps/height-2_elevation-30"));
}

TEST_F(SweepGridFile, TakesTextsAndLists) {
  const StudyPlan plan = read(table("relief.pattern", "values = [\"columns\", \"cosine\"]") +
                              table("relief.texels", "values = [[64, 32], [32, 32]]"));
  EXPECT_THAT(
      names(plan),
      ElementsAre("bumps/pattern-columns_texels-64-32", "bumps/pattern-columns_texels-32-32",
                  "bumps/pattern-cosine_texels-64-32", "bumps/pattern-cosine_texels-32-32"));
  EXPECT_EQ(plan.steps[1].relief.field.width(), 32);
  EXPECT_EQ(plan.steps[3].title, "Columns, relief.pattern = cosine, relief.texels = [32, 32]");
  EXPECT_FALSE(plan.sweep->cases[0].values[0].number);
  const StudyPlan one = read(table("method.0.name", "values = [\"ellipse\", \"unshadowed\"]"));
  EXPECT_THAT(names(one), ElementsAre("bumps/name-ellipse", "bumps/name-unshadowed"));
  EXPECT_THAT(failure(table("relief.pattern", "values = [\"columns\", 3]")),
              StartsWith("bumps.toml:32: sweep.0.values: 3 is not as the first one"));
  EXPECT_THAT(failure(table("relief.pattern", "values = [\"columns\", \"columns\"]")),
              StartsWith("bumps.toml:32: sweep.0.values: columns found twice"));
  EXPECT_THAT(failure(table("relief.pattern", "values = [{ a = 1 }, { a = 2 }]")),
              HasSubstr("numbers, texts, true and false, or flat lists expected"));
}

// ---- names

TEST_F(SweepGridFile, NamesAreDistinctShortAndSafe) {
  // Ends alike: the whole key.
  std::string twoLights = "[[light]]\nelevation = 50\n";
  EXPECT_THAT(names(read(twoLights + elevations("[20, 30]") +
                         table("light.1.elevation", "values = [40, 60]"))),
              ElementsAre("bumps/light-0-elevation-20_light-1-elevation-40",
                          "bumps/light-0-elevation-20_light-1-elevation-60",
                          "bumps/light-0-elevation-30_light-1-elevation-40",
                          "bumps/light-0-elevation-30_light-1-elevation-60"));
  // The same for a file system that knows no capitals.
  EXPECT_THAT(names(read(table("light.0.name", "values = [\"Sun\", \"sun\"]"))),
              ElementsAre("bumps/case-1", "bumps/case-2"));
  EXPECT_THAT(names(read(table("light.0.name", "values = [\"a/b\", \"../../etc\"]"))),
              ElementsAre("bumps/name-a-b", "bumps/name-etc"));
  const std::string longName(70, 'n');
  EXPECT_THAT(names(read(table("light.0.name", "values = [\"a\", \"" + longName + "\"]"))),
              ElementsAre("bumps/case-1", "bumps/case-2"));
}

// ---- random numbers by their place

TEST(CountedRandom, IsSplitMix64) {
  // The first outputs of the generator's reference implementation for the seed 1234567.
  const std::uint64_t golden = 0x9E3779B97F4A7C15U;
  EXPECT_EQ(splitMix64(1234567), 6457827717110365317U);
  EXPECT_EQ(splitMix64(1234567 + golden), 3203168211198807973U);
  EXPECT_EQ(splitMix64(1234567 + 2 * golden), 9817491932198370423U);
  // Of the empty text and of "a", as published with the hash.
  EXPECT_EQ(textHash(""), 0xCBF29CE484222325U);
  EXPECT_EQ(textHash("a"), 0xAF63DC4C8601EC8CU);
}

TEST(CountedRandom, IsUniform) {
  constexpr int count = 100000;
  double sum = 0;
  double squares = 0;
  double neighbours = 0;
  for (int i = 0; i < count; ++i) {
    const double u = randomUnit(7, "relief.height", static_cast<std::uint64_t>(i));
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    squares += u * u;
    neighbours +=
        (u - 0.5) * (randomUnit(7, "relief.height", static_cast<std::uint64_t>(i) + 1) - 0.5);
  }
  // Four standard errors.
  EXPECT_NEAR(sum / count, 0.5, 4 * std::sqrt(1.0 / 12 / count));
  EXPECT_NEAR(squares / count, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / count));
  EXPECT_NEAR(neighbours / count, 0, 4 * 1.0 / 12 / std::sqrt(count));
}

// ---- errors of several tables

TEST_F(SweepGridFile, ErrorsNameTheTable) {
  EXPECT_THAT(failure(heights("[1, 2]") + heights("[3, 4]")),
              StartsWith("bumps.toml:34: sweep.1.key: \"relief.height\" found, but the table above "
                         "sets"));
  EXPECT_THAT(failure(heights("[1, 2]") +
                      table("light.0.elevation", "values = [1, 2, 3]\nwith = \"relief.height\"")),
              StartsWith("bumps.toml:35: sweep.1.values: 3 values found, as many as of "
                         "relief.height expected: 2"));
  EXPECT_THAT(failure(heights("[1, 2]") +
                      table("light.0.elevation", "values = [1, 2]\nwith = \"relief.hight\"")),
              StartsWith("bumps.toml:36: sweep.1.with: \"relief.hight\" found"));
  EXPECT_THAT(failure(heights("[1, 2]") + table("bake.bits", "values = [8, 12]")),
              AllOf(StartsWith("bumps.toml:34: sweep.1.key: with bake.bits=12: "),
                    HasSubstr("one of 8, 16, 32 expected")));
  EXPECT_THAT(failure(heights("[1, 2]") + table("relief.wdth", "values = [1, 2]")),
              StartsWith("bumps.toml:34: sweep.1.key: with relief.wdth=1: "));
  EXPECT_THAT(failure("[[sweep]]\nkey = \"relief.height\"\nvalues = [1, 2]\nstep = 1\n"),
              StartsWith("bumps.toml:33: sweep.0.step: unknown key"));
  EXPECT_THAT(failure(heights("[2, 4, 2]") +
                      table("bake.bits", "values = [8, 16, 8]\nwith = \"relief.height\"")),
              StartsWith("bumps.toml:35: sweep.1.values: 2 with 8 found twice"));
}

TEST_F(SweepGridFile, RefusesTooManyCasesWithTheirNumber) {
  EXPECT_THAT(failure(heights("\"1:1000:1\"") + elevations("\"0.01:80:0.01\"")),
              HasSubstr("8000000 cases found over all tables, at most 100000 expected"));
}

}  // namespace
}  // namespace gnomon::study
