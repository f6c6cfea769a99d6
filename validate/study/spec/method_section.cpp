#include "study/spec/method_section.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "common/error.h"
#include "render/method.h"
#include "study/spec/study_paths.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

constexpr std::array filters = {TableFilter::exact, TableFilter::hardware};

fs::path readMethodFile(const TomlReader& section, const MethodDefaults& defaults) {
  if (section.has("file")) return defaults.folder / pathOf(section.text("file"));
  const std::string name = section.text("name");
  return section.blame("name", [&] { return methodFile(defaults.shaders, name); });
}

/// A parameter's value, which the method must have and allow.
double checkedValue(const TomlReader& section, const Method& method, const std::string& name,
                    double value) {
  const auto found = method.parameters.find(name);
  if (found == method.parameters.end()) {
    std::vector<std::string> names;
    for (const auto& entry : method.parameters) names.push_back(entry.first);
    section.fail(name,
                 fmt::format("{} has no such parameter, one of {} expected", method.name,
                             names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }
  const MethodParameter& parameter = found->second;
  if (!(value >= parameter.minimum && value <= parameter.maximum)) {
    section.fail(name, fmt::format("{} found, {} to {} expected", value, parameter.minimum,
                                   parameter.maximum));
  }
  return value;
}

void readParameters(const TomlReader& section, const Method& declared, MethodSpec& method) {
  const auto parameters = section.optionalTable("parameters");
  if (!parameters) return;
  for (const auto& [name, value] : parameters->allNumbers()) {
    method.parameters[name] = checkedValue(*parameters, declared, name, value);
  }
}

}  // namespace

BakeSpec readBake(const TomlReader& section, BakeSpec bake, int resample) {
  section.allow({"azimuths", "radius", "bits", "limit"});
  constexpr std::array bits = {8, 16, 32};
  bake.settings.azimuths = section.integer("azimuths", 1, 1024, bake.settings.azimuths);
  if (const auto radius = section.optionalNumber("radius", Range{0, 1e5, true})) {
    bake.settings.radiusTexels = *radius * resample;
  }
  bake.angleLimit = radians(section.number("limit", Range{1, 180}, bake.angleLimit * 180 / pi));
  const int asked = section.integer("bits", 8, 32, static_cast<int>(bake.bits));
  if (std::find(bits.begin(), bits.end(), asked) == bits.end()) {
    section.fail("bits", fmt::format("{} found, 8, 16 or 32 expected", asked));
  }
  bake.bits = static_cast<TableBits>(asked);
  section.finish();
  return bake;
}

void readBase(const TomlReader& section, int& subdivisions, CurvatureSource& curvature) {
  section.allow({"subdivisions", "curvature"});
  constexpr std::array sources = {CurvatureSource::limit, CurvatureSource::vertices};
  subdivisions = section.integer("subdivisions", 1, 1024, subdivisions);
  curvature = sources.at(
      section.choice("curvature", {"limit", "vertices"}, static_cast<std::size_t>(curvature)));
  section.finish();
}

MethodSpec readMethodSection(const TomlReader& section, const MethodDefaults& defaults) {
  section.allow({"name", "file", "label", "filter", "bake", "base", "parameters"});
  section.requireOneOf("name", "file");
  MethodSpec method;
  method.file = readMethodFile(section, defaults);
  method.label = section.text("label", stemText(method.file));
  if (method.label == "truth") section.fail("label", "\"truth\" found, that name is taken");
  method.filter = filters.at(section.choice("filter", {"exact", "hardware"}, 0));
  const Method declared = readMethod(method.file);
  method.bake = defaults.bake;
  if (declared.azimuths) method.bake.settings.azimuths = *declared.azimuths;
  if (const auto bake = section.optionalTable("bake")) {
    method.bake = readBake(*bake, method.bake, defaults.resample);
  }
  method.baseSubdivisions = declared.subdivisions.value_or(defaults.baseSubdivisions);
  method.baseCurvature = defaults.baseCurvature;
  if (const auto base = section.optionalTable("base")) {
    readBase(*base, method.baseSubdivisions, method.baseCurvature);
  }
  readParameters(section, declared, method);
  section.finish();
  return method;
}

MethodSpec changedMethod(const TomlReader& section, MethodSpec method,
                         const MethodDefaults& defaults) {
  if (section.has("name") || section.has("file")) {
    section.requireOneOf("name", "file");
    method.file = readMethodFile(section, defaults);
    method.parameters.clear();
  }
  if (section.has("filter")) {
    method.filter = filters.at(section.choice("filter", {"exact", "hardware"}));
  }
  if (const auto bake = section.optionalTable("bake")) {
    method.bake = readBake(*bake, method.bake, defaults.resample);
  }
  if (const auto base = section.optionalTable("base")) {
    readBase(*base, method.baseSubdivisions, method.baseCurvature);
  }
  if (section.has("parameters")) readParameters(section, readMethod(method.file), method);
  return method;
}

bool isBuiltIn(const MethodSpec& method) {
  return method.file.parent_path() == shaderFolder() / "methods";
}

bool isSameMethod(const MethodSpec& a, const MethodSpec& b) {
  const auto parts = [](const MethodSpec& m) {
    return std::tie(m.file, m.bake.settings.azimuths, m.bake.settings.radiusTexels, m.bake.bits,
                    m.bake.angleLimit, m.baseSubdivisions, m.baseCurvature, m.filter, m.parameters);
  };
  return parts(a) == parts(b);
}

}  // namespace gnomon
