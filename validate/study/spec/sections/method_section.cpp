#include "study/spec/sections/method_section.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "common/error.h"
#include "study/spec/sections/study_files.h"
#include "study/spec/study_file.h"

namespace gnomon::study {
namespace fs = std::filesystem;
namespace {

fs::path readMethodFile(const TomlReader& section, const MethodDefaults& defaults) {
  if (section.has("file")) return namedFile(section, "file", defaults.folder);
  const std::string name = section.text("name");
  return section.blame("name", [&] { return render::methodFile(defaults.shaders, name); });
}

const render::Method& declaredIn(const fs::path& file, const MethodDefaults& defaults) {
  const auto known = defaults.declared.find(file);
  if (known != defaults.declared.end()) return known->second;
  return defaults.declared.emplace(file, render::readMethod(file)).first->second;
}

/// A parameter's value, which the method must have and allow.
double checkedValue(const TomlReader& section, const render::Method& method,
                    const std::string& name) {
  const bool isFlag = section.find(name)->is_boolean();
  const double value = isFlag ? (section.flag(name) ? 1 : 0) : section.number(name, anyNumber);
  const auto found = method.parameters.find(name);
  if (found == method.parameters.end()) {
    std::vector<std::string> names;
    for (const auto& entry : method.parameters) names.push_back(entry.first);
    section.fail(name,
                 fmt::format("{} has no such parameter, one of {} expected", method.name,
                             names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }
  const render::MethodParameter& parameter = found->second;
  const bool fits = !isFlag || parameter.kind == render::ParameterKind::flag;
  if (!fits || !parameter.allows(value)) {
    const std::string given = isFlag ? (value != 0 ? "true" : "false") : fmt::format("{}", value);
    section.fail(name, fmt::format("{} found, {} expected", given, parameter.rangeText()));
  }
  return value;
}

void readParameters(const TomlReader& section, const render::Method& declared, MethodSpec& method) {
  const TomlReader parameters = section.table("parameters");
  for (const auto& [key, node] : parameters.written()) {
    const std::string name(key.str());
    method.parameters[name] = checkedValue(parameters, declared, name);
  }
}

/// A method that another program drew: nothing of it can be set here.
MethodSpec readGivenMethod(const TomlReader& section, const MethodDefaults& defaults) {
  section.allow({"label", "masks"});
  MethodSpec method;
  method.masks = defaults.folder / fileOf(section.text("masks"));
  method.masksKey = section.placeOf("masks");
  method.bake = defaults.bake;
  method.base = defaults.base;
  method.label = section.has("label") ? section.text("label") : givenName(method.masks);
  return method;
}

MethodSpec readOwnMethod(const TomlReader& section, const MethodDefaults& defaults) {
  MethodSpec method;
  const render::Method& declared = declaredIn(readMethodFile(section, defaults), defaults);
  method.bake = defaults.bake;
  method.base = defaults.base;
  if (declared.azimuths) method.bake.settings.azimuths = *declared.azimuths;
  if (declared.subdivisions) method.base.subdivisions = *declared.subdivisions;
  method = changedMethod(section, std::move(method), defaults);
  if (method.label.empty()) {
    method.label = stemText(method.file) + (method.disc ? discLabel : "");
  }
  return method;
}

}  // namespace

render::Method declarationOf(const MethodSpec& method) {
  if (!method.isGiven()) return render::readMethod(method.file);
  render::Method declared;
  declared.name = givenName(method.masks);
  declared.title = "masks that another program drew";
  return declared;
}

std::string givenName(const fs::path& masks) {
  const fs::path plain = fs::absolute(masks).lexically_normal();
  return stemText(plain.has_filename() ? plain : plain.parent_path());
}

MethodSpec readMethodSection(const TomlReader& section, const MethodDefaults& defaults) {
  MethodSpec any;
  section.allow(namesOf(keysOf(any)));
  section.requireOneOf({"name", "file", "masks"});
  MethodSpec method =
      section.has("masks") ? readGivenMethod(section, defaults) : readOwnMethod(section, defaults);
  if (method.label == "truth") section.fail("label", "\"truth\" found, that name is taken");
  section.finish();
  return method;
}

MethodSpec changedMethod(const TomlReader& section, MethodSpec method,
                         const MethodDefaults& defaults) {
  if (section.has("name") || section.has("file")) {
    section.requireOneOf("name", "file");
    method.file = readMethodFile(section, defaults);
    method.parameters.clear();
    method.disc = false;
  }
  readKeys(section, keysOf(method));
  if (const auto bake = section.optionalTable("bake")) {
    readSection(*bake, keysOf(method.bake, defaults.resample));
  }
  if (const auto base = section.optionalTable("base")) readSection(*base, keysOf(method.base));
  if (section.has("parameters")) readParameters(section, declaredIn(method.file, defaults), method);
  if (method.disc && !declaredIn(method.file, defaults).hasHorizon) {
    section.fail("disc", fmt::format("{} defines no horizon, a method with `horizonSlope` expected",
                                     stemText(method.file)));
  }
  return method;
}

toml::table tableOf(const MethodSpec& method, const fs::path& folder, int resample) {
  if (method.isGiven()) {
    return toml::table{{"label", method.label},
                       {"masks", relativeFile(method.maskFolder(), folder)}};
  }
  toml::table table = settingsOf(method);
  if (isBuiltIn(method)) {
    table.insert("name", method.file.stem().string());
  } else {
    table.insert("file", relativeFile(method.file, folder));
  }
  table.insert("bake", settingsOf(method.bake, resample));
  table.insert("base", settingsOf(method.base));
  toml::table parameters;
  for (const auto& [name, parameter] : render::readMethod(method.file).parameters) {
    const auto chosen = method.parameters.find(name);
    const double value =
        chosen == method.parameters.end() ? parameter.defaultValue : chosen->second;
    switch (parameter.kind) {
      case render::ParameterKind::real:
        parameters.insert(name, value);
        break;
      case render::ParameterKind::whole:
        parameters.insert(name, static_cast<std::int64_t>(value));
        break;
      case render::ParameterKind::flag:
        parameters.insert(name, value != 0);
        break;
    }
  }
  table.insert("parameters", std::move(parameters));
  return table;
}

bool isBuiltIn(const MethodSpec& method) {
  return !method.isGiven() && method.file.parent_path() == render::shaderFolder() / "methods";
}

bool isSameMethod(const MethodSpec& a, const MethodSpec& b) {
  const auto keyOf = [](const MethodSpec& method) {
    cache::KeyBuilder key("method");
    key.add("file", method.file.native()).add("masks", method.maskFolder().native());
    addSettings(key, method, Enters::everything);
    addSettings(key, method.bake, Enters::everything, 1);
    addSettings(key, method.base, Enters::everything);
    for (const auto& [name, value] : method.parameters) key.add(name, value);
    return key.key();
  };
  return keyOf(a) == keyOf(b);
}

namespace {

std::string maskName(const fs::path& file) {
  constexpr std::string_view ending = "_truth";
  const std::string stem = file.stem().string();
  return stem.ends_with(ending) ? stem.substr(0, stem.size() - ending.size()) : stem;
}

/// What file managers leave in a folder of pictures, apart from hidden files, in either case.
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
