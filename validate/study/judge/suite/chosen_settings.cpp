#include "study/judge/suite/chosen_settings.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "common/lists.h"
#include "study/spec/toml_reader.h"

namespace gnomon::study {

namespace {

/// @throws InputError where the table lacks the method
std::size_t rowOf(const compare::SceneTable& table, const std::string& label) {
  const auto found = std::find(table.methods.begin(), table.methods.end(), label);
  if (found == table.methods.end()) {
    throw InputError(fmt::format(
        "\"{}\" not found among the methods of these scenes; scenes that `gnomon suite --split "
        "train` drew with the same list of methods expected",
        label));
  }
  return static_cast<std::size_t>(found - table.methods.begin());
}

double meanOn(const compare::SceneTable& table, std::size_t method,
              const std::vector<std::size_t>& scenes) {
  double sum = 0;
  for (const std::size_t scene : scenes) sum += *table.errors[method][scene];
  return sum / static_cast<double>(scenes.size());
}

/// @param values  without means
TriedSetting measured(TriedSetting setting, const compare::SceneTable& train) {
  std::vector<std::size_t> rows;
  for (const TriedValue& value : setting.values) rows.push_back(rowOf(train, value.label));
  const std::vector<std::size_t> scenes = compare::sharedScenes(train, rows);
  if (scenes.empty()) {
    throw InputError(fmt::format("\"{}\": no scene has an error for every value of {}",
                                 setting.values.front().label, setting.key));
  }
  setting.scenes = scenes.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    setting.values[i].mean = meanOn(train, rows[i], scenes);
  }
  const auto best =
      std::min_element(setting.values.begin(), setting.values.end(),
                       [](const TriedValue& a, const TriedValue& b) { return a.mean < b.mean; });
  setting.best = static_cast<std::size_t>(best - setting.values.begin());
  return setting;
}

/// The changed method that has a value of a setting.
const VariedMethod& variedOf(const SuiteMethods& methods, const TriedSetting& setting,
                             const std::string& value) {
  return *std::find_if(methods.varied.begin(), methods.varied.end(), [&](const VariedMethod& one) {
    return one.of == setting.method && one.key == setting.key && one.value == value;
  });
}

}  // namespace

std::vector<TriedSetting> triedSettings(const SuiteMethods& methods,
                                        const compare::SceneTable& train) {
  std::vector<TriedSetting> tried;
  for (const VariedMethod& one : methods.varied) {
    const toml::table& authors = methods.methods[one.of];
    if (tried.empty() || tried.back().method != one.of || tried.back().key != one.key) {
      const toml::node* own = settingOf(authors, one.key);
      tried.push_back({one.of, one.key, 0, {}, 0});
      tried.back().values.push_back(
          {own == nullptr ? "" : tomlValueText(*own), labelOfMethod(authors), 0});
    }
    tried.back().values.push_back({one.value, labelOfMethod(one.changed), 0});
  }
  for (TriedSetting& setting : tried) setting = measured(std::move(setting), train);
  return tried;
}

std::vector<toml::table> chosenMethods(const SuiteMethods& methods,
                                       const std::vector<TriedSetting>& tried) {
  std::vector<std::optional<toml::table>> chosen(methods.methods.size());
  for (const TriedSetting& setting : tried) {
    if (setting.best == 0) continue;
    const VariedMethod& best = variedOf(methods, setting, setting.values[setting.best].value);
    std::optional<toml::table>& method = chosen[setting.method];
    method = withSetting(method.value_or(methods.methods[setting.method]), setting.key,
                         *settingOf(best.changed, setting.key));
  }
  std::vector<toml::table> all;
  for (std::optional<toml::table>& method : chosen) {
    if (method) all.push_back(std::move(*method));
  }
  return all;
}

namespace {

std::optional<double> meanIn(const SuiteRanking& ranking, const std::string& label) {
  for (const SuiteRanking::Method& method : ranking.methods) {
    if (method.label == label) return method.mean;
  }
  return std::nullopt;
}

bool isToldApart(const SuiteRanking& ranking, const std::string& a, const std::string& b) {
  return contains(ranking.distinguishable, std::pair(a, b)) ||
         contains(ranking.distinguishable, std::pair(b, a));
}

}  // namespace

SuiteRanking rankingOf(const SuiteStatistics& statistics) {
  SuiteRanking ranking;
  for (const SuiteMethod& method : statistics.methods) {
    if (method.rank) ranking.methods.push_back({method.label, method.spread.mean});
  }
  for (const SuitePair& pair : statistics.pairs) {
    if (pair.verdict == DifferenceVerdict::better) {
      ranking.distinguishable.emplace_back(pair.first, pair.second);
    } else if (pair.verdict == DifferenceVerdict::worse) {
      ranking.distinguishable.emplace_back(pair.second, pair.first);
    }
  }
  return ranking;
}

SuiteAgreement agreementOf(const SuiteRanking& first, const SuiteRanking& second) {
  std::vector<SuiteRanking::Method> shared;
  std::vector<double> means, others;
  for (const SuiteRanking::Method& method : first.methods) {
    const auto other = meanIn(second, method.label);
    if (!other) continue;
    shared.push_back(method);
    means.push_back(method.mean);
    others.push_back(*other);
  }
  SuiteAgreement agreement;
  agreement.methods = shared.size();
  agreement.tau = compare::kendallTau(means, others);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    for (std::size_t j = i + 1; j < shared.size(); ++j) {
      ++agreement.pairs;
      if (!((means[i] - means[j]) * (others[i] - others[j]) < 0)) continue;
      ++agreement.swapped;
      const std::string& a = shared[i].label;
      const std::string& b = shared[j].label;
      if (isToldApart(first, a, b) || isToldApart(second, a, b)) {
        agreement.contradictions.emplace_back(a, b);
      }
    }
  }
  return agreement;
}

}  // namespace gnomon::study
