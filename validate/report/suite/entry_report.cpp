#include "report/suite/entry_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "common/lists.h"
#include "report/suite/suite_tables.h"

namespace gnomon::report {
namespace {

using Q = Quantity;

/// Rows above and below an entry's own.
constexpr std::size_t neighbourCount = 3;
constexpr std::size_t worstCount = 10;

Column columnOf(std::string name, Q quantity) {
  return {std::move(name), {}, quantity};
}

std::size_t rowOf(const compare::SceneTable& table, const std::string& label) {
  return static_cast<std::size_t>(std::find(table.methods.begin(), table.methods.end(), label) -
                                  table.methods.begin());
}

std::size_t placeIn(const study::SuiteStatistics& statistics, const std::string& label) {
  std::size_t place = 0;
  while (statistics.methods[place].label != label) ++place;
  return place;
}

/// Labels of ranked methods by what is known of them beside an entry.
struct Against {
  std::vector<std::string> better, alike, worse;
};

Against againstOf(const study::SuiteStatistics& statistics, const std::string& entry) {
  Against against;
  for (const study::SuiteMethod& method : statistics.methods) {
    const auto pair = method.rank && method.label != entry
                          ? study::findPair(statistics, method.label, entry)
                          : std::nullopt;
    if (!pair) continue;
    auto& list = pair->verdict == study::DifferenceVerdict::better  ? against.better
                 : pair->verdict == study::DifferenceVerdict::worse ? against.worse
                                                                    : against.alike;
    list.push_back(method.label);
  }
  return against;
}

std::string placeText(const study::SuiteStatistics& statistics, const study::SuiteMethod& method) {
  if (!method.rank) {
    return fmt::format("{}: no place, since it answers on {} of {} scenes", method.label,
                       method.spread.scenes, statistics.table.scenes.size());
  }
  const auto ranked = std::count_if(statistics.methods.begin(), statistics.methods.end(),
                                    [](const auto& other) { return other.rank.has_value(); });
  return fmt::format("{}: place {} of {} ({} in 95 % of the resamples of the scenes)", method.label,
                     method.rank->rank, ranked, rankText(method.rank->low, method.rank->high));
}

std::string againstText(const Against& against) {
  const std::size_t all = against.better.size() + against.alike.size() + against.worse.size();
  return fmt::format(
      "Better than it: {}. Not distinguishable: {}. Worse: {}. By Holm's correction over these {}.",
      against.better.size(), against.alike.size(), against.worse.size(), all);
}

Table neighboursOf(const study::SuiteStatistics& statistics, const std::string& entry,
                   const Against& against) {
  Table table{.kind = "rank",
              .columns = {columnOf("Rank", Q::rank), columnOf("Method", Q::name),
                          columnOf("Mean, %", Q::percent), columnOf("95 %", Q::interval),
                          columnOf("Median", Q::percent), columnOf("Worst", Q::percent),
                          columnOf("Beside it", Q::text)}};
  const std::size_t own = placeIn(statistics, entry);
  const std::size_t first = own > neighbourCount ? own - neighbourCount : 0;
  const std::size_t end = std::min(statistics.methods.size(), own + neighbourCount + 1);
  for (std::size_t i = first; i < end; ++i) {
    const study::SuiteMethod& method = statistics.methods[i];
    const char* beside = contains(against.better, method.label)  ? "better"
                         : contains(against.worse, method.label) ? "worse"
                         : contains(against.alike, method.label) ? "not distinguishable"
                                                                 : "";
    Cell rank;
    if (method.rank) rank.value = static_cast<double>(method.rank->rank);
    table.rows.push_back(
        {{rank, textCell(method.label), valueCell(method.spread.mean),
          intervalCell(method.interval, method.reason), valueCell(method.spread.median),
          valueCell(method.spread.worst), textCell(beside)}});
  }
  return table;
}

using Members = std::map<std::string, std::vector<std::size_t>>;  ///< scenes by family

Members membersOf(const study::SuiteStatistics& statistics, const SceneFamilies& families) {
  Members members;
  for (const study::SuiteScene& scene : statistics.scenes) {
    const auto& names = statistics.table.scenes;
    const auto index =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), scene.name) - names.begin());
    // "solid noise on a koala"
    const std::size_t on = scene.title.find(" on ");
    std::vector<std::string> all = {scene.title.substr(0, on)};
    if (on != std::string::npos) all.push_back(scene.title.substr(on + 1));
    if (const auto more = families.find(scene.name); more != families.end()) {
      all.insert(all.end(), more->second.begin(), more->second.end());
    }
    for (const std::string& family : all) members[family].push_back(index);
  }
  return members;
}

