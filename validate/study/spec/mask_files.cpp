#include "study/spec/mask_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "common/error.h"
#include "study/spec/sections/study_paths.h"

namespace gnomon::study {
namespace fs = std::filesystem;
namespace {

std::string maskName(const fs::path& file) {
  constexpr std::string_view ending = "_truth";
  const std::string stem = file.stem().string();
  return stem.ends_with(ending) ? stem.substr(0, stem.size() - ending.size()) : stem;
}

/// What file managers leave in a folder of pictures, beside hidden files, in either case.
bool isOfFileManager(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return name.starts_with('.') || name == "thumbs.db" || name == "ehthumbs.db" ||
         name == "desktop.ini" || name == "icon\r";
}

}  // namespace

std::map<std::string, fs::path> masksIn(const fs::path& folder) {
  std::map<std::string, fs::path> masks;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    const fs::path& file = entry.path();
    if (!entry.is_regular_file() || isOfFileManager(file.filename().string())) continue;
    const auto [other, isNew] = masks.emplace(maskName(file), file);
    if (isNew) continue;
    const auto [first, second] = std::minmax(other->second, file);
    throw InputError(fmt::format("{}: {} found beside it, one mask of that name expected",
                                 first.string(), second.filename().string()));
  }
  if (failure) {
    throw InputError(
        fmt::format("{}: {}, a folder of masks expected", folder.string(), failure.message()));
  }
  return masks;
}

std::vector<GivenMaskFile> givenMaskFiles(const StudySpec& study, const MethodSpec& method) {
  std::vector<GivenMaskFile> masks;
  if (!method.isGiven()) return masks;
  const std::string key = method.masksKey.empty() ? "" : method.masksKey + ": ";
  std::map<std::string, fs::path> files;
  try {
    files = masksIn(method.maskFolder());
  } catch (const InputError& error) {
    throw InputError(key + error.what());
  }
  const CaseNames names = caseNames(study);
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    for (std::size_t l = 0; l < study.lights.size(); ++l) {
      const std::string name = fmt::format("{}_{}", names.views[v], names.lights[l]);
      const auto file = files.find(name);
      if (file == files.end()) {
        throw InputError(fmt::format(
            "{}{}: missing, the mask of method \"{}\" in view \"{}\" under light \"{}\" expected",
            key, (method.maskFolder() / (name + ".png")).string(), method.label,
            study.views[v].name, study.lights[l].name));
      }
      masks.push_back({v, l, file->second});
    }
  }
  return masks;
}

}  // namespace gnomon::study
