#include "report/suite/suite_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "common/error.h"
#include "report/json/json_values.h"
#include "report/json/summary_json.h"
#include "report/page/html_page.h"
#include "report/paper_files.h"
#include "report/plots/line_plot.h"
#include "report/suite/suite_plots.h"
#include "report/suite/suite_tables.h"
#include "report/tables/confidence.h"
#include "report/tables/table.h"
#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
#include "study/spec/toml_reader.h"

namespace gnomon::report {

namespace fs = std::filesystem;
namespace {

/// The scene of a summary; none where it is of no suite.
std::optional<FinishedScene> readScene(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  const Json json = readJson(file);
  const JsonReader summary(json, file.string(), "");
  if (summary.text("schema") != summarySchema) return std::nullopt;
  const JsonReader header = summary.object("study").object("settings").object("study");
  if (!header.has("suite")) return std::nullopt;
  return FinishedScene{folder, study::studyMeans(readSummary(summary))};
}

std::vector<fs::path> foldersIn(const fs::path& folder) {
  std::vector<fs::path> folders = {folder};
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure)) {
    if (entry.is_directory(failure)) folders.push_back(entry.path());
  }
  if (failure) {
    throw InputError(fmt::format("{}: cannot be read: {}", folder.string(), failure.message()));
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

}  // namespace

std::vector<FinishedScene> readFinishedScenes(const fs::path& folder) {
  std::vector<FinishedScene> scenes;
  for (const fs::path& run : foldersIn(folder)) {
    std::error_code failure;
    if (!fs::exists(run / "summary.json", failure)) continue;
    if (auto scene = readScene(run)) scenes.push_back(std::move(*scene));
  }
  return scenes;
}

study::SuiteRanking readSuiteRanking(const fs::path& file) {
  const Json json = readJson(file);
  const JsonReader suite(json, file.string(), "");
  const std::string schema = suite.text("schema");
  if (schema != suiteSchema) {
    suite.fail("schema", fmt::format("\"{}\" found, \"{}\" expected", schema, suiteSchema));
  }
  study::SuiteRanking ranking;
  for (const JsonReader& method : suite.list("methods")) {
    if (!method.numberOrNull("rank")) continue;
    ranking.methods.push_back({method.text("label"), method.number("mean")});
  }
  for (const JsonReader& pair : suite.list("pairs")) {
    const std::string verdict = pair.text("verdict");
    if (verdict == differenceVerdictName(study::DifferenceVerdict::better)) {
      ranking.distinguishable.emplace_back(pair.text("first"), pair.text("second"));
    } else if (verdict == differenceVerdictName(study::DifferenceVerdict::worse)) {
      ranking.distinguishable.emplace_back(pair.text("second"), pair.text("first"));
    }
  }
  return ranking;
}

namespace {

void writeTables(const study::SuiteStatistics& statistics,
                 std::span<const study::StudyMeans> studies, RunFolder& folder) {
  folder.write("suite.csv", csvTable(suiteResultsTable(statistics, studies)));
  folder.write("suite.md", markdownTable(suiteRankedTable(statistics)));
}

}  // namespace

void writeSuiteFiles(const study::SuiteStatistics& statistics,
                     std::span<const study::StudyMeans> studies, std::string_view command,
                     const PaperOptions& paper, RunFolder& folder,
                     const std::vector<PageSection>& opening) {
  writeTables(statistics, studies, folder);
  writePaperFiles(statistics, paper, folder);
  std::vector<PlotSheet> sheets = sheetsOf(suitePlots(statistics, plottedMethods(statistics)));
  const bool isRanked = !statistics.methods.empty() && statistics.methods.front().rank;
  if (isRanked) sheets.push_back(suiteWinsPlot(statistics));
  const std::vector<DrawnPlot> plots = drawPlots(std::move(sheets), nullptr);
  for (const DrawnPlot& plot : plots) {
    folder.write(fmt::format("plots/{}.svg", plot.sheet.name), plot.svg);
    folder.write(fmt::format("plots/{}.pdf", plot.sheet.name), plot.pdf);
  }
  folder.write("suite.html", suiteHtml(statistics, plots, command, opening).text());
}

bool writeSuiteOf(std::span<const study::StudyMeans> studies, std::string_view command,
                  SuiteParts parts, const PaperOptions& paper, RunFolder& folder) {
  const std::string suite = study::suiteOf(studies);
  if (suite.empty()) return false;
  study::SuiteStatistics statistics = study::suiteStatistics(suite, studies);
  if (parts == SuiteParts::all) {
    writeSuiteFiles(statistics, studies, command, paper, folder);
  } else {
    for (study::SuiteScene& scene : statistics.scenes) scene.report.clear();
    writeTables(statistics, studies, folder);
  }
  folder.write("suite.json", suiteJson(statistics, command));
  return true;
}

namespace {

/// An interval under two keys.
void addInterval(Json& json, const char* low, const char* high,
                 const std::optional<compare::Interval>& interval) {
  json[low] = jsonNumber(lowOf(interval), low);
  json[high] = jsonNumber(highOf(interval), high);
}

Json methodJson(const study::SuiteMethod& method) {
  const auto count = [&](std::size_t compare::SceneRank::*of) {
    return method.rank ? Json((*method.rank).*of) : Json(nullptr);
  };
  const compare::SceneSpread& spread = method.spread;
  Json json = {{"label", method.label},
               {"names", method.names},
               {"rank", count(&compare::SceneRank::rank)},
               {"rank_low", count(&compare::SceneRank::low)},
               {"rank_high", count(&compare::SceneRank::high)},
               {"rank_stability",
                jsonNumber(method.rank ? std::optional(method.rank->stability) : std::nullopt,
                           "methods.rank_stability")},
               {"scenes", spread.scenes},
               {"mean", jsonNumber(spread.mean, "methods.mean")}};
  addInterval(json, "low", "high", method.interval);
  json["reason"] = jsonReason(method.reason);
  json["median"] = jsonNumber(spread.median, "methods.median");
  json["quartile_1"] = jsonNumber(spread.lowerQuartile, "methods.quartile_1");
  json["quartile_3"] = jsonNumber(spread.upperQuartile, "methods.quartile_3");
  json["percentile_95"] = jsonNumber(spread.percentile95, "methods.percentile_95");
  json["worst_twentieth"] = jsonNumber(spread.worstTwentieth, "methods.worst_twentieth");
  json["worst"] = jsonNumber(spread.worst, "methods.worst");
  json["worst_scene"] = method.worstScene;
  json["uncertainty"] = jsonNumber(method.uncertainty, "methods.uncertainty");
  return json;
}

Json pairJson(const study::SuitePair& pair) {
  Json json = {{"first", pair.first},
               {"second", pair.second},
               {"scenes", pair.wins.scenes},
               {"wins", pair.wins.wins},
               {"ties", pair.wins.ties},
               {"win_probability", jsonNumber(pair.wins.probability, "pairs.win_probability")}};
  addInterval(json, "win_low", "win_high", pair.wins.interval);
  json["difference"] = jsonNumber(pair.difference, "pairs.difference");
  addInterval(json, "low", "high", pair.interval);
  json["reason"] = jsonReason(pair.reason);
  json["uncertainty"] = jsonNumber(pair.uncertainty, "pairs.uncertainty");
  json["p"] = jsonNumber(pair.probability, "pairs.p");
  json["p_holm"] = jsonNumber(pair.adjusted, "pairs.p_holm");
  addInterval(json, "corrected_low", "corrected_high", pair.corrected);
  json["verdict"] = differenceVerdictName(pair.verdict);
  return json;
}

Json binJson(const study::SuiteBin& bin) {
  Json json = {{"method", bin.method},
               {"axis", bin.axis},
               {"low", jsonNumber(bin.low, "bins.low")},
               {"high", jsonNumber(bin.high, "bins.high")},
               {"scenes", bin.error.scenes},
               {"weight", jsonNumber(bin.error.weight, "bins.weight")},
               {"error_rate", jsonNumber(bin.error.errorRate, "bins.error_rate")}};
  addInterval(json, "error_low", "error_high", bin.error.interval);
  return json;
}

Json sceneJson(const study::SuiteScene& scene) {
  return {{"name", scene.name},
          {"title", scene.title},
          {"report", scene.report.empty() ? Json(nullptr) : Json(scene.report)},
          {"median", jsonNumber(scene.median, "scenes.median")},
          {"best", scene.best.empty() ? Json(nullptr) : Json(scene.best)},
          {"best_error_rate", jsonNumber(scene.bestError, "scenes.best_error_rate")},
          {"leader_error_rate", jsonNumber(scene.leaderError, "scenes.leader_error_rate")},
          {"uncertainty", jsonNumber(scene.uncertainty, "scenes.uncertainty")}};
}

/// A row a scene × method.
Json resultsJson(const compare::SceneTable& table) {
  Json results = Json::array();
  for (std::size_t s = 0; s < table.scenes.size(); ++s) {
    for (std::size_t m = 0; m < table.methods.size(); ++m) {
      results.push_back({{"scene", table.scenes[s]},
                         {"method", table.methods[m]},
                         {"error_rate", jsonNumber(table.errors[m][s], "results.error_rate")}});
    }
  }
  return results;
}

}  // namespace

std::string suiteJson(const study::SuiteStatistics& statistics, std::string_view command) {
  const Json json = {{"schema", suiteSchema},
                     {"suite", statistics.suite},
                     {"statistic", suiteFigure(statistics).key},
                     {"command", command},
                     {"methods", jsonList(statistics.methods, methodJson)},
                     {"comparisons", statistics.comparisons},
                     {"pairs", jsonList(statistics.pairs, pairJson)},
                     {"bins", jsonList(statistics.bins, binJson)},
                     {"scenes", jsonList(statistics.scenes, sceneJson)},
                     {"results", resultsJson(statistics.table)}};
  return jsonText(json);
}

namespace {

using Q = Quantity;

std::string valueText(const study::TriedValue& value) {
  return value.value.empty() ? "as declared" : value.value;
}

/// "# max-forsyth, bake.azimuths: 32 1.20 %, 16 1.54 %, 64 1.08 % (chosen); 200 scenes"
std::string commentOf(const study::SuiteMethods& methods, const study::TriedSetting& setting) {
  std::string text =
      fmt::format("# {}, {}:", study::labelOfMethod(methods.methods[setting.method]), setting.key);
  for (std::size_t i = 0; i < setting.values.size(); ++i) {
    const study::TriedValue& value = setting.values[i];
    text += fmt::format("{} {} {} %{}", i == 0 ? "" : ",", valueText(value),
                        percentText(value.mean), i == setting.best ? " (chosen)" : "");
  }
  return text + fmt::format("; {} scenes\n", setting.scenes);
}

}  // namespace

Table suiteSettingsTable(const study::SuiteMethods& methods,
                         const std::vector<study::TriedSetting>& tried) {
  Table table{.kind = "suite-settings",
              .columns = {{.name = "Method", .quantity = Q::name},
                          {.name = "Setting", .quantity = Q::code},
                          {.name = "Value", .quantity = Q::text},
                          {.name = "Mean", .key = "mean_error_rate", .quantity = Q::percent},
                          {.name = "Scenes", .quantity = Q::count},
                          {.name = "Chosen", .quantity = Q::text}}};
  for (const study::TriedSetting& setting : tried) {
    for (std::size_t i = 0; i < setting.values.size(); ++i) {
      const study::TriedValue& value = setting.values[i];
      const std::string note = i != setting.best ? "" : (i == 0 ? "the authors'" : "chosen");
      table.rows.push_back({{textCell(study::labelOfMethod(methods.methods[setting.method])),
                             textCell(setting.key), textCell(valueText(value)),
                             valueCell(value.mean), countCell(setting.scenes), textCell(note)}});
    }
  }
  return table;
}

std::string chosenSettingsText(const study::SuiteMethods& methods,
                               const std::vector<study::TriedSetting>& tried,
                               const std::string& scenes) {
  std::string text = fmt::format(
      "# Settings with the least mean error on {}, one at a time; the authors' value first.\n",
      scenes);
  for (const study::TriedSetting& setting : tried) text += commentOf(methods, setting);
  toml::array chosen;
  for (toml::table& method : study::chosenMethods(methods, tried)) {
    chosen.push_back(std::move(method));
  }
  if (chosen.empty()) return text;  // every authors' value was the best
  return text + "\n" + study::tomlText(toml::table{{"method", std::move(chosen)}});
}

namespace {

constexpr std::size_t mostHardScenes = 10;

/// The methods with a rank that the first is not known to differ from.
study::LikeMethods likeFirst(const study::SuiteStatistics& statistics) {
  study::LikeMethods like;
  const std::string& first = statistics.methods.front().label;
  for (const study::SuiteMethod& method : statistics.methods) {
    const auto pair = method.rank ? study::findPair(statistics, first, method.label) : std::nullopt;
    if (pair) like.add(method.label, pair->verdict);
  }
  return like;
}

Html bestOf(const study::SuiteStatistics& statistics) {
  if (statistics.methods.empty() || !statistics.methods.front().rank) {
    return html("No method was measured on every scene, so that none can be called the best.");
  }
  const study::SuiteMethod& best = statistics.methods.front();
  const std::string alike = likeText(likeFirst(statistics));
  const Html interval =
      best.interval ? html(" (95&#8239;% interval {})", intervalText(best.interval)) : Html();
  return html(
      "<b>{}</b> has {}: <b>{}&#8239;%</b> on average{}, {}&#8239;% on the worst twentieth of the "
      "scenes. {}",
      best.label, leastErrorText(statistics.isSoft), percentText(best.spread.mean), interval,
      percentText(best.spread.worstTwentieth),
      alike.empty() ? html("It is distinguishable from every other ranked method.")
                    : html("Its comparisons: {}.", alike));
}

/// What a figure of the page is.
std::string figureText(const study::SuiteStatistics& statistics) {
  if (!statistics.isSoft)
    return "the share of wrong samples, mean over the scene’s lights and views";
  return "the mean of |ΔV| (mae), by how much of the light’s disc a sample sees too little, false "
         "shadow, or too much, false light, mean over the scene’s lights and views";
}

Html header(const study::SuiteStatistics& statistics) {
  return html(
      "<h1>{}: {} over {}</h1>\n<p class=\"source\">On every scene the methods’ shadows were "
      "compared, sample by sample, with ray tracing of the displaced surface; a figure is {}. "
      "The scenes were drawn from one population and the scene is the unit: intervals and verdicts "
      "hold for further scenes drawn likewise.</p>\n<p class=\"lead\">{}</p>\n",
      statistics.suite, plural(statistics.methods.size(), "method"),
      plural(statistics.table.scenes.size(), "scene"), figureText(statistics), bestOf(statistics));
}

/// A note and what it is about; nothing without that.
Html noted(const Html& note, const Html& content) {
  return content.empty() ? Html() : html("<p class=\"note\">{}</p>\n{}", note, content);
}

PageSection rankedSection(const study::SuiteStatistics& statistics) {
  return {
      "ranking", "Which method is closest to the truth",
      noted(
          html("Percent of {}. <b>Worst 5&#8239;%</b> is the mean over the worst "
               "twentieth of the scenes. <b>Ranks</b> are those of 95&#8239;% of the resamples of "
               "the scenes, <b>same rank</b> the share of them in which the rank is the one in "
               "the table. Compared with the first, by Holm’s correction over all {} of methods{}: "
               "{}.",
               suiteFigure(statistics).of, plural(statistics.comparisons, "pair"),
               statistics.entries.empty() ? "" : ", those with an entry by themselves",
               signMeaning),
          htmlTable(suiteRankedTable(statistics)))};
}

PageSection leaderSection(const study::SuiteStatistics& statistics) {
  const Table table = suiteLeaderTable(statistics);
  if (table.rows.empty()) return {};
  return {
      "first", "Against " + statistics.methods.front().label,
      noted(html("Paired by scene. A scene on which two methods differ by no more than the truth’s "
                 "uncertainty counts half for each."),
            htmlTable(table))};
}

PageSection winsSection(const std::vector<DrawnPlot>& plots) {
  return {
      "wins", "Who beats whom",
      noted(html("How probable it is, in percent, that the method of the row has a smaller error "
                 "than that of the column on a new scene. Blue above 50, orange below it; "
                 "no colour where the two are not known to differ: ≈ not distinguishable, = the "
                 "same answers, ? no interval."),
            htmlPlots(plots, "wins"))};
}

PageSection binsSection(const study::SuiteStatistics& statistics,
                        const std::vector<DrawnPlot>& plots) {
  Html tables;
  for (const std::string& axis : suiteAxes(statistics)) {
    tables += html("<h3>{}</h3>\n{}", axisTitle(axis), htmlTable(suiteBinsTable(statistics, axis)));
  }
  if (tables.empty()) return {};
  return {
      "bins", "Where methods fail",
      noted(
          html("Error among the samples of all scenes that lie in a bin, each scene with the same "
               "weight. Bars are 95&#8239;% intervals over the scenes; errors below "
               "0.01&#8239;% are drawn at 0.01&#8239;%. The tables have all methods."),
          htmlPlots(plots, "bins") + htmlFold("The figures of every method", tables))};
}

PageSection hardSection(const study::SuiteStatistics& statistics) {
  const Table table = suiteScenesTable(statistics, mostHardScenes);
  if (statistics.methods.empty() || !statistics.methods.front().rank) return {};
  return {"scenes", "The hardest scenes",
          noted(html("The {} with the largest median of the ranked methods’ errors, "
                     "percent of {}.",
                     plural(table.rows.size(), "scene"), suiteFigure(statistics).of),
                htmlTable(table))};
}

}  // namespace

Html suiteHtml(const study::SuiteStatistics& statistics, const std::vector<DrawnPlot>& plots,
               std::string_view command, const std::vector<PageSection>& opening) {
  const PageSection curves = {
      "errors", "Share of the scenes with an error below",
      noted(html("The farther up and to the left a curve runs, the better the method. It reaches "
                 "100&#8239;% at the method’s worst scene. Errors below 0.01&#8239;% are drawn at "
                 "0.01&#8239;%. {}",
                 plotReading),
            htmlPlots(plots, "plots"))};
  std::vector<PageSection> sections = opening;
  for (PageSection& section : std::vector{rankedSection(statistics), curves, winsSection(plots),
                                          leaderSection(statistics), binsSection(statistics, plots),
                                          hardSection(statistics), reproduceSection(command)}) {
    sections.push_back(std::move(section));
  }
  return htmlPage(statistics.suite, header(statistics), sections);
}

}  // namespace gnomon::report
