#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "study/spec/suite/drawn_scene.h"

namespace gnomon::study {

/// A method of the list with one setting changed.
struct VariedMethod {
  std::size_t of = 0;   ///< index of the method with its authors' settings
  std::string key;      ///< as "bake.azimuths"
  std::string value;    ///< as a TOML file has it
  toml::table changed;  ///< labelled "NAME, azimuths 16"
};

/// The methods that a suite's scenes are measured with, as scenes/suite/methods.toml. They are no
/// part of a suite: new methods may come, and its scenes stay.
///
/// Each `[[method]]` is one of a study, with the settings of its authors, and a table `vary`: the
/// few other values of each setting that they leave open, by its key below the method, as
/// `vary = { "bake.azimuths" = [16, 64], "parameters.steps" = [32, 128] }`. `camera = true` says
/// that a method answers at a camera's pixels alone: a study of an atlas goes without it.
/// One with `disc = true` stands in studies of a disc of light alone.
struct SuiteMethods {
  std::vector<toml::table> methods;  ///< without `vary`
  std::vector<VariedMethod> varied;  ///< by method and key, in the order of the file
  std::vector<toml::table> chosen;   ///< of the file of settings, labelled "NAME, chosen"
  std::set<std::string> ofCameras;   ///< names (or files) of those that need a camera
};

/// A method with one setting changed.
/// @param key  as "bake.azimuths"
toml::table withSetting(toml::table method, const std::string& key, const toml::node& value);

/// The setting of a method that has it; nullptr where the method's shader declares it alone.
const toml::node* settingOf(const toml::table& method, const std::string& key);

/// What a report calls a method of the list: its label, else its name, else its file.
std::string labelOfMethod(const toml::table& method);

/// @param settings  a file of `[[method]]` tables: the settings that were chosen on train; none
///   where the authors' were the best
/// @throws InputError naming file, line and key
SuiteMethods readSuiteMethods(const std::filesystem::path& file,
                              const std::optional<std::filesystem::path>& settings);

/// scenes/suite/methods.toml beside the program's shaders.
std::filesystem::path standardMethodsFile();

/// The list `method` of one scene's study: all methods; on train with every varied setting, on test
/// with the chosen ones. `base.subdivisions` and `parameters.light_pieces` of a method count pieces
/// of a piece of the scene's own base mesh, so that a piece has the same size in texels everywhere.
toml::array methodsOf(const SuiteMethods& methods, const DrawnScene& scene, SuiteSplit split);

}  // namespace gnomon::study
