#pragma once

#include <filesystem>

#include "study/spec/study_file.h"
#include "study/spec/toml_reader.h"

namespace gnomon {

/// What methods are read against.
struct MethodDefaults {
  std::filesystem::path folder;  ///< of the study
  std::filesystem::path shaders;
  BakeSpec bake;
  int baseSubdivisions;
  CurvatureSource baseCurvature;
  int resample;  ///< as Relief::resample
};

/// A `[bake]` over what holds without it.
/// @param resample  as Relief::resample: the section's lengths count texels of the map before it
BakeSpec readBake(const TomlReader& section, BakeSpec bake, int resample);

/// A `[base]` over what holds without it.
void readBase(const TomlReader& section, int& subdivisions, CurvatureSource& curvature);

/// One `[[method]]`.
/// @throws InputError for a file that declares no method, and as TomlReader
MethodSpec readMethodSection(const TomlReader& section, const MethodDefaults& defaults);

/// A method with the keys of a table changed: `name` or `file` (its parameters are then the
/// authors'), `filter`, `bake`, `base`, `parameters`. Keys of none of these are left to the caller.
/// @throws InputError as readMethodSection; for a parameter that the method does not have, or a
///   value out of its range
MethodSpec changedMethod(const TomlReader& section, MethodSpec method,
                         const MethodDefaults& defaults);

/// Whether the method comes with the program, so that a study names it by its `name`.
bool isBuiltIn(const MethodSpec& method);

/// Whether two entries ask for the same masks, whatever their labels.
bool isSameMethod(const MethodSpec& a, const MethodSpec& b);

}  // namespace gnomon
