#include "report/plots/study_plots.h"

#include <gmock/gmock.h>

#include <string>

#include "report/sample_record.h"

namespace gnomon::report {
namespace {

using test::countsOf;
using test::result;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A step in which "flat" errs in as many of 1000 samples under each light.
study::StudyRecord stepOf(const std::vector<std::pair<std::string, double>>& lights) {
  study::StudyRecord record = test::emptyRecord();
  record.methods.push_back({"flat", "flat", "", ""});
  for (const auto& [light, error] : lights) {
    record.results.push_back(result("flat", light, "camera", "all", countsOf(1000, error, 0)));
  }
  return record;
}

/// A grid of a × b cases, of which the first key changes slowest; case (i, j) errs in 10 i + j
/// thousandths.
study::SweepRecord gridSweep(const std::vector<double>& a, const std::vector<double>& b) {
  study::SweepRecord sweep;
  sweep.name = "grid";
  sweep.keys = {{"relief.height", "height", 0}, {"bake.bits", "bits", 1}};
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      sweep.cases.push_back({std::to_string(sweep.cases.size()),
                             {study::sweptNumber(a[i]), study::sweptNumber(b[j])}});
      sweep.steps.push_back(
          stepOf({{"noon", 10.0 * static_cast<double>(i) + static_cast<double>(j)}}));
    }
  }
  return sweep;
}

TEST(SweepSlices, ValuesOfOneRatioHaveALogarithmicAxis) {
  const auto axisOf = [](const std::vector<double>& positions) {
    SweepSlice slice;
    slice.positions = positions;
    return axisCommands(slice);
  };
  const std::string even = "set autoscale xfix\n";
  EXPECT_EQ(axisOf({1, 2.52, 6.35, 16}), even + "set logscale x\n");
  EXPECT_EQ(axisOf({1, 2, 3, 4}), even);
  EXPECT_EQ(axisOf({1, 2, 4}), even);         // three say little
  EXPECT_EQ(axisOf({-8, -4, -2, -1}), even);  // of one ratio, but without a logarithm
  EXPECT_EQ(axisOf({0, 1, 2, 4}), even);
  SweepSlice named;
  named.positions = {1, 2, 4, 8};
  named.categories = {"a", "b", "c", "d"};
  EXPECT_THAT(axisCommands(named), HasSubstr("set xtics ("));
}

TEST(SweepSlices, OneDimensionIsOneSliceInTheOrderOfItsValues) {
  study::SweepRecord sweep = gridSweep({3, 1, 2}, {8});
  for (study::SweepCase& which : sweep.cases) which.values.pop_back();
  sweep.keys.pop_back();
  const auto slices = slicesOf(sweep);
  ASSERT_EQ(slices.size(), 1U);
  EXPECT_THAT(slices[0].cases, ElementsAre(1, 2, 0));
  EXPECT_THAT(slices[0].positions, ElementsAre(1, 2, 3));
  EXPECT_EQ(slices[0].suffix, "");
  EXPECT_EQ(slices[0].axis, "height");
}

TEST(SweepSlices, OfTwoDimensionsTheOneOfFewerValuesCuts) {
  const auto slices = slicesOf(gridSweep({1, 2, 3}, {16, 8}));
  ASSERT_EQ(slices.size(), 2U);
  EXPECT_EQ(slices[0].title, "bake.bits = 8");
  EXPECT_THAT(slices[0].cases, ElementsAre(1, 3, 5));
  EXPECT_THAT(slices[1].cases, ElementsAre(0, 2, 4));
  EXPECT_EQ(slices[1].suffix, "_2");
  const auto turned = slicesOf(gridSweep({1, 2}, {8, 16, 32}));
  ASSERT_EQ(turned.size(), 2U);
  EXPECT_EQ(turned[1].title, "relief.height = 2");
  EXPECT_EQ(turned[1].axis, "bits");
  EXPECT_THAT(turned[1].cases, ElementsAre(3, 4, 5));
}

TEST(SweepSlices, KeysThatStepTogetherAreOneAxis) {
  study::SweepRecord sweep = gridSweep({1, 2, 3}, {8});
  for (study::SweptKey& key : sweep.keys) key.dimension = 0;
  // The first key repeats a value: the second tells the cases apart.
  sweep.cases[0].values = {study::sweptNumber(1), study::sweptNumber(30)};
  sweep.cases[1].values = {study::sweptNumber(1), study::sweptNumber(10)};
  sweep.cases[2].values = {study::sweptNumber(2), study::sweptNumber(20)};
  const auto slices = slicesOf(sweep);
  ASSERT_EQ(slices.size(), 1U);
  EXPECT_EQ(slices[0].axis, "bits, with height");
  EXPECT_THAT(slices[0].cases, ElementsAre(1, 2, 0));
}

TEST(SweepSlices, TextsAreCategories) {
  study::SweepRecord sweep = gridSweep({1, 2}, {8});
  sweep.keys.pop_back();
  sweep.cases[0].values = {{"columns", {}, "\"columns\""}};
  sweep.cases[1].values = {{"cells", {}, "\"cells\""}};
  const auto slices = slicesOf(sweep);
  ASSERT_EQ(slices.size(), 1U);
  EXPECT_THAT(slices[0].categories, ElementsAre("columns", "cells"));
  EXPECT_THAT(slices[0].positions, ElementsAre(0, 1));
  EXPECT_EQ(axisCommands(slices[0]), "set xtics ('columns' 0, 'cells' 1)\n");
}

TEST(SweepSlices, ManyDimensionsHaveNone) {
  study::SweepRecord sweep = gridSweep({1, 2}, {8, 16});
  sweep.keys.push_back({"bake.azimuths", "azimuths", 2});
  for (study::SweepCase& which : sweep.cases) which.values.push_back(study::sweptNumber(4));
  EXPECT_THAT(slicesOf(sweep), IsEmpty());
}

}  // namespace
}  // namespace gnomon::report
