#include <fmt/core.h>
#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "common/error.h"
#include "report/json/results_json.h"
#include "report/page/overview_html.h"
#include "report/plots/study_plots.h"
#include "report/sample_record.h"
#include "report/tables/ranked_table.h"
#include "report/tables/sweep_tables.h"
#include "report/tables/table.h"
#include "report/terminal_page.h"
#include "report/terminal_report.h"
#include "study/judge/gates.h"
#include "study/judge/ranking.h"

namespace gnomon::report {
namespace {

using test::countsOf;
using test::result;
using ::testing::HasSubstr;
using ::testing::Not;

/// A step in which each method errs in the given thousandths under both of two lights.
study::StudyRecord step(const std::vector<std::pair<std::string, double>>& errors,
                        double uncertainty) {
  study::StudyRecord record = test::emptyRecord();
  record.truth.uncertainty = uncertainty;
  for (const auto& [label, error] : errors) {
    record.methods.push_back({label, "name of " + label, "", ""});
    record.results.push_back(result(label, "noon", "camera", "all", countsOf(1000, error, 0)));
    record.results.push_back(result(label, "dusk", "camera", "all", countsOf(1000, 0, error)));
  }
  return record;
}

/// A case of one key.
study::SweepCase caseAt(double value) {
  return {study::sweptNumber(value).text, {study::sweptNumber(value)}};
}

/// Values out of order: 0.5, 0.25, 1. "flat" 2, 4 and 8 percent, "curved" 1, 1 and 3.
study::SweepRecord sampleSweep() {
  study::SweepRecord sweep;
  sweep.name = "bumps";
  sweep.title = "Bumps & <dents>";
  sweep.source = "Figure 4";
  sweep.file = "bumps.toml";
  sweep.command = "gnomon run bumps.toml";
  sweep.keys = {{"surface.curvature", "curvature, 1/world's"}};
  sweep.cases = {caseAt(0.5), caseAt(0.25), caseAt(1)};
  sweep.steps = {step({{"flat", 20}, {"curved", 10}}, 0.002),
                 step({{"flat", 40}, {"curved", 10}}, 0.001),
                 step({{"flat", 80}, {"curved", 30}}, 0.003)};
  sweep.claims = {{"The gain <grows>", "§4", study::Verdict::held, "5.00 against 3.00"}};
  return sweep;
}

/// "flat" reads 1, 1.5 and 4 MB in 8, 4 and 16 ms, as the values come; "curved" as much at every
/// value, and is never timed.
study::SweepRecord costlySweep() {
  study::SweepRecord sweep = sampleSweep();
  const std::array<std::pair<std::uint64_t, double>, 3> costs = {
      {{1'000'000, 8}, {1'250'000, 4}, {3'750'000, 16}}};
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const std::uint64_t heights = i == 0 ? 0 : 250'000;
    sweep.steps[i].cost = {{"flat", 960, costs.at(i).first, heights, costs.at(i).second},
                           {"curved", 960, 2'000'000, 0, std::nullopt}};
  }
  return sweep;
}

std::vector<LinePlot> plotsOf(const study::SweepRecord& sweep) {
  return sweepPlots(sweep, {"flat", "curved"});
}

/// "0.25 4, 0.5 –": the points of a curve.
std::string pointsOf(const PlotCurve& curve) {
  std::string text;
  for (const PlotPoint& point : curve.points) {
    text += fmt::format("{}{:g} {}", text.empty() ? "" : ", ", point.x,
                        point.y ? fmt::format("{:g}", *point.y) : "–");
  }
  return text;
}

study::Judgement judgedAtMost(double maximum) {
  return study::judge({"flat", "noon", "camera", "all", "error_rate", {}, maximum},
                      {"error_rate", 0.08, {}});
}

// ---- figures

TEST(SweepMeans, AreMeansOverTheSteps) {
  const study::StudyMeans study = study::studyMeans(sampleSweep());
  EXPECT_EQ(study.name, "bumps");
  EXPECT_EQ(study.status, study::RunStatus::notJudged);
  ASSERT_EQ(study.methods.size(), 2U);
  const study::MethodMeans& flat = study.methods[0];
  EXPECT_EQ(flat.label, "flat");
  EXPECT_EQ(flat.name, "name of flat");
  EXPECT_DOUBLE_EQ(*flat.errorRate, 0.14 / 3);
  EXPECT_DOUBLE_EQ(*flat.falseShadow, 0.07 / 3);
  EXPECT_DOUBLE_EQ(*flat.uncertainty, 0.002);
  ASSERT_EQ(study.claims.size(), 1U);
}

TEST(SweepMeans, AreNoneWhereAStepHasNone) {
  study::SweepRecord sweep = sampleSweep();
  for (study::ResultRecord& row : sweep.steps[1].results) {
    if (row.method == "flat") row.counts = {};
  }
  EXPECT_FALSE(study::studyMeans(sweep).methods[0].errorRate);
  EXPECT_TRUE(study::studyMeans(sweep).methods[1].errorRate);
}

TEST(SweepMeans, ASweepIsOneStudyOfARanking) {
  study::SweepRecord sweep = sampleSweep();
  sweep.steps[1].judgements = {judgedAtMost(0.05)};
  const std::vector<study::StudyMeans> studies = {study::studyMeans(sweep),
                                                  study::studyMeans(step({{"flat", 10}}, 0))};
  EXPECT_EQ(studies[0].status, study::RunStatus::fail);
  const auto ranked = study::rankOverStudies(studies);
  EXPECT_EQ(ranked[0].label, "flat");
  EXPECT_DOUBLE_EQ(*ranked[0].meanError, (0.14 / 3 + 0.01) / 2);
  EXPECT_EQ(ranked[1].studies, 1U);
}

/// "curved" answers under one light of two at the second value.
study::SweepRecord sweepThatLacksACase() {
  study::SweepRecord sweep = sampleSweep();
  std::erase_if(sweep.steps[1].results, [](const study::ResultRecord& row) {
    return row.method == "curved" && row.light == "dusk";
  });
  return sweep;
}

TEST(SweepMeans, SayWhereTheyAreOverFewerCases) {
  const study::SweepRecord sweep = sweepThatLacksACase();
  const study::StudyMeans study = study::studyMeans(sweep);
  EXPECT_EQ(study::labelWithCases(study.methods[0]), "flat");
  EXPECT_EQ(study::labelWithCases(study.methods[1]), "curved (5 of 6 cases)");
  EXPECT_EQ(plotsOf(sweep).at(0).curves.at(1).label, "curved (5 of 6 cases)");
  EXPECT_THAT(terminalReport(sweep, false), HasSubstr("  curved      1.00    1.00*     3.00\n"));
  EXPECT_THAT(terminalReport(sweep, false), HasSubstr(study::fewerCasesMeaning));
  EXPECT_THAT(terminalReport(sampleSweep(), false), Not(HasSubstr(study::fewerCasesMeaning)));
  EXPECT_THAT(csvTable(sweepMeansTable(sweep)),
              HasSubstr("\n0.25,curved,0.01,0.01,0,0.001,,1,2\n"));
  const auto json = nlohmann::json::parse(sweepJson(sweep));
  EXPECT_EQ(json["results"][3]["cases"], 1);
  EXPECT_EQ(json["results"][3]["all_cases"], 2);
  const auto ranked = study::rankOverStudies(std::array{study});
  EXPECT_EQ(ranked[0].label, "flat");
  EXPECT_FALSE(ranked[1].rank);
  EXPECT_DOUBLE_EQ(*ranked[1].leaderError, (0.02 + 0.02 + 0.04 + 0.08 + 0.08) / 5);
}

// ---- files

TEST(SweepCsv, HasARowAMethodAndValue) {
  EXPECT_EQ(csvTable(sweepMeansTable(sampleSweep())),
            "value,method,error_rate,false_shadow,false_light,uncertainty,bytes,cases,all_cases\n"
            "0.5,flat,0.02,0.01,0.01,0.002,,2,2\n0.5,curved,0.01,0.005,0.005,0.002,,2,2\n"
            "0.25,flat,0.04,0.02,0.02,0.001,,2,2\n0.25,curved,0.01,0.005,0.005,0.001,,2,2\n"
            "1,flat,0.08,0.04,0.04,0.003,,2,2\n1,curved,0.03,0.015,0.015,0.003,,2,2\n");
  EXPECT_THAT(csvTable(sweepMeansTable(costlySweep())),
              HasSubstr("0.25,flat,0.04,0.02,0.02,0.001,1500000,2,2\n"));
}

TEST(SweepJson, HoldsTheSweep) {
  study::SweepRecord sweep = sampleSweep();
  sweep.steps[2].judgements = {judgedAtMost(0.05)};
  const auto json = nlohmann::json::parse(sweepJson(sweep));
  EXPECT_EQ(json["schema"], "gnomon-sweep/3");
  EXPECT_EQ(json["status"], "fail");
  EXPECT_EQ(json["study"]["name"], "bumps");
  EXPECT_EQ(json["environment"]["gl_renderer"], "A rasteriser");
  EXPECT_EQ(json["keys"][0]["key"], "surface.curvature");
  EXPECT_EQ(json["steps"][0]["values"][0], 0.5);
  EXPECT_EQ(json["steps"][1]["case"], 2);
  EXPECT_EQ(json["steps"][1]["name"], "0.25");
  EXPECT_EQ(json["steps"][1]["summary"], "0.25/summary.json");
  EXPECT_EQ(json["steps"][1]["status"], "not judged");
  EXPECT_EQ(json["steps"][2]["status"], "fail");
  ASSERT_EQ(json["results"].size(), 6U);
  EXPECT_EQ(json["results"][3]["case"], 2);
  EXPECT_EQ(json["results"][3]["method"], "curved");
  EXPECT_EQ(json["results"][3]["error_rate"], 0.01);
  EXPECT_EQ(json["claims"][0]["verdict"], "held");
  EXPECT_TRUE(json["results"][0]["bytes"].is_null());
  const auto costly = nlohmann::json::parse(sweepJson(costlySweep()));
  EXPECT_EQ(costly["results"][2]["bytes"], 1'500'000);
  EXPECT_EQ(costly["results"][2]["frame_ms"], 4);
  EXPECT_TRUE(costly["results"][3]["frame_ms"].is_null());
  EXPECT_EQ(json["faults"].size(), 1U);
  EXPECT_EQ(json["faults"][0]["case"], 3);
  EXPECT_EQ(json["faults"][0]["origin"], "threshold");
  EXPECT_THAT(json["faults"][0]["text"].get<std::string>(),
              HasSubstr("0.0800, too large by 0.0300"));
  sweep.cases[0].values[0].number = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)sweepJson(sweep), InternalError);
  EXPECT_THROW((void)csvTable(sweepMeansTable(sweep)), InternalError);
}

