#include "study/spec/sweep/sweep.h"
#include "study/judge/gates.h"
#include "study/judge/ranking.h"

#include <gmock/gmock.h>

#include <fstream>

#include "common/error.h"
#include "support/columns_study.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::study {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string sweptStudy = test::planeStudy("bumps") + R"(
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

[[claim]]
text = "Ours is better"
source = "us"
less = "ours"
than = "max-forsyth"
)";

/// The section begins on line 37.
constexpr const char* sweep = R"(
[sweep]
key = "relief.height"
values = [2, 0.25, 8]
axis = "height, world units"
)";

/// What the cases give to a key.
std::vector<double> numbers(const StudyPlan& plan, std::size_t key = 0) {
  std::vector<double> values;
  for (const SweepCase& which : plan.sweep->cases) {
    values.push_back(which.values.at(key).number.value());
  }
  return values;
}

class SweepFile : public TemporaryFolder {
 protected:
  StudyPlan read(const std::string& text, const StudyOptions& options = {}) {
    std::ofstream(file("bumps.toml"), std::ios::binary) << text;
    return readStudyPlan(file("bumps.toml"), options);
  }
  /// The error's message, without the folder.
  template <typename ErrorType = InputError>
  std::string failure(const std::string& section, const StudyOptions& options = {}) {
    return withoutFolder(messageOf<ErrorType>([&] { (void)read(sweptStudy + section, options); }));
  }
  static std::string section(const std::string& key, const std::string& values) {
    return "\n[sweep]\nkey = \"" + key + "\"\nvalues = " + values + "\n";
  }
};

TEST_F(SweepFile, IsOneStudyAValueInTheirOrder) {
  const StudyPlan plan = read(sweptStudy + sweep);
  EXPECT_EQ(plan.name, "bumps");
  EXPECT_EQ(plan.title, "Columns on a plane");
  ASSERT_TRUE(plan.sweep);
  ASSERT_EQ(plan.sweep->keys.size(), 1U);
  EXPECT_EQ(plan.sweep->keys[0].key, "relief.height");
  EXPECT_EQ(plan.sweep->keys[0].axis, "height, world units");
  EXPECT_THAT(numbers(plan), ElementsAre(2, 0.25, 8));
  ASSERT_EQ(plan.steps.size(), 3U);
  EXPECT_EQ(plan.steps[0].name, "bumps/2");
  EXPECT_EQ(plan.steps[1].name, "bumps/0.25");
  EXPECT_EQ(plan.steps[1].title, "Columns on a plane, relief.height = 0.25");
  EXPECT_EQ(plan.steps[1].sweepCases, plan.steps.size());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_FLOAT_EQ(plan.steps[i].relief.field.maximum() / plan.steps[0].relief.field.maximum(),
                    static_cast<float>(numbers(plan)[i] / 2));
    EXPECT_EQ(plan.steps[i].claims.size(), 1U);
  }
}

TEST_F(SweepFile, AFileWithoutOneIsOneStudy) {
  const StudyPlan plan = read(sweptStudy);
  EXPECT_FALSE(plan.sweep);
  ASSERT_EQ(plan.steps.size(), 1U);
  EXPECT_EQ(plan.steps[0].name, "bumps");
  EXPECT_EQ(plan.steps[0].sweepCases, 1U);
  EXPECT_EQ(plan.name, "bumps");
}

TEST_F(SweepFile, TakesAnyKeyThatAnOverrideTakes) {
  const StudyPlan lights = read(sweptStudy + section("light.0.elevation", "[20, 60]"));
  EXPECT_DOUBLE_EQ(lights.steps[0].lights[0].angles.elevation, 20.0);
  EXPECT_DOUBLE_EQ(lights.steps[1].lights[0].angles.elevation, 60.0);
  EXPECT_EQ(lights.sweep->keys[0].axis, "light.0.elevation");
  const StudyPlan added = read(sweptStudy + section("bake.azimuths", "[8, 16]"));
  EXPECT_EQ(added.steps[0].bake.settings.azimuths, 8);
  EXPECT_EQ(added.steps[1].bake.settings.azimuths, 16);
}

TEST_F(SweepFile, KeepsWhatTheCommandLineChanges) {
  const StudyPlan plan = read(sweptStudy + sweep, {{"bake.azimuths=4"}, {"ours"}, true});
  for (const StudySpec& step : plan.steps) {
    EXPECT_EQ(step.bake.settings.azimuths, 4);
    EXPECT_EQ(step.methods.size(), 1U);
    EXPECT_EQ(std::get<AtlasSpec>(step.views[0].kind).samplesPerSide, 3)
        << "odd, near a quarter of 8";
  }
  const StudyPlan others = read(sweptStudy + sweep, {{"sweep.values=[1, 3]"}, {}, false});
  EXPECT_THAT(numbers(others), ElementsAre(1, 3));
}

