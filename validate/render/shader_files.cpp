#include "render/shader_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/system/own_files.h"

namespace gnomon::render {
namespace fs = std::filesystem;

fs::path shaderFolder() {
  std::error_code failure;
  if (const char* chosen = std::getenv("GNOMON_SHADERS"); chosen != nullptr) {
    for (const char* part : {"common", "methods"}) {
      if (fs::is_directory(fs::path(chosen) / part, failure)) continue;
      throw InputError(fmt::format("GNOMON_SHADERS: {} holds no folder `{}`", chosen, part));
    }
    return chosen;
  }
  if (const auto installed = installedPath("share/gnomon/shaders")) return *installed;
  throw InputError(
      fmt::format("no shaders: share/gnomon/shaders is in no folder above {}; set "
                  "GNOMON_SHADERS",
                  ownFolder().string()));
}

bool isShader(const fs::directory_entry& entry) {
  constexpr std::array<std::string_view, 4> endings = {".glsl", ".vert", ".geom", ".frag"};
  const fs::path name = entry.path().filename();
  const bool hasEnding =
      std::find(endings.begin(), endings.end(), name.extension()) != endings.end();
  std::error_code ignored;
  return hasEnding && !name.native().starts_with('.') && entry.is_regular_file(ignored);
}

std::vector<fs::path> shadersIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure); !failure && entry != fs::directory_iterator();
       entry.increment(failure)) {
    if (isShader(*entry)) files.push_back(entry->path());
  }
  if (failure) {
    throw InputError(fmt::format("{}: cannot be read: {}", folder.string(), failure.message()));
  }
  std::sort(files.begin(), files.end());
  return files;
}

ShaderPiece readShader(const fs::path& path) {
  return {path.string(), readFile(path), 1};
}

}  // namespace gnomon::render
