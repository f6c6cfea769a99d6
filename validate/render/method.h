#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "render/shader_files.h"

namespace gnomon {

/// A number that a method's quality hangs on, a uniform of the same name in its GLSL.
struct MethodParameter {
  double standard = 0;  ///< the authors' value
  double minimum = 0;
  double maximum = 0;
  std::string about;
};

/// Which textures a method reads.
struct MethodTables {
  bool height = false;
  bool horizon = false;
  bool distance = false;
};

/// A shadow method: one GLSL file whose first comment declares it. The comment opens with
/// `gnomon-method` and holds TOML: `title`, `citation`, `tables` (a list of "height", "horizon",
/// "distance") and a table `parameters.NAME` for each parameter with `default`, `minimum`,
/// `maximum`, `about`. The file defines `bool isShadowed(Pixel pixel, LocalLight light)`.
struct Method {
  std::string name;  ///< the file's stem
  std::string title;
  std::string citation;
  MethodTables tables;
  std::map<std::string, MethodParameter> parameters;
  ShaderPiece source;
};

/// @throws InputError naming file and line for a declaration that is missing, malformed, or holds a
///   key that it should not
Method readMethod(const std::filesystem::path& path);

/// The method's file: `methods/NAME.glsl` in the shader folder.
/// @throws InputError listing the methods there are, if that is none of them
std::filesystem::path methodFile(const std::filesystem::path& shaders, const std::string& name);

/// Names of all methods in the shader folder, sorted.
std::vector<std::string> methodNames(const std::filesystem::path& shaders);

}  // namespace gnomon
