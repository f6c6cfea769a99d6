#include <gmock/gmock.h>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

class CommandLine : public EndToEnd {};

TEST_F(CommandLine, ListNamesMethodsShapesPatternsAndMetrics) {
  const Outcome outcome = gnomon({"list"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* name : {"unshadowed", "max-forsyth", "onoue-2004", "Blinn 1978", "bezier",
                           "sphere", "columns", "ripples", "error_rate", "mcc"}) {
    EXPECT_THAT(outcome.out, HasSubstr(name));
  }
}

TEST_F(CommandLine, HelpAndVersion) {
  const Outcome help = gnomon({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.err, "");
  EXPECT_THAT(help.out, AllOf(HasSubstr("run"), HasSubstr("check"), HasSubstr("bake"),
                              HasSubstr("list"), HasSubstr("--threads")));
  for (const char* command : {"run", "check"}) {
    const Outcome outcome = gnomon({command, "--help"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("--out"), HasSubstr("--set"), HasSubstr("--method"),
                                   HasSubstr("--quick"), HasSubstr("Examples:")));
  }
  EXPECT_THAT(gnomon({"check", "--help"}).out, HasSubstr("1 one failed"));
  for (const char* command : {"bake", "compare", "truth", "export"}) {
    const Outcome outcome = gnomon({command, "--help"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("Example"), HasSubstr(command)));
    EXPECT_THAT(help.out, HasSubstr(command));
  }
  const Outcome version = gnomon({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST_F(CommandLine, AMistypedOptionOrCommandGetsTheNearest) {
  const auto refusal = [&](const std::vector<std::string>& words) {
    const Outcome outcome = gnomon(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(refusal({"compare", "a.png", "b.png", "--diff", "d.png"}),
              HasSubstr("; did you mean --difference?"));
  EXPECT_THAT(refusal({"check", "--juint=x.xml"}), HasSubstr("; did you mean --junit?"));
  EXPECT_THAT(refusal({"--thread", "1", "list"}), HasSubstr("; did you mean --threads?"));
  EXPECT_THAT(refusal({"chekc", "a.toml"}), HasSubstr("; did you mean check?"));
  EXPECT_THAT(refusal({"frobnicate"}),
              AllOf(HasSubstr("frobnicate; one of bake, cache, check, compare, "),
                    HasSubstr(", view expected. See gnomon --help")));
  EXPECT_THAT(refusal({"list", "--frobnicate"}), HasSubstr("--frobnicate. See gnomon --help"));
}

// It is invalid, as the XDG Base Directory Specification has it: neither the cache nor a library
// that the program loads makes it in the working folder, or says that it could not.
TEST_F(CommandLine, ARelativeCacheFolderIsIgnored) {
  write("small.toml", smallStudy());
  const std::string home = file("home").string();
  const Outcome outcome =
      gnomon({"run", "small.toml"}, {"GNOMON_CACHE=", "XDG_CACHE_HOME=caches", "HOME=" + home});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_FALSE(std::filesystem::exists(file("caches")));
  EXPECT_TRUE(std::filesystem::exists(file("home/.cache/gnomon")));
}

TEST_F(CommandLine, SetChangesTheStudyAndIsRecorded) {
  runStudy("small", smallStudy());
  const double before =
      resultOf(summary("small"), "unshadowed", "evening", "camera").at("prevalence");
  runStudy("small", smallStudy(), {"--set", "light.0.elevation=60", "--set", "bake.bits=16"});
  const double after =
      resultOf(summary("small"), "unshadowed", "evening", "camera").at("prevalence");
  // Shadows are as long as the cotangent of the elevation: tan 60° / tan 30° = 3 times shorter.
  EXPECT_LT(after, before);
  EXPECT_THAT(summary("small").at("study").at("command").get<std::string>(),
              HasSubstr("--set light.0.elevation=60 --set bake.bits=16"));
  // 32² texels, 8 azimuths, 2 bytes.
  EXPECT_EQ(summary("small").at("cost").at(1).at("table_bytes"), 32 * 32 * 8 * 2);
}

TEST_F(CommandLine, MethodKeepsOnlyThatMethod) {
  runStudy("small", smallStudy(), {"--method", "max-forsyth"});
  const nlohmann::json json = summary("small");
  ASSERT_EQ(json.at("methods").size(), 1U);
  EXPECT_EQ(json.at("methods").at(0).at("label"), "max-forsyth");
  EXPECT_FALSE(json.at("results").empty());
  for (const nlohmann::json& result : json.at("results")) {
    EXPECT_EQ(result.at("method"), "max-forsyth");
  }
}

TEST_F(CommandLine, QuickTakesAQuarterOfTheSides) {
  runStudy("small", replaced(smallStudy(), "step = 0.25", "step = 0.125"), {"--quick"});
  EXPECT_EQ(mask("small", "camera_evening_truth").width, 16);
  EXPECT_EQ(summary("small").at("truth").at("step_texels"), 0.5);
}

TEST_F(CommandLine, TheTableOnTheTerminalHasTheFigures) {
  write("small.toml", smallStudy());
  const Outcome outcome = gnomon({"run", "small.toml"});
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("Columns on a plane"), HasSubstr("max-forsyth"),
                                 HasSubstr("Report: out/small/report.html")));
  EXPECT_EQ(outcome.out.find('\033'), std::string::npos) << "no colours where there is no terminal";
}

TEST_F(CommandLine, BakeWritesTheTables) {
  write("small.toml", smallStudy());
  const Outcome outcome = gnomon({"bake", "small.toml", "--set", "bake.azimuths=16"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("out/small/tables.exr: 32 × 32 texels, 16 azimuths"));
  // Two tables of a byte.
  EXPECT_THAT(outcome.out, HasSubstr("32.8 kB in 8 bits"));
  EXPECT_EQ(filesBelow("out"), std::vector<std::string>{"small/tables.exr"});
}

}  // namespace
}  // namespace gnomon::test
