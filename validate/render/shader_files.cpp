#include "render/shader_files.h"

#include <fmt/core.h>

#include <cstdlib>
#include <system_error>

#include "common/atomic_file.h"
#include "common/error.h"

namespace gnomon {
namespace fs = std::filesystem;

fs::path shaderFolder() {
  std::error_code failure;
  if (const char* chosen = std::getenv("GNOMON_SHADERS"); chosen != nullptr) {
    if (fs::is_directory(fs::path(chosen) / "common", failure)) return chosen;
    throw InputError(fmt::format("GNOMON_SHADERS: {} holds no folder `common`", chosen));
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", failure);
  fs::path installed = program.parent_path().parent_path() / "share/gnomon/shaders";
  if (!program.empty() && fs::is_directory(installed, failure)) return installed;
  if (fs::is_directory(GNOMON_SOURCE_SHADERS, failure)) return GNOMON_SOURCE_SHADERS;
  throw InputError(fmt::format("no shaders: neither {} nor {} exists; set GNOMON_SHADERS",
                               installed.string(), GNOMON_SOURCE_SHADERS));
}

ShaderPiece readShader(const fs::path& path) {
  return {path.string(), readFile(path)};
}

}  // namespace gnomon
