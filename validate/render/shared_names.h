#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/method.h"

namespace gnomon::render {

/// A function, structure, uniform or constant of `shaders/common/` that a method may use.
struct SharedName {
  std::string name;
  std::string file;                       ///< name of the file that defines it
  std::string signature = {};             ///< of a function: "float heightAt(vec2 at)"
  std::vector<std::string> members = {};  ///< of a structure
  /// The defines under any of which it exists, `TABLE_HEIGHT` say; empty where every method has it.
  std::vector<std::string> defines = {};
};

/// All names that methods may use, by file and in the order of each file.
std::vector<SharedName> sharedNames(const std::filesystem::path& shaders);

/// The names that a text defines.
/// @param always  the defines under which all of it exists
std::vector<SharedName> namesIn(const ShaderPiece& text, const std::vector<std::string>& always);

/// The bake, texture or pass of a method's own that a name of its code would belong to: "occlusion"
/// for `occlusionAt`, `occlusionTexel`, `occlusionBake`, `occlusionTexture`, `occlusionPass` and
/// `occlusionOrigin`; empty for other names.
std::string ownNameOf(const std::string& word);

/// What a method's first comment must hold for a define: `tables = ["height"]` for `TABLE_HEIGHT`.
/// Empty for a define that no declaration sets.
std::string declarationFor(const std::string& define);

}  // namespace gnomon::render
