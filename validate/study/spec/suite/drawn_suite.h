#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
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

/// A file of a drawn suite.
struct SuiteStudy {
  std::string file;   ///< "suite-1-test-0017.toml"
  std::string scene;  ///< its text up to the line `methodsMark`
  std::string text;   ///< all of it
  toml::table facts;
};

/// A mesh, a height map, or the terms of those beside it.
struct SuiteCopy {
  std::string file;  ///< "meshes/spot_control_mesh.obj", in the suite and in the drawn folder
  std::string bytes;
};

struct DrawnSuite {
  std::string suite, seed;
  SuiteSplit split = SuiteSplit::test;
  std::vector<SuiteStudy> studies;
  std::vector<SuiteCopy> copies;
  /// What one commits to: the SHA-256 of the lines that `sha256sum` prints of all scenes, in their
  /// order, and of all copies, in theirs: "HASH  FILE\n", a scene being its text without methods.
  std::string sha256;
};

/// The line at which the scene ends and its methods begin.
constexpr std::string_view methodsMark = "# The methods are no part of the scene.\n";

/// Draws scenes 1 to `count`, on all threads; see drawScene.
/// @throws InputError for files that cannot be read, or limits that no scene keeps
DrawnSuite drawSuite(const SuiteSpec& suite, const SuiteMethods& methods, SuiteSplit split,
                     const std::string& seed, int count);

/// Writes all files into a folder: studies, what they read, with its terms, and the manifest.
/// @param manifest  text of manifest.json, which is written last
/// @throws InputError for a folder that has files already, or cannot be written
void writeSuite(const DrawnSuite& suite, const std::string& manifest,
                const std::filesystem::path& folder);

/// The sections of a study as the text of a TOML file: `[key]`, or `[[key]]` for each table of a
/// list, in the given order; below them `key = value`, in alphabetical order. Every byte is made
/// here, and none by a library, whose next version may write another form of the same values:
/// strings in double quotes, numbers with the fewest digits that read back to the bit.
/// @param order  all sections; those that are not there are left out
std::string suiteText(const toml::table& study, const std::vector<std::string_view>& order);

}  // namespace gnomon::study
