#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "render/method.h"
#include "render/passes/method_pass.h"
#include "study/spec/sections/bake_section.h"
#include "study/spec/sections/study_key.h"
#include "study/spec/toml_reader.h"

namespace gnomon::study {

struct StudySpec;

/// What follows the name of a method with `disc = true`, in its label.
constexpr const char* discLabel = " + disc";

/// `[[method]]`
struct MethodSpec {
  std::filesystem::path file = {};  ///< its GLSL; empty where masks are given
  std::string label = {};           ///< unique in the study
  BakeSpec bake = {};               ///< the study's, with the method's overrides
  BaseSpec base = {};               ///< of the mesh that it draws
  render::TableFilter filter = render::TableFilter::exact;
  std::map<std::string, double> parameters = {};
  /// Whether its horizon is compared with the light's disc by the closed form, where it has one.
  bool disc = false;
  /// The folder with the masks that another program drew; empty for a method that runs here.
  std::filesystem::path masks = {};
  /// In a case of a sweep: the subfolder of `masks` with those of the case, named as the case is.
  std::filesystem::path maskCase = {};
  std::string masksKey = {};  ///< "study.toml:12: method.2.masks", where `masks` is named

  [[nodiscard]] bool isGiven() const { return !masks.empty(); }
  /// The folder that holds the files.
  [[nodiscard]] std::filesystem::path maskFolder() const {
    return maskCase.empty() ? masks : masks / maskCase;
  }
};

inline StudyKeys keysOf(MethodSpec& method) {
  const std::vector<std::pair<render::TableFilter, std::string>> filters = {
      {render::TableFilter::exact, "exact"}, {render::TableFilter::hardware, "hardware"}};
  return {
      studyKey("name", OwnCode{"text"}, "a method that `gnomon list` names", {},
               "`file` or `masks` is there"),
      studyKey("file", OwnCode{"text"}, "your GLSL, in place of `name`", {},
               "`name` or `masks` is there"),
      studyKey("masks", OwnCode{"text"},
               "a folder of masks that another program drew for the exported samples, in place of "
               "`name`, of a sweep with a subfolder for each case; beside it only `label` is read",
               {}, "`name` or `file` is there"),
      studyKey("label", &method.label, "the study's name for it", {},
               "`name`, or the stem of the file or folder", Enters::nothing),
      studyKey("filter", chosenName(method.filter, filters),
               "interpolation of tables: in floats, or by the GPU's texture filter"),
      studyKey(
          "disc", Unusual{&method.disc},
          "of a method with a horizon: the share of the light's disc above it, in place of lit "
          "or shadowed"),
      studyKey("bake", OwnCode{"a table"}, "keys of `[bake]`, over the study's", {}, "none"),
      studyKey("base", OwnCode{"a table"}, "keys of `[base]`, over the study's", {}, "none"),
      studyKey("parameters", OwnCode{"a table of numbers"},
               "the method's own, which `gnomon list` names with ranges and defaults", {}, "none")};
}

/// What the method declares: in its shader's first comment. One that is given as masks reads no
/// table and answers at the samples of the base mesh, which are the exported ones.
/// @throws InputError as render::readMethod
render::Method declarationOf(const MethodSpec& method);

/// What a method is called that is given as a folder of masks: the folder's name.
std::string givenName(const std::filesystem::path& masks);

/// What methods declare, by their files, each read once.
using DeclaredMethods = std::map<std::filesystem::path, render::Method>;

/// What methods are read against.
struct MethodDefaults {
  std::filesystem::path folder;  ///< of the study
  std::filesystem::path shaders;
  BakeSpec bake;
  BaseSpec base;
  int resample;               ///< as Relief::resample
  DeclaredMethods& declared;  ///< gets those that are read
};

/// One `[[method]]`.
/// @throws InputError for a file that declares no method, and as TomlReader
MethodSpec readMethodSection(const TomlReader& section, const MethodDefaults& defaults);

/// A method that runs here with the keys of a table changed: `name` or `file` (its parameters are
/// then the authors'), `filter`, `bake`, `base`, `parameters`. Keys of none of these are left to
/// the caller.
/// @throws InputError as readMethodSection; for a parameter that the method does not have, or a
///   value out of its range
MethodSpec changedMethod(const TomlReader& section, MethodSpec method,
                         const MethodDefaults& defaults);

/// A method as a table of the file, with all parameters that its shader declares.
/// @param folder    that the file lies in
/// @param resample  as Relief::resample
/// @throws InputError for a method's file that cannot be read
toml::table tableOf(const MethodSpec& method, const std::filesystem::path& folder, int resample);

/// Whether the method comes with the program, so that a study names it by its `name`.
bool isBuiltIn(const MethodSpec& method);

/// Whether two entries ask for the same masks, whatever their labels.
bool isSameMethod(const MethodSpec& a, const MethodSpec& b);

/// The masks of a folder by their names: the file's without its extension, and without the `_truth`
/// that an export gives the truth's. Folders, hidden files, and what file managers leave
/// (`Thumbs.db`, `desktop.ini`) are not looked at.
/// @throws InputError for a folder that cannot be read, or two files of one name
std::map<std::string, std::filesystem::path> masksIn(const std::filesystem::path& folder);

/// A mask of a method that another program drew.
struct GivenMaskFile {
  std::size_t view = 0, light = 0;  ///< places in the study
  std::filesystem::path path;
};

/// The masks of a method, one a view and light, the lights of the first view first: those of its
/// folder that are named VIEW_LIGHT, as an export names the truth's. Nothing for a method that runs
/// here.
/// @throws InputError as masksIn, and for a mask that is missing
std::vector<GivenMaskFile> givenMaskFiles(const StudySpec& study, const MethodSpec& method);

}  // namespace gnomon::study
