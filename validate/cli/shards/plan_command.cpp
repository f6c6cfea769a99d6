#include "cli/shards/plan_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cli/commands/cache_command.h"
#include "cli/output.h"
#include "cli/shards/calibration.h"
#include "cli/shards/case_list.h"
#include "cli/study_plans.h"
#include "common/system/memory.h"
#include "common/text/shell_quote.h"
#include "report/tables/formats/terminal_format.h"
#include "report/tables/table.h"
#include "report/text/number_text.h"
#include "report/text/terminal_page.h"
#include "study/spec/study_work.h"

namespace gnomon::cli {
namespace {

using Json = nlohmann::ordered_json;

/// What one case is expected to take, or several together.
struct Estimate {
  std::string name;
  std::size_t cases = 1;
  study::StudyWork work;  ///< of several the sum
  std::size_t lights = 0;
  double seconds = 0;
  double bytes = 0;  ///< of several the largest
};

Estimate estimateOf(const study::StudySpec& step, const Calibration& calibration) {
  const study::StudyWork work = study::workOf(step);
  return {step.name,
          1,
          work,
          step.lights.size(),
          study::expectedSeconds(work, calibration.speed),
          expectedBytes(work, calibration)};
}

Estimate sumOf(std::string name, const std::vector<Estimate>& estimates) {
  Estimate sum{std::move(name), 0, {}, 0, 0, 0};
  for (const Estimate& one : estimates) {
    sum.cases += one.cases;
    sum.work.microTriangles += one.work.microTriangles;
    sum.work.samples += one.work.samples;
    sum.work.rays += one.work.rays;
    sum.work.frames += one.work.frames;
    sum.work.horizons += one.work.horizons;
    sum.lights += one.lights;
    sum.seconds += one.seconds;
    sum.bytes = std::max(sum.bytes, one.bytes);
  }
  return sum;
}

/// A duration as people say it: "12.3 s", "4 min 10 s", "2 h 5 min".
std::string durationText(double seconds) {
  if (seconds < 60) return fmt::format("{:.3g} s", seconds);
  const auto whole = static_cast<std::uint64_t>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

/// Large numbers are told to three digits.
std::string roundText(double value) {
  return value < 1e6 ? report::groupedText(static_cast<std::uint64_t>(std::llround(value)))
                     : fmt::format("{:.3g} M", value / 1e6);
}

report::Row rowOf(const Estimate& one, bool isOfStudies) {
  std::vector<report::Cell> cells = {report::textCell(one.name)};
  if (isOfStudies) cells.push_back(report::countCell(one.cases));
  for (const double value : {one.work.microTriangles, one.work.samples}) {
    cells.push_back(report::textCell(roundText(value)));
  }
  cells.push_back(report::countCell(one.lights));
  for (const double value : {one.work.frames, one.work.horizons}) {
    cells.push_back(report::textCell(roundText(value)));
  }
  cells.push_back(report::textCell(durationText(one.seconds)));
  cells.push_back(report::textCell(formatBytes(one.bytes)));
  return {std::move(cells)};
}

report::Table tableOf(const std::vector<Estimate>& estimates, bool isOfStudies) {
  report::Table table{"plan", {}, {}, {}, {{"Case", {}, report::Quantity::name}}};
  if (isOfStudies) table.columns.front().name = "Study";
  if (isOfStudies) table.columns.push_back({"Cases", {}, report::Quantity::count});
  for (const char* name :
       {"Triangles", "Samples", "Lights", "Shaded", "Horizons", "Time", "Memory"}) {
    table.columns.push_back({name, {}, report::Quantity::count});
  }
  for (const Estimate& one : estimates) table.rows.push_back(rowOf(one, isOfStudies));
  return table;
}

/// Everything that is printed.
struct Plan {
  Calibration calibration;
  std::vector<Estimate> cases;
  std::vector<Estimate> studies;
  std::vector<Estimate> shards;
  Estimate all;
};

std::string calibrationText(const Calibration& calibration) {
  return fmt::format("By {}, {} {}, on this machine with {} threads: {}.", calibration.name,
                     calibration.isKept ? "measured on" : "measured now,", calibration.day,
                     calibration.threads, durationText(calibration.seconds));
}

/// What submits the shards to Slurm: memory with a quarter to spare, by whole MB.
std::string slurmCommand(const Plan& plan, const RunRequest& run) {
  const double megabytes = std::ceil(plan.all.bytes * 1.25 / 1e6);
  std::string text = fmt::format("sbatch --array=1-{} --mem={}M packaging/slurm/gnomon.sbatch",
                                 plan.shards.size(), static_cast<std::uint64_t>(megabytes));
  for (const auto& study : run.studies) text += " " + shellQuoted(study.string());
  return text;
}

void print(const Plan& plan, const PlanRequest& request) {
  report::TerminalPage page(coloursWanted());
  const bool isShort = plan.cases.size() <= mostCaseLines;
  page.paragraph(calibrationText(plan.calibration));
  page.blank();
  report::appendTable(page, tableOf(isShort ? plan.cases : plan.studies, !isShort));
  page.blank();
  page.line(fmt::format("{} cases: {} one after the other, at most {} of memory",
                        report::groupedText(plan.all.cases), durationText(plan.all.seconds),
                        formatBytes(plan.all.bytes)));
  if (!plan.shards.empty()) {
    const auto longest =
        std::max_element(plan.shards.begin(), plan.shards.end(),
                         [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
    page.line(fmt::format("{} shards: the longest, {}, has {} cases and takes {}",
                          plan.shards.size(), longest->name, longest->cases,
                          durationText(longest->seconds)));
  }
  printText(page.text());
  // A command is copied as it is, whatever its width.
  if (!plan.shards.empty()) printLine("  " + slurmCommand(plan, request.run));
}

Json jsonOf(const Estimate& one, const study::WorkSpeed& speed) {
  return {{"name", one.name},
          {"cases", one.cases},
          {"seconds", one.seconds},
          {"memory_bytes", std::llround(one.bytes)},
          {"micro_triangles", std::llround(one.work.microTriangles)},
          {"samples", std::llround(one.work.samples)},
          {"lights", one.lights},
          {"shaded_samples", std::llround(one.work.frames)},
          {"horizons", std::llround(one.work.horizons)},
          {"parts",
           {{"mesh", one.work.microTriangles * speed.microTriangle},
            {"rays", one.work.rays * speed.ray},
            {"methods", one.work.frames * speed.frame},
            {"tables", one.work.horizons * speed.horizon},
            {"start", static_cast<double>(one.cases) * speed.start}}}};
}

Json jsonOf(const Plan& plan) {
  const Calibration& by = plan.calibration;
  const auto list = [&](const std::vector<Estimate>& estimates) {
    Json array = Json::array();
    for (const Estimate& one : estimates) array.push_back(jsonOf(one, by.speed));
    return array;
  };
  return {{"schema", "gnomon-plan/1"},
          {"calibration",
           {{"case", by.name},
            {"seconds", by.seconds},
            {"day", by.day},
            {"from_cache", by.isKept},
            {"threads", by.threads}}},
          {"all", jsonOf(plan.all, by.speed)},
          {"studies", list(plan.studies)},
          {"shards", list(plan.shards)},
          {"cases", list(plan.cases)}};
}

/// The case of median cost: what most are like.
CasePlace medianCase(const std::vector<study::StudyPlan>& plans) {
  std::vector<CasePlace> places = allCases(plans);
  const auto cost = [&](const CasePlace& place) {
    return study::standardCost(plans[place.plan].steps[place.step]);
  };
  std::stable_sort(places.begin(), places.end(),
                   [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
  return places[places.size() / 2];
}

}  // namespace

ExitStatus planStudies(const PlanRequest& request) {
  const std::vector<study::StudyPlan> plans = readPlans(request.run.studies, request.run.options);
  const CasePlace median = medianCase(plans);
  const study::StudySpec& measured = plans[median.plan].steps[median.step];
  const std::unique_ptr<cache::Cache> cache = openCache(request.run.noCache);
  Plan plan;
  plan.calibration = calibrate(plans[median.plan], measured, request.run, *cache);
  for (const study::StudyPlan& study : plans) {
    std::vector<Estimate> steps;
    for (const study::StudySpec& step : study.steps) {
      steps.push_back(estimateOf(step, plan.calibration));
    }
    plan.studies.push_back(sumOf(study.name, steps));
    plan.cases.insert(plan.cases.end(), steps.begin(), steps.end());
  }
  plan.all = sumOf("all", plan.cases);
  if (request.shards) {
    auto next = plan.cases.begin();
    int index = 0;
    for (const auto& places : casesOfShards(plans, *request.shards)) {
      const auto end = next + static_cast<std::ptrdiff_t>(places.size());
      plan.shards.push_back(sumOf(shardText({++index, *request.shards}), {next, end}));
      next = end;
    }
  }
  if (request.json) {
    printUnchanged(jsonOf(plan).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  } else {
    print(plan, request);
  }
  return ExitStatus::pass;
}

}  // namespace gnomon::cli
