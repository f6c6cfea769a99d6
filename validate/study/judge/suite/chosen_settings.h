#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/scenes/comparisons.h"
#include "study/judge/suite/suite_statistics.h"
#include "study/spec/suite/drawn_suite.h"

namespace gnomon::study {

/// One rule chooses for every method what its authors leave open: of each setting the value with
/// the least mean error over the scenes of train, one setting at a time.

/// One value of a setting.
struct TriedValue {
  std::string value;  ///< as a TOML file has it; empty for that of the method's own declaration
  std::string label;  ///< of the method that had it
  double mean = 0;    ///< of its errors, over the scenes of the setting
};

/// One setting of one method.
struct TriedSetting {
  std::size_t method = 0;          ///< index in the list of methods
  std::string key;                 ///< as "bake.azimuths"
  std::size_t scenes = 0;          ///< those on which the method has an error with every value
  std::vector<TriedValue> values;  ///< the authors' first, then as they are listed
  std::size_t best = 0;            ///< of the smallest mean; of equal ones the first
};

/// Of every setting that the list varies, in its order.
/// @param train  the errors of a suite's scenes, drawn with this list for the split `train`
/// @throws InputError naming the label where the table lacks a method of the list, and where no
///   scene has all values of a setting
std::vector<TriedSetting> triedSettings(const SuiteMethods& methods,
                                        const compare::SceneTable& train);

/// The `[[method]]` tables of those methods for which another value than the authors' is best, with
/// the best values of all their settings, as `gnomon suite --settings` reads them.
std::vector<toml::table> chosenMethods(const SuiteMethods& methods,
                                       const std::vector<TriedSetting>& tried);

/// How the ranking over one set of scenes agrees with that over another.

struct SuiteRanking {
  struct Method {
    std::string label;
    double mean = 0;
  };
  std::vector<Method> methods;  ///< those with a rank
  /// Of two labels each, the better first: those that are distinguishable.
  std::vector<std::pair<std::string, std::string>> distinguishable;
};

SuiteRanking rankingOf(const SuiteStatistics& statistics);

struct SuiteAgreement {
  std::size_t methods = 0;    ///< with a rank in both
  std::optional<double> tau;  ///< Kendall's τ-b of their means; none for fewer than two methods
  std::size_t pairs = 0;      ///< of these methods
  std::size_t swapped = 0;    ///< pairs in another order there
  /// Swapped pairs that are distinguishable in at least one of the rankings, in the first one's
  /// order. None are expected.
  std::vector<std::pair<std::string, std::string>> contradictions;
};

SuiteAgreement agreementOf(const SuiteRanking& first, const SuiteRanking& second);

}  // namespace gnomon::study
