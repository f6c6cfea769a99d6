#include "study/spec/study_file.h"

#include <gmock/gmock.h>

#include "study/spec/study_file_fixture.h"

namespace gnomon::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string ladderStudy = test::planeStudy("plain") + R"(
[bake]
azimuths = 8

[[view]]
type = "atlas"
samples = 8

[[light]]
elevation = 30

[[method]]
name = "onoue-2004"
label = "old"

[[method]]
name = "resampled-horizon"
)";

/// Begins on line 34.
constexpr const char* ladder = R"(
[[ladder]]
method = "old"

[[ladder.rung]]
cause = "azimuths"
change = "64"
set = { bake = { azimuths = 64 } }

[[ladder.rung]]
cause = "method"
set = { name = "osculating-march", parameters = { stride = 0.5 } }

[[ladder.rung]]
cause = "mesh"
set = { base = { subdivisions = 2 } }
)";

class LadderSection : public StudyFile {
 protected:
  std::string failure(const std::string& section) {
    return StudyFile::failure(ladderStudy + section);
  }
};

TEST_F(LadderSection, UndoesOneCauseAfterTheOtherBothWays) {
  const StudySpec spec = read(ladderStudy + ladder);
  ASSERT_EQ(spec.ladders.size(), 1U);
  const LadderSpec& read = spec.ladders.front();
  EXPECT_EQ(read.method, "old");
  ASSERT_EQ(read.causes.size(), 3U);
  EXPECT_EQ(read.causes[0].name, "azimuths");
  EXPECT_EQ(read.causes[0].change, "64");
  EXPECT_EQ(read.causes[1].change, "");
  const auto state = [](const MethodSpec& method) {
    return std::tuple(method.file.stem().string(), method.bake.settings.azimuths,
                      method.base.subdivisions, method.parameters.size());
  };
  using State = std::tuple<std::string, int, int, std::size_t>;
  ASSERT_EQ(read.forward.size(), 4U);
  EXPECT_EQ(state(read.forward[0]), State("onoue-2004", 8, 1, 0));
  EXPECT_EQ(state(read.forward[1]), State("onoue-2004", 64, 1, 0));
  EXPECT_EQ(state(read.forward[2]), State("osculating-march", 64, 1, 1));
  EXPECT_EQ(state(read.forward[3]), State("osculating-march", 64, 2, 1));
  ASSERT_EQ(read.backward.size(), 4U);
  EXPECT_EQ(state(read.backward[0]), State("onoue-2004", 8, 1, 0));
  EXPECT_EQ(state(read.backward[1]), State("onoue-2004", 8, 2, 0));
  EXPECT_EQ(state(read.backward[2]), State("osculating-march", 8, 2, 1));
  EXPECT_TRUE(isSameMethod(read.backward[3], read.forward[3]));
  EXPECT_FALSE(isSameMethod(read.backward[2], read.forward[3]));
}

TEST_F(LadderSection, GoesWithItsMethod) {
  EXPECT_EQ(read(ladderStudy + ladder, {{}, {"old"}, false}).ladders.size(), 1U);
  EXPECT_TRUE(read(ladderStudy + ladder, {{}, {"resampled-horizon"}, false}).ladders.empty());
}

TEST_F(LadderSection, ErrorsNameFileLineAndKey) {
  const auto with = [&](const std::string& from, const std::string& to) {
    return failure(test::replaced(ladder, from, to));
  };
  EXPECT_EQ(
      with("\"old\"", "\"older\""),
      "plain.toml:35: ladder.0.method: \"older\" found, one of old, resampled-horizon expected");
  EXPECT_THAT(with("cause = \"mesh\"", "cause = \"azimuths\""),
              AllOf(StartsWith("plain.toml:47: ladder.0.rung.2.cause: "), HasSubstr("twice")));
  EXPECT_THAT(
      with("azimuths = 64", "azimuths = 8"),
      AllOf(StartsWith("plain.toml:40: ladder.0.rung.0.set: "), HasSubstr("changes nothing")));
  EXPECT_THAT(with("set = { base = { subdivisions = 2 } }", "set = {}"),
              AllOf(StartsWith("plain.toml:48: "), HasSubstr("changes nothing")));
  EXPECT_THAT(with("set = { base = { subdivisions = 2 } }", ""), HasSubstr("ladder.0.rung.2.set"));
  EXPECT_THAT(with("azimuths = 64", "azimuth = 64"),
              AllOf(StartsWith("plain.toml:40: ladder.0.rung.0.set.bake"), HasSubstr("azimuth")));
  EXPECT_THAT(with("set = { base", "set = { lid = 1, base"),
              AllOf(StartsWith("plain.toml:48: ladder.0.rung.2.set.lid"), HasSubstr("unknown")));
  EXPECT_THAT(with("stride = 0.5", "strides = 0.5"),
              AllOf(StartsWith("plain.toml:44: ladder.0.rung.1.set.parameters.strides: "),
                    HasSubstr("one of stride expected")));
  EXPECT_THAT(with("stride = 0.5", "stride = 50"),
              AllOf(StartsWith("plain.toml:44: "), HasSubstr("50 found, 0.01 to 8 expected")));
  EXPECT_THAT(with("\"osculating-march\"", "\"march\""),
              AllOf(StartsWith("plain.toml:44: ladder.0.rung.1.set.name"), HasSubstr("march")));
  EXPECT_THAT(with("cause = \"method\"", ""), HasSubstr("ladder.0.rung.1.cause: missing"));
  EXPECT_THAT(with("cause = \"method\"", "why = \"method\""),
              HasSubstr("ladder.0.rung.1.why: unknown key, expected cause, change, set"));
}

TEST_F(LadderSection, RefusesWhatCannotBeAttributed) {
  EXPECT_THAT(failure(std::string(ladder) + ladder), HasSubstr("\"old\" has another ladder"));
  EXPECT_THAT(failure("\n[[ladder]]\nmethod = \"old\"\n"), HasSubstr("ladder.0.rung"));
  EXPECT_THAT(
      failure(std::string(ladder) + "\n[[ladder.rung]]\ncause = \"again\"\nset = { bake = { "
                                    "azimuths = 16 } }\n"),
      AllOf(StartsWith("plain.toml:"), HasSubstr("rungs change the same keys")));
  const std::string camera =
      test::replaced(ladderStudy + ladder, "type = \"atlas\"\nsamples = 8",
                     "type = \"camera\"\neye = [0, 0, 90]\nwidth = 8\nheight = 8");
  EXPECT_THAT(messageOf<InputError>([&] { (void)read(camera); }), HasSubstr("type atlas"));
}

TEST_F(LadderSection, OfTheErrorBudgetIsWhole) {
  const StudySpec spec = readStudy(std::string(GNOMON_SCENES) + "/error-budget.toml");
  ASSERT_EQ(spec.ladders.size(), 3U);
  const LadderSpec& flat = spec.ladders[0];
  const LadderSpec& curved = spec.ladders[1];
  ASSERT_EQ(flat.causes.size(), curved.causes.size() + 1);
  EXPECT_TRUE(isSameMethod(flat.forward.back(), curved.forward.back()) ||
              flat.forward.back().parameters.at("curved") == 1);
}

}  // namespace
}  // namespace gnomon::study