// ---- plot

TEST(SweepPlot, DrawsTheFiguresInTheOrderOfTheValues) {
  const LinePlot plot = plotsOf(sampleSweep()).at(0);
  ASSERT_EQ(plot.curves.size(), 2U);
  EXPECT_EQ(pointsOf(plot.curves[0]), "0.25 4, 0.5 2, 1 8");
  EXPECT_EQ(pointsOf(plot.curves[1]), "0.25 1, 0.5 1, 1 3");
  ASSERT_EQ(plot.band.size(), 3U);
  EXPECT_EQ(plot.band[2].y, 0.3);
  const std::string script = sheetOf(plot).commands;
  EXPECT_THAT(script, HasSubstr("set xlabel 'curvature, 1/world’s' "));
  EXPECT_THAT(script, HasSubstr("$c0 << EOD\n0.25 4 NaN NaN\n0.5 2 NaN NaN\n1 8 NaN NaN\nEOD\n"));
  EXPECT_EQ(svgsOf({sheetOf(plot)}), svgsOf({sheetOf(plot)}));
}

TEST(SweepPlot, LeavesAGapWhereAFigureIsNotDefined) {
  study::SweepRecord sweep = sampleSweep();
  for (study::ResultRecord& row : sweep.steps[0].results) row.counts = {};
  EXPECT_EQ(pointsOf(plotsOf(sweep).at(0).curves[1]), "0.25 1, 0.5 –, 1 3");
  EXPECT_THAT(svgsOf(sheetsOf(plotsOf(sweep))).front(), HasSubstr("</svg>"));
}

