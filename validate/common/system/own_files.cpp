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

fs::path folderOf(const fs::path& file) {
  std::error_code failure;
  const fs::path target = isProgram(file) ? fs::read_symlink(file, failure) : file;
  return target.parent_path();
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

fs::path installPrefix() {
  const fs::path file = ownFile();
  fs::path folder = folderOf(file);
  const fs::path below = isProgram(file) ? "bin" : GNOMON_LIBRARY_FOLDER;
  for (auto part = below.begin(); part != below.end(); ++part) folder = folder.parent_path();
  return folder;
}

fs::path ownProgram() {
  const fs::path file = ownFile();
  if (isProgram(file)) return file;
  std::error_code failure;
  fs::path built = folderOf(file) / "gnomon";
  return fs::is_regular_file(built, failure) ? built : installPrefix() / "bin/gnomon";
}

}  // namespace gnomon
