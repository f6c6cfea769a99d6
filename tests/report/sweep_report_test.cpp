#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <sstream>

#include "common/error.h"
#include "report/json/sweep_json.h"
#include "report/page/sweep_html.h"
#include "report/page/terminal_report.h"
#include "report/plots/sweep_cost_plots.h"
#include "report/plots/sweep_plot.h"
#include "report/plots/sweep_plots.h"
#include "report/sample_record.h"
#include "report/tables/formats/csv_format.h"
#include "report/tables/means_table.h"
#include "report/tables/sweep_tables.h"
#include "report/text/text_width.h"
#include "study/judge/gates.h"
#include "study/judge/study_ranking.h"

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

/// The one slice of a sweep of one key.
SweepSlice sliceOf(const study::SweepRecord& sweep) {
  return slicesOf(sweep).at(0);
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
  EXPECT_THAT(sweepPlot(sweep, sliceOf(sweep)).commands, HasSubstr("'curved (5 of 6 cases)'"));
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
  const std::string script = sweepPlot(sampleSweep(), sliceOf(sampleSweep())).commands;
  EXPECT_THAT(script, HasSubstr("$truth << EOD\n0.25 0.1\n0.5 0.2\n1 0.3\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("$e0 << EOD\n0.25 4\n0.5 2\n1 8\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("$s1 << EOD\n0.25 0.5\n0.5 0.5\n1 1.5\nEOD\n"));
  EXPECT_THAT(script, HasSubstr("set xlabel offset 0,0.4 'curvature, 1/world’s'\n"));
}

TEST(SweepPlot, LeavesAGapWhereAFigureIsNotDefined) {
  study::SweepRecord sweep = sampleSweep();
  for (study::ResultRecord& row : sweep.steps[0].results) row.counts = {};
  EXPECT_THAT(sweepPlot(sweep, sliceOf(sweep)).commands,
              HasSubstr("$e1 << EOD\n0.25 1\n0.5 NaN\n1 3\nEOD\n"));
  EXPECT_THAT(svgOf(sweepPlot(sweep, sliceOf(sweep))), HasSubstr("</svg>"));
}

/// The y coordinates of the points of a plot command's k-th line in the first panel.
std::vector<double> pointHeights(const std::string& svg, int k) {
  const std::size_t begin = svg.find("<title>gnuplot_plot_" + std::to_string(k) + "a</title>");
  const std::string drawn = svg.substr(begin, svg.find("<title>", begin + 1) - begin);
  const std::regex line(" d='(M[^']*L[^']*)'");
  std::smatch match;
  std::vector<double> heights;
  if (!std::regex_search(drawn, match, line)) return heights;
  std::istringstream path(match[1].str());
  char letter{};
  char comma{};
  double x{};
  double y{};
  while (path >> letter >> x >> comma >> y) heights.push_back(y);
  return heights;
}

TEST(SweepPlot, HasItsLinesWhereTheFiguresAre) {
  const std::string svg = svgOf(sweepPlot(sampleSweep(), sliceOf(sampleSweep())));
  // The axis goes from 0 at the bottom; flat is 4, 2, 8 percent, curved 1, 1, 3.
  const auto flat = pointHeights(svg, 2);
  const auto curved = pointHeights(svg, 3);
  ASSERT_EQ(flat.size(), 3U);
  ASSERT_EQ(curved.size(), 3U);
  const double percent = (flat[1] - flat[0]) / 2;
  EXPECT_GT(percent, 10);
  EXPECT_NEAR(flat[1] - flat[2], 6 * percent, 0.1);
  EXPECT_NEAR(curved[0] - flat[0], 3 * percent, 0.1);
  EXPECT_NEAR(curved[1], curved[0], 0.1);
  EXPECT_NEAR(curved[1] - curved[2], 2 * percent, 0.1);
}

/// Where a text of an SVG starts, in pixels from the left; nothing where it is not there.
std::optional<double> leftOf(const std::string& svg, const std::string& text) {
  const std::size_t at = svg.find(text + "</");
  const std::size_t place = svg.rfind("translate(", at);
  if (at == std::string::npos || place == std::string::npos) return std::nullopt;
  return std::stod(svg.substr(place + std::string("translate(").size()));
}

TEST(SweepPlot, ItsLegendHoldsLongLabelsWhole) {
  for (const std::string label :
       {"resampled-horizon, 8 azimuths", "sloan-cohen-surface, 32 azimuths",
        "resampled-horizon, with forty characters"}) {
    study::SweepRecord sweep = sampleSweep();
    for (study::StudyRecord& record : sweep.steps) {
      for (study::ResultRecord& row : record.results) {
        if (row.method == "flat") row.method = label;
      }
    }
    const PlotSheet sheet = sweepPlot(sweep, sliceOf(sweep));
    const auto left = leftOf(svgOf(sheet), label);
    ASSERT_TRUE(left) << label;
    // 14 pixels of DejaVu Sans, as a browser draws it: 7.4 pixels a character.
    EXPECT_LE(*left + 7.4 * static_cast<double>(label.size()), sheet.width) << label;
  }
}

TEST(SweepPlot, DrawsWhateverTheLabels) {
  study::SweepRecord sweep = sampleSweep();
  sweep.keys[0].axis = "it's `date` {/x}_2 \\ \"";
  for (study::StudyRecord& record : sweep.steps) {
    for (int i = 0; i < 9; ++i) {
      const std::string label = "a 'label' of <some> length & such a number " + std::to_string(i);
      record.results.push_back(result(label, "noon", "camera", "all", countsOf(1000, 10 * i, 0)));
    }
    for (study::ResultRecord& row : record.results) {
      if (row.method == "flat") row.counts = countsOf(1000, 0, 0);
    }
  }
  const std::string svg = svgOf(sweepPlot(sweep, sliceOf(sweep)));
  EXPECT_THAT(svg, HasSubstr("it’s `date` {/x}_2 \\"));
  EXPECT_THAT(svg, HasSubstr("a ’label’ of &lt;some> length &amp; such a num…"));
  // No error at all: the axis has no length of its own.
  for (study::StudyRecord& record : sweep.steps) {
    for (study::ResultRecord& row : record.results) row.counts = countsOf(1000, 0, 0);
    record.truth.uncertainty = 0;
  }
  EXPECT_THAT(svgOf(sweepPlot(sweep, sliceOf(sweep))), HasSubstr("</svg>"));
}

// ---- what the values cost

TEST(SweepCostPlots, AreFramesAgainstTheValueAndErrorAgainstMemory) {
  const std::vector<PlotSheet> sheets = sweepCostPlots(costlySweep(), sliceOf(costlySweep()));
  ASSERT_EQ(sheets.size(), 2U);
  EXPECT_EQ(sheets[0].name, "sweep_frames");
  EXPECT_THAT(sheets[0].commands, HasSubstr("$m0 << EOD\n0.25 4\n0.5 8\n1 16\nEOD\n"));
  EXPECT_THAT(sheets[0].commands, HasSubstr("set xlabel 'curvature, 1/world’s'\n"));
  EXPECT_THAT(sheets[0].commands, Not(HasSubstr("$m1"))) << "never timed";
  EXPECT_EQ(sheets[1].name, "sweep_memory");
  EXPECT_THAT(sheets[1].commands, HasSubstr("$m0 << EOD\n1.5 4\n1 2\n4 8\nEOD\n"));
  EXPECT_THAT(sheets[1].commands, Not(HasSubstr("$m1"))) << "always as much";
  for (const PlotSheet& sheet : sheets) EXPECT_THAT(svgOf(sheet), HasSubstr("</svg>"));
}

TEST(SweepCostPlots, AreNotDrawnWhereNothingWasMeasured) {
  EXPECT_TRUE(sweepCostPlots(sampleSweep(), sliceOf(sampleSweep())).empty());
  study::SweepRecord sweep = costlySweep();
  for (study::StudyRecord& record : sweep.steps) record.cost[0].frameMs.reset();
  ASSERT_EQ(sweepCostPlots(sweep, sliceOf(sweep)).size(), 1U);
  EXPECT_EQ(sweepCostPlots(sweep, sliceOf(sweep))[0].name, "sweep_memory");
}

TEST(SweepCostPlots, LeaveAGapWhereAFigureIsNotDefined) {
  study::SweepRecord sweep = costlySweep();
  for (study::ResultRecord& row : sweep.steps[0].results) row.counts = {};
  sweep.steps[1].cost[0].frameMs.reset();
  const std::vector<PlotSheet> sheets = sweepCostPlots(sweep, sliceOf(sweep));
  EXPECT_THAT(sheets.at(0).commands, HasSubstr("$m0 << EOD\nNaN NaN\n0.5 8\n1 16\nEOD\n"));
  EXPECT_THAT(sheets.at(1).commands, HasSubstr("$m0 << EOD\n1.5 4\nNaN NaN\n4 8\nEOD\n"));
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
  const std::vector<DrawnPlot> plots = {{{}, "<svg/>"}, {cost, "<svg/>"}};
  const std::string html = sweepHtml(sweep, plots).text();
  for (const char* part :
       {"<h1>Bumps &amp; &lt;dents&gt;</h1>", "viewBox=\"0 0 1000 560\"", "viewBox=\"0 0 640 560\"",
        "<h3>Time &amp; money</h3>", "href=\"0.25/report.html\"", ">8.00</td>",
        "The gain &lt;grows&gt;", "1 of 2 thresholds met", "<h3>surface.curvature = 1</h3>",
        "--heat:1.000"}) {
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
