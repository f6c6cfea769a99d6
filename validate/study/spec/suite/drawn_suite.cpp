#include "study/spec/suite/drawn_suite.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "common/parallel.h"
#include "render/shader_files.h"
#include "study/spec/sections/method_section.h"
#include "study/spec/toml_reader.h"

namespace gnomon::study {

namespace {

const KeyNames methodKeys = {"name",   "file", "label", "disc",
                             "filter", "bake", "base",  "parameters"};

/// The first of some keys that a method has.
std::string textOf(const toml::table& method, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (const auto text = method[key].value<std::string>()) return *text;
  }
  return "";
}

/// What a method is, whatever its label.
std::string shaderOf(const toml::table& method) {
  return textOf(method, {"name", "file"});
}

bool isOfDisc(const toml::table& method) {
  return method["disc"].value_or(false);
}

toml::table labelled(toml::table method, const std::string& what) {
  const std::string label = fmt::format("{}, {}", labelOfMethod(method), what);
  method.insert_or_assign("label", label);
  return method;
}

/// @param of  index of the method
std::vector<VariedMethod> variedOf(const toml::table& method, std::size_t of,
                                   const TomlReader& vary) {
  std::vector<VariedMethod> varied;
  for (const auto& [key, values] : vary.written()) {
    const std::string name(key.str());
    const toml::array* list = values.as_array();
    if (list == nullptr || list->empty()) vary.fail(name, "a list of values expected");
    const std::string what = name.substr(name.find('.') + 1);
    for (const toml::node& value : *list) {
      const std::string text = tomlValueText(value);
      varied.push_back(
          {of, name, text,
           labelled(withSetting(method, name, value), fmt::format("{} {}", what, text))});
    }
  }
  return varied;
}

/// Of a whole number, if there is one.
void multiply(toml::node* number, std::int64_t factor) {
  toml::value<std::int64_t>* whole = number == nullptr ? nullptr : number->as_integer();
  if (whole != nullptr) *whole = whole->get() * factor;
}

}  // namespace

toml::table withSetting(toml::table method, const std::string& key, const toml::node& value) {
  const std::size_t dot = key.find('.');
  if (dot == std::string::npos) {
    method.insert_or_assign(key, value);
    return method;
  }
  const std::string section = key.substr(0, dot);
  method.insert(section, toml::table());
  method[section].as_table()->insert_or_assign(key.substr(dot + 1), value);
  return method;
}

const toml::node* settingOf(const toml::table& method, const std::string& key) {
  return method.at_path(key).node();
}

std::string labelOfMethod(const toml::table& method) {
  const std::string name = textOf(method, {"label", "name", "file"});
  return isOfDisc(method) && !method.contains("label") ? name + discLabel : name;
}

SuiteMethods readSuiteMethods(const std::filesystem::path& file,
                              const std::optional<std::filesystem::path>& settings) {
  SuiteMethods all;
  const toml::table table = parseToml(file);
  const TomlReader root(table, file.string(), "");
  root.allow({"method"});
  for (const TomlReader& section : root.tables("method")) {
    KeyNames names = methodKeys;
    names.merge(KeyNames{"vary", "camera"});
    section.allow(names);
    toml::table method = section.written();
    method.erase("vary");
    method.erase("camera");
    if (section.has("camera") && section.flag("camera")) all.ofCameras.insert(shaderOf(method));
    if (const auto vary = section.optionalTable("vary")) {
      for (VariedMethod& one : variedOf(method, all.methods.size(), *vary)) {
        all.varied.push_back(std::move(one));
      }
    }
    all.methods.push_back(std::move(method));
  }
  if (!settings) return all;
  const toml::table chosen = parseToml(*settings);
  const TomlReader chosenRoot(chosen, settings->string(), "");
  chosenRoot.allow({"method"});
  if (!chosenRoot.has("method")) return all;  // the authors' settings were the best
  for (const TomlReader& section : chosenRoot.tables("method")) {
    section.allow(methodKeys);
    all.chosen.push_back(labelled(section.written(), "chosen"));
  }
  return all;
}

std::filesystem::path standardMethodsFile() {
  return render::shaderFolder().parent_path() / "scenes/suite/methods.toml";
}

toml::array methodsOf(const SuiteMethods& methods, const DrawnScene& scene, SuiteSplit split) {
  const std::int64_t sceneSubdivisions = scene.study["base"]["subdivisions"].value_or(1);
  const bool isCamera = scene.facts["view"] == "camera";
  const bool isSoft = scene.facts.contains("radius");
  toml::array list;
  const auto add = [&](toml::table method) {
    if (!isCamera && methods.ofCameras.contains(shaderOf(method))) return;
    if (!isSoft && isOfDisc(method)) return;
    multiply(method["base"]["subdivisions"].node(), sceneSubdivisions);
    multiply(method["parameters"]["light_pieces"].node(), sceneSubdivisions);
    list.push_back(std::move(method));
  };
  for (const toml::table& method : methods.methods) add(method);
  if (split == SuiteSplit::train) {
    for (const VariedMethod& method : methods.varied) add(method.changed);
  } else {
    for (const toml::table& method : methods.chosen) add(method);
  }
  return list;
}

