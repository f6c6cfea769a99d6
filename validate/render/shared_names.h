#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/method.h"

namespace gnomon::render {

/// A function, structure, uniform or constant of `shaders/common/` that a method may use.
struct SharedName {
  std::string name;
  std::string file;  ///< name of the file that defines it
  /// The defines under any of which it exists, `TABLE_HEIGHT` say; empty where every method has it.
  std::vector<std::string> defines;
};

/// All names that methods may use, by file and in the order of each file.
std::vector<SharedName> sharedNames(const std::filesystem::path& shaders);

/// The bake, texture or pass of a method's own that a name of its code would belong to: "occlusion"
/// for `occlusionAt`, `occlusionTexel`, `occlusionBake`, `occlusionTexture`, `occlusionPass` and
/// `occlusionOrigin`; empty for other names.
std::string ownNameOf(const std::string& word);

/// What a method's first comment must hold for a define: `tables = ["height"]` for `TABLE_HEIGHT`.
/// Empty for a define that no declaration sets.
std::string declarationFor(const std::string& define);

/// The end of a message for a method that uses a name without the declaration that provides it:
/// `; heightAt needs tables = ["height"]`. Empty if no declaration would help. An undeclared type
/// is a syntax error whose message names no type, so that for a syntax error the words of the line
/// are looked up too.
/// @param message  of the GLSL compiler, `FILE:LINE: error: …`
/// @param method   that was compiled
/// @param defines  that it was compiled with
std::string missingDeclaration(const std::vector<SharedName>& names, const std::string& message,
                               const Method& method, const std::vector<std::string>& defines);

}  // namespace gnomon::render