TEST(SweepPlot, ShowsTheMethodsThatAreAskedFor) {
  const auto plots = sweepPlots(sampleSweep(), {"curved"});
  ASSERT_EQ(plots.at(0).curves.size(), 1U);
  EXPECT_EQ(plots[0].curves[0].label, "curved");
}

TEST(SweepPlot, DrawsWhateverTheLabels) {
  study::SweepRecord sweep = sampleSweep();
  sweep.keys[0].axis = "it's `date` {/x}_2 \\ \"";
  const std::string label = "a 'label' of <some> length & such a number " + std::string(9, 'm');
  for (study::StudyRecord& record : sweep.steps) {
    record.results.push_back(result(label, "noon", "camera", "all", countsOf(1000, 10, 0)));
    // No error at all: the axis has no length of its own.
    for (study::ResultRecord& row : record.results) row.counts = countsOf(1000, 0, 0);
    record.truth.uncertainty = 0;
  }
  const std::string svg = svgsOf(sheetsOf(sweepPlots(sweep, {label}))).front();
  EXPECT_THAT(svg, HasSubstr("it’s `date` {/x}_2 \\"));
  EXPECT_THAT(svg, HasSubstr("a ’label’ of &lt;some> length &amp; such"));
}

TEST(SweepPlot, OfMemoryHasTheMethodsWhoseMemoryChanges) {
  const auto plots = plotsOf(costlySweep());
  ASSERT_EQ(plots.size(), 2U);
  EXPECT_EQ(plots[1].name, "sweep_memory");
  ASSERT_EQ(plots[1].curves.size(), 1U) << "the other reads always as much";
  EXPECT_EQ(pointsOf(plots[1].curves[0]), "1.5 4, 1 2, 4 8");
  EXPECT_EQ(plotsOf(sampleSweep()).size(), 1U) << "nothing was measured";
}

