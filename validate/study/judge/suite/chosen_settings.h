#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compare/scenes/scene_table.h"
#include "study/spec/suite/suite_methods.h"

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

}  // namespace gnomon::study
