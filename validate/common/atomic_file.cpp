#include "common/atomic_file.h"

#include <fmt/core.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <system_error>

#include "common/error.h"
#include "common/memory.h"

namespace gnomon {
namespace fs = std::filesystem;

void writeAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  std::error_code failure;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), failure);
  if (failure) {
    throw InputError(fmt::format("{}: cannot create the folder: {}", path.parent_path().string(),
                                 failure.message()));
  }
  fs::path temporary = path;
  temporary.replace_filename(
      fmt::format(".{}.{}.part{}", path.stem().string(), ::getpid(), path.extension().string()));
  try {
    write(temporary);
    fs::rename(temporary, path);
  } catch (const fs::filesystem_error& error) {
    fs::remove(temporary, failure);
    throw InputError(
        fmt::format("{}: cannot be written: {}", path.string(), error.code().message()));
  } catch (...) {
    fs::remove(temporary, failure);
    throw;
  }
}

void writeTextAtomically(const fs::path& path, std::string_view text) {
  writeAtomically(path, [&](const fs::path& temporary) {
    std::ofstream file(temporary, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) throw InputError(fmt::format("{}: cannot be written", path.string()));
  });
}

std::string readFile(const fs::path& path) {
  std::error_code failure;
  if (fs::is_directory(path, failure)) {
    throw InputError(fmt::format("{}: is a folder, a file was expected", path.string()));
  }
  if (fs::is_character_file(path, failure) || fs::is_block_file(path, failure)) {
    throw InputError(fmt::format("{}: is a device, a file was expected", path.string()));
  }
  const auto bytes = fs::file_size(path, failure);
  // The stream's copy and the returned one.
  if (!failure) requireMemory(2.0 * static_cast<double>(bytes), path.string());
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: no such file, or it cannot be read", path.string()));
  std::ostringstream content;
  content << file.rdbuf();
  if (!file) throw InputError(fmt::format("{}: cannot be read to its end", path.string()));
  return std::move(content).str();
}

}  // namespace gnomon
