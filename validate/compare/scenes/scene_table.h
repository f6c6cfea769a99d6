#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::compare {
/// Statistics over scenes: the scenes are drawn from one population, each independently of the
/// others, and the scene is the unit. An interval speaks of further scenes of that population.

/// Error rates of methods on scenes, 0 to 1.
struct SceneTable {
  std::vector<std::string> scenes;   ///< distinct names
  std::vector<std::string> methods;  ///< distinct names
  /// `errors[m][s]`: of method m on scene s; none where it was not measured there.
  std::vector<std::vector<std::optional<double>>> errors;
  /// By how much the truth itself may be wrong, one a scene.
  std::vector<double> uncertainty;
};

/// The same table with scenes and methods in the order of their names. All functions of this folder
/// add in the order of the table: sorted first, no result depends on the order of input.
/// @throws InternalError for sizes that do not fit, for a name twice, and for an error that is not
///   within 0 to 1 or an uncertainty that is not finite and 0 or more
SceneTable sortedByName(const SceneTable& table);

/// The scenes on which all of the methods have an error, ascending.
/// @param methods  indices
std::vector<std::size_t> sharedScenes(const SceneTable& table,
                                      const std::vector<std::size_t>& methods);

/// How one method's errors are spread over the scenes on which it was measured.
struct SceneSpread {
  std::size_t scenes = 0;  ///< with an error
  double mean = 0;
  double median = 0;  ///< quantiles as common/lists.h: linear between neighbours in order
  double lowerQuartile = 0;
  double upperQuartile = 0;
  double percentile95 = 0;
  /// Mean of the worst twentieth of the scenes, rounded up to whole scenes: what is to be expected
  /// where the method does badly.
  double worstTwentieth = 0;
  double worst = 0;
  std::size_t worstScene = 0;  ///< index; of equal ones the first
  bool operator==(const SceneSpread&) const = default;
};

/// @param errors  one a scene; none where there is no error
/// @returns none where no scene has an error
std::optional<SceneSpread> spreadOver(std::span<const std::optional<double>> errors);

}  // namespace gnomon::compare
