#include "common/system/own_files.h"

#include <dlfcn.h>
#include <link.h>

#include <system_error>

namespace gnomon {
namespace fs = std::filesystem;
namespace {

constexpr const char* runningProgram = "/proc/self/exe";

bool isProgram(const fs::path& file) {
  return file == runningProgram;
}

}  // namespace

fs::path ownFile() {
  Dl_info symbol{};
  link_map* object = nullptr;
  const int found = dladdr1(reinterpret_cast<const void*>(&ownFile), &symbol,
                            reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP);
  // The loader has no name for the program itself.
  if (found == 0 || object == nullptr || *object->l_name == '\0') return runningProgram;
  std::error_code failure;
  const fs::path library = fs::canonical(object->l_name, failure);
  return failure ? fs::path(object->l_name) : library;
}

fs::path ownFolder() {
  const fs::path file = ownFile();
  std::error_code failure;
  const fs::path target = isProgram(file) ? fs::read_symlink(file, failure) : file;
  return target.parent_path();
}

std::optional<fs::path> installedFile(const fs::path& relative) {
  fs::path folder = ownFolder();
  while (true) {
    std::error_code failure;
    fs::path found = fs::canonical(folder / relative, failure);
    if (!failure) return found;
    if (folder == folder.parent_path()) return std::nullopt;
    folder = folder.parent_path();
  }
}

fs::path ownProgram() {
  const fs::path file = ownFile();
  if (isProgram(file)) return file;
  std::error_code failure;
  fs::path built = ownFolder() / "gnomon";
  if (fs::is_regular_file(built, failure)) return built;
  return installedFile("bin/gnomon").value_or(built);
}

}  // namespace gnomon