/// None where the method lacks one of the scenes.
std::optional<double> meanOver(const compare::SceneTable& table, const std::string& label,
                               const std::vector<std::size_t>& scenes) {
  double sum = 0;
  for (const std::size_t scene : scenes) {
    const auto& error = table.errors[rowOf(table, label)][scene];
    if (!error) return std::nullopt;
    sum += *error;
  }
  return sum / static_cast<double>(scenes.size());
}

Table familiesOf(const study::SuiteStatistics& statistics, const std::string& entry,
                 const SceneFamilies& families) {
  Table table{.kind = "families",
              .columns = {columnOf("Family", Q::name), columnOf("Scenes", Q::count),
                          columnOf("Mean, %", Q::percent), columnOf("Place", Q::text),
                          columnOf("Best other", Q::text), columnOf("Its, %", Q::percent)}};
  for (const auto& [family, scenes] : membersOf(statistics, families)) {
    const auto own = meanOver(statistics.table, entry, scenes);
    std::size_t better = 0;
    std::size_t others = 0;
    std::optional<double> least;
    std::string best;
    for (const study::SuiteMethod& method : statistics.methods) {
      const auto mean = meanOver(statistics.table, method.label, scenes);
      if (method.label == entry || !mean) continue;
      ++others;
      if (own && *mean < *own) ++better;
      if (least && *mean >= *least) continue;
      least = mean;
      best = method.label;
    }
    const std::string place = own ? fmt::format("{} of {}", better + 1, others + 1) : "–";
    table.rows.push_back({{textCell(family), countCell(scenes.size()), valueCell(own),
                           textCell(place), textCell(best), valueCell(least)}});
  }
  return table;
}

Table worstOf(const study::SuiteStatistics& statistics, const std::string& entry) {
  Table table{.kind = "worst-scenes",
              .columns = {columnOf("Worst scenes", Q::name), columnOf("What", Q::text),
                          columnOf("Error, %", Q::percent), columnOf("Best", Q::text),
                          columnOf("Its, %", Q::percent)}};
  const compare::SceneTable& errors = statistics.table;
  for (const std::string& name : worstScenes(statistics, entry)) {
    const auto scene = std::find_if(statistics.scenes.begin(), statistics.scenes.end(),
                                    [&](const auto& one) { return one.name == name; });
    const auto index = static_cast<std::size_t>(
        std::find(errors.scenes.begin(), errors.scenes.end(), name) - errors.scenes.begin());
    Cell link = textCell(name);
    link.link = scene->report;
    table.rows.push_back(
        {{link, textCell(scene->title), valueCell(errors.errors[rowOf(errors, entry)][index]),
          textCell(scene->best), valueCell(scene->bestError)}});
  }
  return table;
}

}  // namespace

std::vector<std::string> worstScenes(const study::SuiteStatistics& statistics,
                                     const std::string& entry) {
  const compare::SceneTable& table = statistics.table;
  const std::size_t own = rowOf(table, entry);
  std::vector<std::size_t> scenes = compare::sharedScenes(table, {own});
  std::stable_sort(scenes.begin(), scenes.end(), [&](std::size_t a, std::size_t b) {
    return *table.errors[own][a] > *table.errors[own][b];
  });
  scenes.resize(std::min(scenes.size(), worstCount));
  std::vector<std::string> names;
  names.reserve(scenes.size());
  for (const std::size_t scene : scenes) names.push_back(table.scenes[scene]);
  return names;
}

EntryReport entryReport(const study::SuiteStatistics& statistics, const std::string& entry,
                        const SceneFamilies& families) {
  const Against against = againstOf(statistics, entry);
  return {entry,
          placeText(statistics, statistics.methods[placeIn(statistics, entry)]),
          againstText(against),
          neighboursOf(statistics, entry, against),
          familiesOf(statistics, entry, families),
          worstOf(statistics, entry)};
}

PageSection entrySection(const EntryReport& report) {
  return {
      "entry-" + report.entry, report.place,
      html("<p>{} Errors of the other methods are committed ones, on the same scenes.</p>\n{}{}{}",
           report.against, htmlTable(report.neighbours),
           htmlFold(html("By families of scenes"), htmlTable(report.families)),
           htmlTable(report.worst))};
}

}  // namespace gnomon::report
