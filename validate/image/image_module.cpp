#include "image/image_module.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <cstdlib>
#include <system_error>

#include "common/error.h"
#include "common/text/one_line.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// The module's file, or its mere name where the linker is to look for it.
std::vector<std::string> places() {
  if (const char* chosen = std::getenv("GNOMON_IMAGE_MODULE"); chosen != nullptr) return {chosen};
  std::error_code failure;
  const fs::path program = fs::read_symlink("/proc/self/exe", failure);
  const fs::path installed = program.parent_path() / GNOMON_MODULE_FOLDER / GNOMON_IMAGE_MODULE;
  if (fs::is_regular_file(installed, failure)) return {installed.string()};
  return {GNOMON_IMAGE_MODULE, GNOMON_BUILT_IMAGE_MODULE};
}

const ImageModule& load() {
  void* library = nullptr;
  std::string reason;
  for (const std::string& place : places()) {
    // Never closed: OpenImageIO keeps threads, whose code must not go.
    library = dlopen(place.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (library != nullptr) break;
    reason = dlerror();
  }
  const void* const module = library == nullptr ? nullptr : dlsym(library, imageModuleSymbol);
  if (library != nullptr && module == nullptr) reason = dlerror();
  if (module == nullptr) {
    throw InternalError(fmt::format(
        "no image can be read or written: the module for OpenImageIO cannot be loaded: {}",
        oneLine(reason)));
  }
  return *static_cast<const ImageModule*>(module);
}

}  // namespace

const ImageModule& imageModule() {
  static const ImageModule& module = load();
  return module;
}

}  // namespace gnomon
