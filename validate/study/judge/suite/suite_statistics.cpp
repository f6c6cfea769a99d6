#include "study/judge/suite/suite_statistics.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "common/lists.h"
#include "common/parallel.h"
#include "study/judge/distinguish.h"

namespace gnomon::study {
namespace {

/// Bins are many, and their intervals are not corrected: fewer resamples do.
constexpr std::size_t binResamples = 1999;

using Scenes = std::vector<const StudyMeans*>;

/// The scenes of a suite, by name.
Scenes scenesOf(const std::string& suite, std::span<const StudyMeans> studies) {
  Scenes scenes;
  for (const StudyMeans& study : studies) {
    if (study.suite == suite) scenes.push_back(&study);
  }
  std::sort(scenes.begin(), scenes.end(),
            [](const StudyMeans* a, const StudyMeans* b) { return a->name < b->name; });
  return scenes;
}

/// A mean over fewer cases of a scene than others have cannot be compared with theirs.
std::optional<double> errorOn(const StudyMeans& scene, const std::string& label) {
  const MethodMeans* means = findMeans(scene, label);
  return means != nullptr && means->isInEveryCase() ? means->errorRate : std::nullopt;
}

compare::SceneTable tableOf(const Scenes& scenes) {
  compare::SceneTable table;
  for (const StudyMeans* scene : scenes) {
    table.scenes.push_back(scene->name);
    table.uncertainty.push_back(largestUncertainty(*scene).value_or(0));
    for (const MethodMeans& method : scene->methods) appendOnce(table.methods, method.label);
  }
  for (const std::string& label : table.methods) {
    table.errors.emplace_back();
    for (const StudyMeans* scene : scenes) table.errors.back().push_back(errorOn(*scene, label));
  }
  return compare::sortedByName(table);
}

std::vector<double> chosen(const std::vector<double>& values,
                           const std::vector<std::size_t>& indices) {
  std::vector<double> found;
  found.reserve(indices.size());
  for (const std::size_t i : indices) found.push_back(values[i]);
  return found;
}

std::vector<double> errorsOn(const compare::SceneTable& table, std::size_t method,
                             const std::vector<std::size_t>& scenes) {
  std::vector<double> errors;
  errors.reserve(scenes.size());
  for (const std::size_t s : scenes) errors.push_back(*table.errors[method][s]);
  return errors;
}

double meanOfAll(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Both methods of a pair, as indices of the table, and what becomes of them.
struct Comparison {
  std::size_t first, second;
  std::vector<std::size_t> scenes;
  SuitePair pair;
  std::optional<compare::ResampledMean> mean;
};

/// How many comparisons a thread takes at once: they share the drawing of the resamples.
constexpr std::size_t comparisonsAtOnce = 32;

void compare(const compare::SceneTable& table, Comparison& comparison, compare::ResampledMean of) {
  const std::vector<double> uncertainty = chosen(table.uncertainty, comparison.scenes);
  const compare::ResampledMean& mean = comparison.mean.emplace(std::move(of));
  SuitePair& pair = comparison.pair;
  pair.wins = compare::winShare(errorsOn(table, comparison.first, comparison.scenes),
                                errorsOn(table, comparison.second, comparison.scenes), uncertainty);
  pair.difference = mean.mean();
  pair.interval = mean.interval(0.05);
  pair.reason = mean.reason();
  if (!pair.interval && pair.reason.empty()) pair.reason = "a few scenes decide everything";
  pair.uncertainty = meanOfAll(uncertainty);
  pair.probability = mean.probabilityOfZero();
}

/// @param comparisons  over equally many scenes
void compare(const compare::SceneTable& table, std::span<Comparison* const> comparisons,
             std::size_t resamples) {
  std::vector<std::vector<double>> differences;
  for (const Comparison* comparison : comparisons) {
    std::vector<double>& own =
        differences.emplace_back(errorsOn(table, comparison->first, comparison->scenes));
    const std::vector<double> second = errorsOn(table, comparison->second, comparison->scenes);
    for (std::size_t s = 0; s < own.size(); ++s) own[s] -= second[s];
  }
  std::vector<compare::ResampledMean> means = compare::ResampledMean::ofAll(
      differences, compare::SceneResamples(differences.front().size(), resamples));
  for (std::size_t i = 0; i < means.size(); ++i) {
    compare(table, *comparisons[i], std::move(means[i]));
  }
}

void compareAll(const compare::SceneTable& table, std::vector<Comparison>& comparisons) {
  const std::size_t resamples = compare::resamplesFor(comparisons.size());
  std::map<std::size_t, std::vector<Comparison*>> bySceneCount;
  for (Comparison& comparison : comparisons) {
    bySceneCount[comparison.scenes.size()].push_back(&comparison);
  }
  for (const auto& [scenes, alike] : bySceneCount) {
    const std::span<Comparison* const> all = alike;
    const std::size_t groups = (all.size() + comparisonsAtOnce - 1) / comparisonsAtOnce;
    parallelFor(0, groups, [&](std::size_t group) {
      const std::size_t first = group * comparisonsAtOnce;
      compare(table, all.subspan(first, std::min(comparisonsAtOnce, all.size() - first)),
              resamples);
    });
  }
}

/// Whether two methods answer alike on all of these scenes.
bool answerAlike(const Scenes& scenes, const Comparison& comparison) {
  return comparison.pair.difference == 0 &&
         std::all_of(comparison.scenes.begin(), comparison.scenes.end(), [&](std::size_t s) {
           const auto difference =
               differenceIn(*scenes[s], comparison.pair.first, comparison.pair.second);
           return difference && difference->verdict == DifferenceVerdict::equal;
         });
}

/// Holm's correction over those of some comparisons that have an interval.
/// @returns how many these are
std::size_t correct(const std::vector<Comparison*>& comparisons) {
  std::vector<Comparison*> family;
  std::vector<double> probabilities;
  for (Comparison* comparison : comparisons) {
    if (!comparison->pair.interval) continue;
    family.push_back(comparison);
    probabilities.push_back(comparison->pair.probability);
  }
  const std::vector<compare::HolmStep> steps = compare::holmSteps(probabilities);
  for (std::size_t i = 0; i < family.size(); ++i) {
    SuitePair& pair = family[i]->pair;
    pair.adjusted = steps[i].adjusted;
    pair.corrected = family[i]->mean->interval(steps[i].allowed);
  }
  return family.size();
}

/// Corrects the comparisons with each entry by themselves, the others together, and gives all
/// their verdicts.
/// @returns how many the others are
std::size_t judge(const Scenes& scenes, std::vector<Comparison>& comparisons,
                  const std::vector<std::string>& entries) {
  std::vector<std::vector<Comparison*>> families(entries.size() + 1);
  for (Comparison& comparison : comparisons) {
    const auto entry = std::find_if(entries.begin(), entries.end(), [&](const std::string& label) {
      return comparison.pair.first == label || comparison.pair.second == label;
    });
    families[static_cast<std::size_t>(entry - entries.begin())].push_back(&comparison);
  }
  std::size_t counted = 0;
  for (const auto& family : families) counted = correct(family);
  for (Comparison& comparison : comparisons) {
    SuitePair& pair = comparison.pair;
    const auto interval =
        pair.interval ? pair.corrected.value_or(compare::Interval{-1, 1}) : pair.interval;
    pair.verdict =
        distinguish({pair.difference, interval, pair.uncertainty, answerAlike(scenes, comparison)});
  }
  return counted;
}

std::vector<Comparison> comparisonsOf(const compare::SceneTable& table,
                                      const std::vector<SuiteMethod>& methods) {
  const auto indexOf = [&](const std::string& label) {
    const auto found = std::find(table.methods.begin(), table.methods.end(), label);
    return static_cast<std::size_t>(found - table.methods.begin());
  };
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    for (std::size_t j = i + 1; j < methods.size(); ++j) {
      const std::size_t first = indexOf(methods[i].label);
      const std::size_t second = indexOf(methods[j].label);
      std::vector<std::size_t> shared = compare::sharedScenes(table, {first, second});
      if (shared.empty()) continue;
      SuitePair pair;
      pair.first = methods[i].label;
      pair.second = methods[j].label;
      comparisons.push_back({first, second, std::move(shared), std::move(pair), {}});
    }
  }
  return comparisons;
}

/// Sets what the scenes say of a method's own names, and of its mark.
void nameAfter(const Scenes& scenes, SuiteMethod& method) {
  for (const StudyMeans* scene : scenes) {
    const MethodMeans* means = findMeans(*scene, method.label);
    if (means == nullptr) continue;
    if (method.names.empty()) method.mark = means->mark;
    appendOnce(method.names, means->name);
  }
}

SuiteMethod methodOf(const compare::SceneTable& table, std::size_t m,
                     const compare::SceneSpread& spread) {
  SuiteMethod method;
  method.label = table.methods[m];
  method.spread = spread;
  method.worstScene = table.scenes[spread.worstScene];
  const std::vector<std::size_t> own = compare::sharedScenes(table, {m});
  const compare::ResampledMean mean(errorsOn(table, m, own), compare::SceneResamples(own.size()));
  if (const auto interval = mean.interval(0.05)) {
    method.interval =
        compare::Interval{std::max(0.0, interval->low), std::min(1.0, interval->high)};
  } else {
    method.reason = mean.reason().empty() ? "a few scenes decide everything" : mean.reason();
  }
  method.uncertainty = meanOfAll(chosen(table.uncertainty, own));
  return method;
}

/// Gives a rank to each method that has all scenes.
void rank(const compare::SceneTable& table, std::vector<SuiteMethod>& methods) {
  std::vector<SuiteMethod*> ranked;
  std::vector<std::vector<double>> errors;
  std::vector<std::size_t> all(table.scenes.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  for (SuiteMethod& method : methods) {
    if (method.spread.scenes != all.size()) continue;
    const auto found = std::find(table.methods.begin(), table.methods.end(), method.label);
    ranked.push_back(&method);
    errors.push_back(errorsOn(table, static_cast<std::size_t>(found - table.methods.begin()), all));
  }
  if (ranked.empty()) return;
  const std::vector<compare::SceneRank> ranks =
      compare::ranksOver(errors, compare::SceneResamples(all.size()));
  for (std::size_t i = 0; i < ranked.size(); ++i) ranked[i]->rank = ranks[i];
}

std::vector<SuiteMethod> methodsOf(const compare::SceneTable& table, const Scenes& scenes) {
  std::vector<std::optional<SuiteMethod>> found(table.methods.size());
  parallelFor(0, found.size(), [&](std::size_t m) {
    if (const auto spread = compare::spreadOver(table.errors[m]))
      found[m] = methodOf(table, m, *spread);
  });
  std::vector<SuiteMethod> methods;
  for (auto& method : found) {
    if (!method) continue;
    nameAfter(scenes, *method);
    methods.push_back(std::move(*method));
  }
  rank(table, methods);
  std::stable_sort(methods.begin(), methods.end(), [](const auto& a, const auto& b) {
    if (a.rank && b.rank) return a.rank->rank < b.rank->rank;
    if (a.rank || b.rank) return a.rank.has_value();
    return a.spread.scenes > b.spread.scenes;
  });
  return methods;
}

/// Where a bin lies: the one without a lower end comes first.
using BinPlace = std::tuple<std::string, std::optional<double>, std::optional<double>>;

/// What each scene gives to the bins of one method; nothing where the method lacks the scene.
std::map<BinPlace, std::vector<compare::SceneShare>> sharesOf(const Scenes& scenes,
                                                              const std::string& label) {
  std::map<BinPlace, std::vector<compare::SceneShare>> shares;
  std::size_t count = 0;
  for (const StudyMeans* scene : scenes) {
    if (!errorOn(*scene, label)) continue;
    ++count;
    for (const SceneBin& bin : scene->bins) {
      if (bin.method != label) continue;
      std::vector<compare::SceneShare>& own = shares[{bin.axis, bin.low, bin.high}];
      own.resize(count);
      own.back() = bin.share;
    }
  }
  for (auto& [place, own] : shares) own.resize(count);
  return shares;
}

std::vector<SuiteBin> binsOf(const Scenes& scenes, const std::vector<SuiteMethod>& methods) {
  std::vector<std::vector<SuiteBin>> found(methods.size());
  parallelFor(0, methods.size(), [&](std::size_t m) {
    for (const auto& [place, shares] : sharesOf(scenes, methods[m].label)) {
      const auto& [axis, low, high] = place;
      const auto error =
          compare::binnedError(shares, compare::SceneResamples(shares.size(), binResamples));
      if (error) found[m].push_back({methods[m].label, axis, low, high, *error});
    }
  });
  std::vector<SuiteBin> bins;
  for (auto& own : found) bins.insert(bins.end(), own.begin(), own.end());
  return bins;
}

/// @param ranked  indices of the methods with a rank, by name
SuiteScene sceneOf(const compare::SceneTable& table, std::size_t s,
                   const std::vector<std::size_t>& ranked) {
  SuiteScene scene;
  scene.name = table.scenes[s];
  scene.report = scene.name + "/report.html";
  scene.uncertainty = table.uncertainty[s];
  std::vector<double> errors;
  for (const std::size_t m : ranked) {
    const double error = *table.errors[m][s];
    errors.push_back(error);
    if (scene.bestError && !(error < *scene.bestError)) continue;
    scene.best = table.methods[m];
    scene.bestError = error;
  }
  if (errors.empty()) return scene;
  std::sort(errors.begin(), errors.end());
  scene.median = quantile(errors, 0.5);
  return scene;
}

std::vector<SuiteScene> hardestFirst(const compare::SceneTable& table, const Scenes& scenes,
                                     const std::vector<SuiteMethod>& methods) {
  std::vector<std::size_t> ranked;
  for (std::size_t m = 0; m < table.methods.size(); ++m) {
    const bool isRanked = std::any_of(
        methods.begin(), methods.end(),
        [&](const SuiteMethod& method) { return method.rank && method.label == table.methods[m]; });
    if (isRanked) ranked.push_back(m);
  }
  std::vector<SuiteScene> hard;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    hard.push_back(sceneOf(table, s, ranked));
    hard.back().title = scenes[s]->title;
    if (!ranked.empty()) hard.back().leaderError = errorOn(*scenes[s], methods.front().label);
  }
  std::stable_sort(hard.begin(), hard.end(),
                   [](const auto& a, const auto& b) { return a.median > b.median; });
  return hard;
}

}  // namespace

std::string suiteOf(std::span<const StudyMeans> studies) {
  std::string suite;
  std::size_t scenes = 0;
  for (const StudyMeans& study : studies) {
    if (study.suite.empty()) continue;
    if (scenes > 0 && study.suite != suite) return "";
    suite = study.suite;
    ++scenes;
  }
  return scenes >= compare::leastScenes ? suite : "";
}

SuiteStatistics suiteStatistics(const std::string& suite, std::span<const StudyMeans> studies,
                                const std::vector<std::string>& entries) {
  const Scenes scenes = scenesOf(suite, studies);
  SuiteStatistics statistics{suite, tableOf(scenes), {}, {}, {}, {}};
  statistics.methods = methodsOf(statistics.table, scenes);
  statistics.isSoft = std::any_of(studies.begin(), studies.end(), [&](const StudyMeans& study) {
    return study.suite == suite && study.isSoft;
  });
  std::vector<Comparison> comparisons = comparisonsOf(statistics.table, statistics.methods);
  compareAll(statistics.table, comparisons);
  statistics.entries = entries;
  statistics.comparisons = judge(scenes, comparisons, entries);
  for (Comparison& comparison : comparisons) statistics.pairs.push_back(std::move(comparison.pair));
  statistics.bins = binsOf(scenes, statistics.methods);
  statistics.scenes = hardestFirst(statistics.table, scenes, statistics.methods);
  return statistics;
}

std::string reportOf(const SuiteStatistics& statistics, std::string_view scene) {
  const auto found = std::find_if(statistics.scenes.begin(), statistics.scenes.end(),
                                  [&](const SuiteScene& other) { return other.name == scene; });
  return found == statistics.scenes.end() ? "" : found->report;
}

std::optional<SuitePair> findPair(const SuiteStatistics& statistics, std::string_view first,
                                  std::string_view second) {
  for (const SuitePair& pair : statistics.pairs) {
    if (pair.first == first && pair.second == second) return pair;
    if (pair.first != second || pair.second != first) continue;
    SuitePair other = pair;
    std::swap(other.first, other.second);
    other.wins = compare::swapped(pair.wins);
    other.difference = -pair.difference;
    for (std::optional<compare::Interval>* interval : {&other.interval, &other.corrected}) {
      if (*interval) *interval = compare::Interval{-(*interval)->high, -(*interval)->low};
    }
    other.verdict = opposite(pair.verdict);
    return other;
  }
  return std::nullopt;
}

}  // namespace gnomon::study
