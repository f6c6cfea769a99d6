#include "study/spec/ladder_section.h"

#include <gmock/gmock.h>

#include <fstream>

#include "common/error.h"
#include "support/error_messages.h"
#include "support/replaced.h"
#include "support/temporary_folder.h"

namespace gnomon {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* ladderStudy = R"([study]
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

class LadderSection : public TemporaryFolder {
 protected:
  StudySpec read(const std::string& text, const StudyOptions& options = {}) {
    std::ofstream(file("bumps.toml"), std::ios::binary) << text;
    return readStudy(file("bumps.toml"), options);
  }
  std::string failure(const std::string& section) {
    std::string message = messageOf<InputError>([&] { (void)read(ladderStudy + section); });
    const std::string prefix = folder().string() + "/";
    for (std::size_t at = 0; (at = message.find(prefix)) != std::string::npos;) {
      message.erase(at, prefix.size());
    }
    return message;
  }
};

TEST_F(LadderSection, UndoesOneCauseAfterTheOtherBothWays) {
  const StudySpec spec = read(std::string(ladderStudy) + ladder);
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
  EXPECT_EQ(read(std::string(ladderStudy) + ladder, {{}, {"old"}, false}).ladders.size(), 1U);
  EXPECT_TRUE(
      read(std::string(ladderStudy) + ladder, {{}, {"resampled-horizon"}, false}).ladders.empty());
}

TEST_F(LadderSection, ErrorsNameFileLineAndKey) {
  const auto with = [&](const std::string& from, const std::string& to) {
    return failure(test::replaced(ladder, from, to));
  };
  EXPECT_EQ(
      with("\"old\"", "\"older\""),
      "bumps.toml:35: ladder.0.method: \"older\" found, one of old, resampled-horizon expected");
  EXPECT_THAT(with("cause = \"mesh\"", "cause = \"azimuths\""),
              AllOf(StartsWith("bumps.toml:47: ladder.0.rung.2.cause: "), HasSubstr("twice")));
  EXPECT_THAT(
      with("azimuths = 64", "azimuths = 8"),
      AllOf(StartsWith("bumps.toml:40: ladder.0.rung.0.set: "), HasSubstr("changes nothing")));
  EXPECT_THAT(with("set = { base = { subdivisions = 2 } }", "set = {}"),
              AllOf(StartsWith("bumps.toml:48: "), HasSubstr("changes nothing")));
  EXPECT_THAT(with("set = { base = { subdivisions = 2 } }", ""), HasSubstr("ladder.0.rung.2.set"));
  EXPECT_THAT(with("azimuths = 64", "azimuth = 64"),
              AllOf(StartsWith("bumps.toml:40: ladder.0.rung.0.set.bake"), HasSubstr("azimuth")));
  EXPECT_THAT(with("set = { base", "set = { lid = 1, base"),
              AllOf(StartsWith("bumps.toml:48: ladder.0.rung.2.set.lid"), HasSubstr("unknown")));
  EXPECT_THAT(with("stride = 0.5", "strides = 0.5"),
              AllOf(StartsWith("bumps.toml:44: ladder.0.rung.1.set.parameters.strides: "),
                    HasSubstr("one of stride expected")));
  EXPECT_THAT(with("stride = 0.5", "stride = 50"),
              AllOf(StartsWith("bumps.toml:44: "), HasSubstr("50 found, 0.01 to 8 expected")));
  EXPECT_THAT(with("\"osculating-march\"", "\"march\""),
              AllOf(StartsWith("bumps.toml:44: ladder.0.rung.1.set.name"), HasSubstr("march")));
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
      AllOf(StartsWith("bumps.toml:"), HasSubstr("rungs change the same keys")));
  const std::string camera =
      test::replaced(std::string(ladderStudy) + ladder, "type = \"atlas\"\nsamples = 8",
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
}  // namespace gnomon
