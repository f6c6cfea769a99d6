#include "report/suite/suite_settings.h"

#include <gtest/gtest.h>

#include "common/files/atomic_file.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::report {
namespace {
using ::testing::HasSubstr;
using ::testing::Not;

/// A list of methods and the errors of its entries on three scenes.
class SuiteSettings : public TemporaryFolder {
 protected:
  void SetUp() override {
    writeTextAtomically(file("methods.toml"), R"([[method]]
name = "plain"

[[method]]
name = "table"
bake = { azimuths = 32 }
vary = { "bake.azimuths" = [16, 64], "parameters.steps" = [0.5] }

[[method]]
name = "volume"
vary = { "base.subdivisions" = [5] }
)");
    methods_ = study::readSuiteMethods(file("methods.toml"), {});
    train_.scenes = {"one", "two", "three"};
    train_.uncertainty = {0, 0, 0};
    add("plain", {0.5, 0.5, 0.5});
    add("table", {0.3, 0.1, 0.2});
    add("table, azimuths 16", {0.4, 0.1, 0.1});
    add("table, azimuths 64", {0.1, 0.2, 0.1});
    add("table, steps 0.5", {0.1, 0.1, 0.4});
    add("volume", {{}, 0.2, 0.2});
    add("volume, subdivisions 5", {0.1, 0.2, 0.2});
  }
  void add(const std::string& label, const std::vector<std::optional<double>>& errors) {
    train_.methods.push_back(label);
    train_.errors.push_back(errors);
  }

  study::SuiteMethods methods_;
  compare::SceneTable train_;
};

TEST_F(SuiteSettings, HaveTheLeastMeanOverTheScenesOfAllTheirValues) {
  const auto tried = study::triedSettings(methods_, train_);
  ASSERT_EQ(tried.size(), 3U);
  EXPECT_EQ(tried[0].key, "bake.azimuths");
  EXPECT_EQ(tried[0].values.front().value, "32");
  EXPECT_EQ(tried[0].scenes, 3U);
  EXPECT_EQ(tried[0].best, 2U);
  EXPECT_NEAR(tried[0].values[2].mean, 0.4 / 3, 1e-15);
  // Of equal means the authors' value stays.
  EXPECT_EQ(tried[1].values.front().value, "");
  EXPECT_EQ(tried[1].best, 0U);
  // On the scene that one value lacks, no value counts.
  EXPECT_EQ(tried[2].scenes, 2U);
  EXPECT_EQ(tried[2].best, 0U);
}

TEST_F(SuiteSettings, AreReadByTheNextSuite) {
  const auto tried = study::triedSettings(methods_, train_);
  const std::string text = chosenSettingsText(methods_, tried, "suite-t, 3 scenes");
  EXPECT_THAT(text, HasSubstr("# table, bake.azimuths: 32 20.00 %, 16 20.00 %, 64 13.33 % "
                              "(chosen); 3 scenes\n"));
  writeTextAtomically(file("chosen.toml"), text);
  const auto read = study::readSuiteMethods(file("methods.toml"), file("chosen.toml"));
  ASSERT_EQ(read.chosen.size(), 1U);
  EXPECT_EQ(read.chosen[0]["label"].value<std::string>(), "table, chosen");
  EXPECT_EQ(read.chosen[0]["bake"]["azimuths"].value<int>(), 64);
  EXPECT_FALSE(read.chosen[0].contains("parameters"));
}

TEST_F(SuiteSettings, MayAllBeTheAuthors) {
  for (auto& errors : train_.errors) errors = {0.1, 0.1, 0.1};
  const auto tried = study::triedSettings(methods_, train_);
  const std::string text = chosenSettingsText(methods_, tried, "suite-t, 3 scenes");
  EXPECT_THAT(text, Not(HasSubstr("[[method]]")));
  writeTextAtomically(file("chosen.toml"), text);
  EXPECT_TRUE(study::readSuiteMethods(file("methods.toml"), file("chosen.toml")).chosen.empty());
}

TEST_F(SuiteSettings, NeedEveryEntryOfTheList) {
  train_.methods.pop_back();
  train_.errors.pop_back();
  EXPECT_THAT(messageOf<InputError>([&] { study::triedSettings(methods_, train_); }),
              HasSubstr("\"volume, subdivisions 5\" not found among the methods of these scenes"));
  add("volume, subdivisions 5", {0.1, {}, {}});
  EXPECT_THAT(messageOf<InputError>([&] { study::triedSettings(methods_, train_); }),
              HasSubstr("\"volume\": no scene has an error for every value of base.subdivisions"));
}

}  // namespace
}  // namespace gnomon::report
