#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/spec/suite/drawn_scene.h"
#include "study/spec/suite/suite_methods.h"

namespace gnomon::study {

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

}  // namespace gnomon::study
