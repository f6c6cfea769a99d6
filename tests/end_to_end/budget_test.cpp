#include <gmock/gmock.h>

#include <cmath>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Columns on a small sphere; occluders farther than 8 texels are distant.
std::string budgetStudy() {
  return R"([study]
name = "budget"
title = "Columns"
source = "a test"
frames = 0
[surface]
shape = "sphere"
curvature = 0.02
size = [48, 48]
quads = [24, 24]

[relief]
pattern = "columns"
texels = [48, 48]
period = 16
radius = 4
height = 5
height_space = "world"
wrap = "clamp"

[bake]
azimuths = 8
radius = 8

[[view]]
type = "atlas"
samples = 7

[[light]]
azimuth = 20
elevation = [40, 15]

[[method]]
name = "max-forsyth"

[[method]]
name = "onoue-2004"
)";
}

std::string ladderOf(const std::string& method, const std::string& start) {
  return "\n[[ladder]]\nmethod = \"" + method + "\"\nfile = \"" + GNOMON_SCENES +
         "/methods/horizon-ladder.glsl\"\n" + start + R"(
[[ladder.rung]]
cause = "azimuths"
set = { bake = { azimuths = 64 } }

[[ladder.rung]]
cause = "interpolation"
set = { parameters = { resampled = 1 } }

[[ladder.rung]]
cause = "mesh"
set = { base = { subdivisions = 2 } }
)";
}

double shareOf(const nlohmann::json& part) {
  return part.at("share").get<double>();
}

class BudgetRun : public EndToEnd {};

TEST_F(BudgetRun, AddsUpToTheErrorOfTheMethod) {
  runStudy("budget", budgetStudy() + ladderOf("onoue-2004", "") +
                         ladderOf("max-forsyth", "parameters = { curved = 0 }"));
  const nlohmann::json json = summary("budget");
  // Both lights together, then each of them.
  ASSERT_EQ(json.at("budget").size(), 6U);
  std::vector<double> ofLights;
  for (const nlohmann::json& budget : json.at("budget")) {
    const std::string light = budget.at("light");
    const double total = shareOf(budget.at("total"));
    for (const char* way : {"forward", "backward"}) {
      double sum = 0;
      for (const char* rest : {"global", "distant", "seam", "other"}) {
        sum += shareOf(budget.at(rest));
      }
      for (const nlohmann::json& cause : budget.at("causes")) sum += shareOf(cause.at(way));
      EXPECT_NEAR(sum, total, 1e-15) << light << " " << way;
    }
    // As few as give 144 of equal weight; those at the border may be slivers.
    EXPECT_GE(budget.at("blocks"), 144);
    EXPECT_LE(budget.at("blocks"), 256);
    if (budget.at("method") != "onoue-2004") continue;
    if (light == "all") continue;
    ofLights.push_back(total);
    EXPECT_NEAR(total, resultOf(json, "onoue-2004", light, "atlas").at("error_rate").get<double>(),
                1e-12);
  }
  ASSERT_EQ(ofLights.size(), 2U);
  EXPECT_NEAR(shareOf(json.at("budget").at(0).at("total")), (ofLights[0] + ofLights[1]) / 2, 1e-12);
  // Of 8 azimuths and linear tables, something is the tables' fault.
  const nlohmann::json& causes = json.at("budget").at(0).at("causes");
  EXPECT_GT(shareOf(causes.at(1).at("forward")), 0.005);
  EXPECT_EQ(causes.at(1).at("forward").at("distinguishable"), true);
}

/// What is left at the end is what the last state's own run leaves, region by region.
TEST_F(BudgetRun, EveryStateIsAMethodOfItsOwn) {
  const std::string states = std::string("\n[[method]]\nlabel = \"end\"\nfile = \"") +
                             GNOMON_SCENES +
                             "/methods/horizon-ladder.glsl\"\nbake = { azimuths = 64 }\n"
                             "parameters = { resampled = 1 }\nbase = { subdivisions = 2 }\n";
  runStudy("budget", budgetStudy() + states + ladderOf("onoue-2004", ""));
  const nlohmann::json json = summary("budget");
  const nlohmann::json& budget = json.at("budget").at(2);
  const std::string light = budget.at("light");
  const nlohmann::json end = resultOf(json, "end", light, "atlas");
  const auto rate = [&](const char* name) { return end.at(name).get<double>(); };
  const nlohmann::json& last = budget.at("forward_states").at(3);
  for (const char* name : {"error_rate", "false_shadow", "false_light"}) {
    EXPECT_NEAR(last.at(name).get<double>(), rate(name), 1e-12) << name;
    EXPECT_EQ(last.at(name), budget.at("backward_states").at(3).at(name));
  }
  const nlohmann::json distant = resultOf(json, "end", light, "atlas", "distant");
  const double all = end.at("tp").get<double>() + end.at("fp").get<double>() +
                     end.at("fn").get<double>() + end.at("tn").get<double>();
  ASSERT_GT(distant.at("fn").get<double>(), 0);
  EXPECT_NEAR(shareOf(budget.at("distant")), distant.at("fn").get<double>() / all, 1e-12);
  EXPECT_EQ(filesBelow("out/budget/masks/ladders").size(), 2U * 6U);
}

TEST_F(BudgetRun, IsInEveryReport) {
  write("budget.toml", budgetStudy() + ladderOf("onoue-2004", ""));
  const Outcome outcome = gnomon({"run", "budget.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Where the error comes from"));
  EXPECT_THAT(read("out/budget/budget.csv"), HasSubstr("\nonoue-2004,atlas,all,interpolation,"));
  const std::string page = read("out/budget/report.html");
  const std::size_t section = page.find("<section id=\"budget\">");
  ASSERT_NE(section, std::string::npos);
  EXPECT_THAT(page.substr(section, page.find("</section>", section) - section),
              HasSubstr("<figure class=\"plot"));
  // A study without ladders leaves no older budget beside its report.
  write("budget.toml", budgetStudy());
  ASSERT_EQ(gnomon({"run", "budget.toml"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(file("out/budget/budget.csv")));
}

TEST_F(BudgetRun, TwiceGivesTheSameBytes) {
  runStudy("budget", budgetStudy() + ladderOf("onoue-2004", ""));
  runStudy("budget", budgetStudy() + ladderOf("onoue-2004", ""), {"--out", "again"});
  EXPECT_EQ(read("out/budget/budget.csv"), read("again/budget/budget.csv"));
}

TEST_F(BudgetRun, ALadderMustBeginAtItsMethod) {
  write("budget.toml", budgetStudy() + ladderOf("max-forsyth", ""));
  const Outcome outcome = gnomon({"run", "budget.toml"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("budget.toml: ladder \"max-forsyth\": its first state"),
                                 HasSubstr("samples, none expected")));
}

TEST_F(BudgetRun, ErrorsNameFileLineAndKey) {
  write("budget.toml",
        budgetStudy() + replaced(ladderOf("onoue-2004", ""), "resampled", "sampled"));
  const Outcome outcome = gnomon({"run", "budget.toml"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err,
              HasSubstr("budget.toml:49: ladder.0.rung.1.set.parameters.sampled: horizon-ladder"));
}

TEST_F(BudgetRun, TakesThePreview) {
  runStudy("budget", budgetStudy() + ladderOf("onoue-2004", ""),
           {"--quick", "--set", "view.0.samples=28"});
  EXPECT_GE(summary("budget").at("budget").at(0).at("blocks"), 16);
}

}  // namespace
}  // namespace gnomon::test
