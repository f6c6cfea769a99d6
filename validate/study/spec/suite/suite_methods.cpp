#include "study/spec/suite/suite_methods.h"

#include <fmt/core.h>

#include "render/shader_files.h"
#include "study/spec/sections/method_section.h"
#include "study/spec/toml/toml_text.h"

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

}  // namespace gnomon::study