namespace fs = std::filesystem;
namespace {

SuiteStudy studyOf(const DrawnScene& scene, const SuiteMethods& methods, SuiteSplit split) {
  SuiteStudy study;
  study.file = scene.name + ".toml";
  study.facts = scene.facts;
  study.scene = fmt::format("# Drawn by `gnomon suite`: {}.\n\n",
                            scene.study["study"]["source"].value_or<std::string>("")) +
                suiteText(scene.study,
                          {"study", "surface", "relief", "bake", "base", "truth", "view", "light"});
  toml::table rest;
  rest.insert("method", methodsOf(methods, scene, split));
  study.text = fmt::format("{}\n{}\n{}", study.scene, methodsMark, suiteText(rest, {"method"}));
  return study;
}

/// The files that scenes read, and the terms of each folder of them.
std::vector<SuiteCopy> copiesOf(const SuiteSpec& suite, const std::vector<DrawnScene>& scenes) {
  std::set<std::string> names;
  for (const DrawnScene& scene : scenes) {
    for (const std::string& file : scene.files) {
      names.insert(file);
      names.insert((fs::path(file).parent_path() / "README.md").generic_string());
    }
  }
  std::vector<SuiteCopy> copies;
  const fs::path folder = suite.file.parent_path() / "..";
  for (const std::string& name : names) copies.push_back({name, readFile(folder / name)});
  return copies;
}

std::string hashLine(const std::string& bytes, const std::string& file) {
  return fmt::format("{}  {}\n", sha256(bytes), file);
}

}  // namespace

DrawnSuite drawSuite(const SuiteSpec& suite, const SuiteMethods& methods, SuiteSplit split,
                     const std::string& seed, int count) {
  std::vector<DrawnScene> scenes(static_cast<std::size_t>(count));
  parallelFor(0, scenes.size(), [&](std::size_t i) {
    scenes[i] = drawScene(suite, split, seed, static_cast<int>(i) + 1);
  });
  DrawnSuite drawn{suite.name, seed, split, {}, copiesOf(suite, scenes), ""};
  std::string lines;
  for (const DrawnScene& scene : scenes) {
    drawn.studies.push_back(studyOf(scene, methods, split));
    lines += hashLine(drawn.studies.back().scene, drawn.studies.back().file);
  }
  for (const SuiteCopy& copy : drawn.copies) lines += hashLine(copy.bytes, copy.file);
  drawn.sha256 = sha256(lines);
  return drawn;
}

void writeSuite(const DrawnSuite& suite, const std::string& manifest, const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) {
    throw InputError(fmt::format("{}: cannot be made: {}", folder.string(), failure.message()));
  }
  if (!fs::is_empty(folder, failure) || failure) {
    throw InputError(
        fmt::format("{}: files found, an empty folder or a new one expected", folder.string()));
  }
  for (const SuiteCopy& copy : suite.copies) {
    const fs::path file = folder / copy.file;
    fs::create_directories(file.parent_path(), failure);
    writeTextAtomically(file, copy.bytes);
  }
  for (const SuiteStudy& study : suite.studies) {
    writeTextAtomically(folder / study.file, study.text);
  }
  writeTextAtomically(folder / "manifest.json", manifest);
}

namespace {

std::string suiteString(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string suiteKey(std::string_view key) {
  const bool isBare = key.find_first_not_of(
                          "abcdefghijklmnopqrstuvwxyz"
                          "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string_view::npos &&
                      !key.empty();
  return isBare ? std::string(key) : suiteString(key);
}

/// A float keeps its point, so that it does not read back as an integer.
std::string suiteFloat(double value) {
  std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string suiteValue(const toml::node& node) {
  if (const auto* text = node.as_string()) return suiteString(text->get());
  if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = node.as_floating_point()) return suiteFloat(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  std::vector<std::string> entries;
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      entries.push_back(fmt::format("{} = {}", suiteKey(key.str()), suiteValue(value)));
    }
    return fmt::format("{{ {} }}", fmt::join(entries, ", "));
  }
  if (const auto* array = node.as_array()) {
    for (const toml::node& entry : *array) entries.push_back(suiteValue(entry));
    const bool isNested = !array->empty() && array->front().is_array();
    return isNested ? fmt::format("[\n  {},\n]", fmt::join(entries, ",\n  "))
                    : fmt::format("[{}]", fmt::join(entries, ", "));
  }
  throw InputError("a date or time found, which no key of a study is");
}

std::string suiteSection(const std::string& heading, const toml::table& section) {
  std::string text = heading + "\n";
  for (const auto& [key, value] : section) {
    text += fmt::format("{} = {}\n", suiteKey(key.str()), suiteValue(value));
  }
  return text;
}

}  // namespace

std::string suiteText(const toml::table& study, const std::vector<std::string_view>& order) {
  std::vector<std::string> sections;
  for (const std::string_view name : order) {
    const toml::node* node = study.get(name);
    if (node == nullptr) continue;
    if (const auto* table = node->as_table()) {
      sections.push_back(suiteSection(fmt::format("[{}]", name), *table));
      continue;
    }
    for (const toml::node& entry : *node->as_array()) {
      sections.push_back(suiteSection(fmt::format("[[{}]]", name), *entry.as_table()));
    }
  }
  return fmt::format("{}", fmt::join(sections, "\n"));
}

}  // namespace gnomon::study