// ---- page

TEST(SweepHtml, HoldsPlotTableClaimsAndFailures) {
  study::SweepRecord sweep = sampleSweep();
  sweep.steps[0].judgements = {judgedAtMost(0.1)};
  sweep.steps[2].judgements = {judgedAtMost(0.05)};
  PlotSheet cost;
  cost.title = "Time & money";
  cost.section = sweepCostSection;
  cost.width = 640;
  const std::vector<DrawnPlot> plots = {{{.section = sweepErrorSection}, "<svg/>", ""},
                                        {cost, "<svg/>", ""}};
  const std::string html = sweepHtml(sweep, plots).text();
  for (const char* part :
       {"<h1>Bumps &amp; &lt;dents&gt;</h1>", "width=\"1000\" height=\"560\"",
        "width=\"640\" height=\"560\"", "Time &amp; money</figcaption>",
        "href=\"0.25/report.html\"", ">8.00</td>", "The gain &lt;grows&gt;",
        "1 of 2 thresholds met", "<h3>surface.curvature = 1</h3>", "--heat:1.000"}) {
    EXPECT_THAT(html, HasSubstr(part));
  }
  EXPECT_THAT(html, Not(HasSubstr("<h3>surface.curvature = 0.5</h3>"))) << "its gate was met";
  for (const char* fetch : {"http://", "https://", "<link", "<script src", "@import", "url("}) {
    EXPECT_THAT(html, Not(HasSubstr(fetch)));
  }
}

// ---- terminal

TEST(SweepTable, FitsHoweverManyTheValues) {
  study::SweepRecord sweep = sampleSweep();
  for (int i = 0; i < 40; ++i) {
    sweep.cases.push_back(caseAt(-1.0 / (3 + i) * 1e-300));
    sweep.steps.push_back(step({{std::string(80, 'm'), 5}}, 0.001));
  }
  const std::string text = terminalReport(sweep, false);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(displayWidth(line), 100U) << line;
  for (const study::SweepCase& which : sweep.cases) {
    EXPECT_THAT(text, HasSubstr(which.name.substr(0, 8)));
  }
}

}  // namespace
}  // namespace gnomon::report
