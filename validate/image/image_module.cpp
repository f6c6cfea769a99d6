#include "image/image_module.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <cstdlib>

#include "common/error.h"
#include "common/system/own_files.h"
#include "common/text.h"

namespace gnomon::image {
namespace fs = std::filesystem;
namespace {

/// The module's file: the environment's choice, or what is installed or built with this code.
std::string moduleFile() {
  if (const char* chosen = std::getenv("GNOMON_IMAGE_MODULE"); chosen != nullptr) return chosen;
  const fs::path name = fs::path(GNOMON_MODULE_FOLDER) / GNOMON_IMAGE_MODULE;
  return installedFile(name).value_or(ownFolder() / name).string();
}

[[noreturn]] void refuse(const std::string& reason) {
  throw InternalError("no image can be read or written: the module for OpenImageIO " + reason);
}

const ImageModule& load() {
  const std::string file = moduleFile();
  // Never closed: OpenImageIO keeps threads, whose code must not go.
  void* const library = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  const void* const module = library == nullptr ? nullptr : dlsym(library, imageModuleSymbol);
  if (module == nullptr) refuse(fmt::format("cannot be loaded: {}", oneLine(dlerror())));
  const void* const version = dlsym(library, imageModuleVersionSymbol);
  const std::string found = version == nullptr ? "none" : static_cast<const char*>(version);
  if (found != GNOMON_IMAGE_MODULE_VERSION) {
    refuse(fmt::format("is of another build than this program: {}: version {} found, {} expected",
                       file, found, GNOMON_IMAGE_MODULE_VERSION));
  }
  return *static_cast<const ImageModule*>(module);
}

}  // namespace

const ImageModule& imageModule() {
  static const ImageModule& module = load();
  return module;
}

}  // namespace gnomon::image
