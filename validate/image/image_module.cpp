#include "image/image_module.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <cstdlib>
#include <system_error>

#include "common/error.h"
#include "common/system/own_files.h"
#include "common/text/one_line.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// The module's file: the environment's choice, the installed one, or that of this build.
std::string moduleFile() {
  if (const char* chosen = std::getenv("GNOMON_IMAGE_MODULE"); chosen != nullptr) return chosen;
  std::error_code failure;
  const fs::path installed = installPrefix() / GNOMON_MODULE_FOLDER / GNOMON_IMAGE_MODULE;
  return fs::is_regular_file(installed, failure) ? installed.string() : GNOMON_BUILT_IMAGE_MODULE;
}

const ImageModule& load() {
  // Never closed: OpenImageIO keeps threads, whose code must not go.
  void* const library = dlopen(moduleFile().c_str(), RTLD_LAZY | RTLD_LOCAL);
  const void* const module = library == nullptr ? nullptr : dlsym(library, imageModuleSymbol);
  if (module == nullptr) {
    throw InternalError(fmt::format(
        "no image can be read or written: the module for OpenImageIO cannot be loaded: {}",
        oneLine(dlerror())));
  }
  return *static_cast<const ImageModule*>(module);
}

}  // namespace

const ImageModule& imageModule() {
  static const ImageModule& module = load();
  return module;
}

}  // namespace gnomon