TEST_F(SweepFile, RefusesAKeyThatTheFileCannotHave) {
  EXPECT_THAT(failure(section("relief.hight", "[1, 2]")),
              AllOf(StartsWith("bumps.toml:38: sweep.key: with relief.hight=1: "),
                    HasSubstr("unknown key")));
  EXPECT_THAT(failure(section("releif.height", "[1, 2]")),
              AllOf(StartsWith("bumps.toml:38: sweep.key: with releif.height=1: releif"),
                    HasSubstr("unknown key")));
  EXPECT_THAT(failure(section("light.3.elevation", "[1, 2]")),
              AllOf(StartsWith("bumps.toml:38: sweep.key: with light.3.elevation=1: "),
                    HasSubstr("there is no `light.3`")));
  EXPECT_THAT(failure(section("study.name", "[1, 2]")),
              StartsWith("bumps.toml:38: sweep.key: \"study.name\" found"));
}

TEST_F(SweepFile, RefusesValuesThatAreNone) {
  EXPECT_THAT(failure(section("relief.height", "[]")),
              AllOf(StartsWith("bumps.toml:39: sweep.values: "), HasSubstr("at least one")));
  EXPECT_THAT(failure(section("relief.height", "[1, 2, 1.0]")),
              StartsWith("bumps.toml:39: sweep.values: 1 found twice"));
  for (const char* one : {"[3]", "3"}) {
    EXPECT_THAT(failure(section("relief.height", one)),
                StartsWith("bumps.toml:39: sweep.values: one value found, at least two"));
  }
  EXPECT_THAT(failure(section("relief.height", "[1, \"two\"]")),
              StartsWith("bumps.toml:39: sweep.values: the string \"two\" found"));
}

TEST_F(SweepFile, RefusesKeysOfItsOwnThatDoNotExist) {
  EXPECT_THAT(failure(std::string(sweep) + "label = \"x\"\n"),
              StartsWith("bumps.toml:41: sweep.label: unknown key"));
  EXPECT_THAT(failure("\n[sweep]\nvalues = [1, 2]\n"), HasSubstr("sweep.key: missing"));
}

TEST_F(SweepFile, IsNotOverriddenInSilence) {
  EXPECT_THAT(failure(sweep, {{"relief.height=3"}, {}, false}),
              StartsWith("bumps.toml:38: sweep.key: \"relief.height\" found, but --set"));
}

TEST_F(SweepFile, IsNotBlamedForOtherErrors) {
  const std::string broken = std::string(sweep) + "\n[[view]]\ntype = \"atlas\"\nsamples = 0\n";
  EXPECT_THAT(failure(broken), StartsWith("bumps.toml:44: view.1.samples: 0 found"));
  EXPECT_THAT(failure<UsageError>(sweep, {{"light.5.azimuth=1"}, {}, false}),
              StartsWith("--set light.5.azimuth=1"));
  EXPECT_THAT(failure(sweep, {{"surface.sise=1"}, {}, false}),
              StartsWith("bumps.toml: surface.sise: unknown key"));
}

TEST_F(SweepFile, RecordHoldsThePlanAndItsSteps) {
  const StudyPlan plan = read(sweptStudy + sweep);
  std::vector<StudyRecord> steps(3);
  for (StudyRecord& step : steps) step.claims = {{"Ours is better", "us", Verdict::held, ""}};
  const auto atMost = [](double limit) {
    return judge({"ours", "l", "v", "all", "error_rate", {}, limit}, {"error_rate", 0.2, {}});
  };
  steps[1].judgements = {atMost(0.1)};
  const SweepRecord record = makeSweepRecord(plan, steps, "gnomon run bumps.toml");
  EXPECT_EQ(record.name, "bumps");
  EXPECT_EQ(record.keys.at(0).key, "relief.height");
  EXPECT_EQ(record.cases.at(1).name, "0.25");
  EXPECT_EQ(record.command, "gnomon run bumps.toml");
  EXPECT_EQ(record.claims.at(0).verdict, Verdict::held);
  EXPECT_EQ(record.copy, "bumps.toml");
  EXPECT_EQ(record.status(), RunStatus::fail) << "one gate failed in one step";
  steps[1].judgements = {atMost(0.3)};
  EXPECT_EQ(makeSweepRecord(plan, steps, "").status(), RunStatus::pass);
  steps[1].judgements.clear();
  EXPECT_EQ(makeSweepRecord(plan, steps, "").status(), RunStatus::notJudged);
  steps.pop_back();
  EXPECT_THROW(makeSweepRecord(plan, steps, ""), InternalError);
}

}  // namespace
}  // namespace gnomon::study
