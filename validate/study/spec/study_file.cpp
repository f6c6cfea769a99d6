#include "study/spec/study_file.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "relief/patch_border.h"
#include "render/method.h"
#include "study/record/result_metrics.h"
#include "study/spec/file_names.h"
#include "study/spec/ladder_section.h"
#include "study/spec/light_name.h"
#include "study/spec/method_section.h"
#include "study/spec/relief_section.h"
#include "study/spec/study_reduction.h"
#include "study/spec/study_table.h"
#include "study/spec/surface_section.h"
#include "study/spec/threshold_limits.h"
#include "study/spec/toml_reader.h"
#include "truth/seam_crossing.h"
#include "truth/shadow_tracer.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

constexpr int mostPixelsASide = 16384;

/// What is refused of the surface names the study.
LimitSurface surfaceOf(const StudySpec& study) {
  try {
    return LimitSurface(study.cage);
  } catch (const InputError& error) {
    throw InputError(study.file.string() + ": " + error.what());
  }
}

/// The map gets its border; the bake its radius, by the rule where none is stated.
void readStudyBake(const TomlReader& root, StudySpec& study) {
  const auto section = root.optionalTable("bake");
  const LimitSurface surface = surfaceOf(study);
  Relief& relief = study.relief;
  const Border border = borderOf(study.cage, surface, relief.field.wrap(), relief.repeats);
  relief.field = std::move(relief.field).withBorder(border);
  std::vector<Vec3> lights;
  for (const LightSpec& light : study.lights) lights.push_back(light.direction());
  const bool isStated = section && section->has("radius");
  study.radius =
      isStated ? SearchRadius{0, RadiusBound::stated} : searchRadius(surface, relief, lights);
  study.bake.settings.radiusTexels = study.radius.texels;
  if (section) study.bake = readBake(*section, study.bake, relief.resample);
  study.radius.texels = study.bake.settings.radiusTexels;
}

Camera readCamera(const TomlReader& section) {
  Camera camera;
  camera.eye = section.vec3("eye");
  camera.target = section.vec3("target", Vec3(0));
  camera.up = section.vec3("up", Vec3(0, 1, 0));
  camera.verticalFov = radians(section.number("fov", Range{0.1, 170}, 30));
  camera.width = section.integer("width", 1, mostPixelsASide);
  camera.height = section.integer("height", 1, mostPixelsASide);
  return camera;
}

ViewSpec readView(const TomlReader& section, bool quick) {
  section.allow({"type", "name", "eye", "target", "up", "fov", "width", "height", "samples"});
  const std::size_t kind = section.choice("type", {"camera", "atlas"});
  ViewSpec view;
  view.name = section.text("name", kind == 0 ? "camera" : "atlas");
  const auto reduced = [quick](int side) { return quick ? std::max(1, side / 4) : side; };
  if (kind == 0) {
    Camera camera = readCamera(section);
    camera.width = reduced(camera.width);
    camera.height = reduced(camera.height);
    view.kind = camera;
  } else {
    // An odd number keeps the samples off the micro-edges, as it does in the full form.
    const int samples = section.integer("samples", 1, 4096);
    view.kind = AtlasSpec{quick ? reduced(samples) | 1 : samples};
  }
  section.finish();
  return view;
}

/// A light, or a sweep: every elevation with every azimuth.
void readLights(const TomlReader& section, std::vector<LightSpec>& lights) {
  section.allow({"elevation", "azimuth", "name"});
  const auto elevations = section.numbers("elevation", Range{-90, 90});
  const auto azimuths = section.numbers("azimuth", Range{-360, 360}, 0);
  const bool single = elevations.size() * azimuths.size() == 1;
  if (section.has("name") && !single) section.fail("name", "a sweep of lights names itself");
  for (const double azimuth : azimuths) {
    for (const double elevation : elevations) {
      lights.push_back({section.text("name", lightName(azimuth, elevation)), radians(azimuth),
                        radians(elevation)});
    }
  }
  section.finish();
}

/// Four times as long, but not over half a texel unless it was: there is a line through every
/// texel's centre, so that twice that would be the same mesh again.
double quickStep(double step) {
  return std::max(step, std::min(4 * step, 0.5));
}

void readTruth(const TomlReader& section, StudySpec& study) {
  section.allow({"step", "uncertainty", "triangles"});
  study.truth.stepTexels = section.optionalNumber("step", positive);
  if (study.truth.stepTexels) *study.truth.stepTexels *= study.relief.resample;
  constexpr Range shares{0, 1, true};
  study.truthUncertainty = section.optionalNumber("uncertainty", shares);
  if (study.truth.stepTexels && study.truthUncertainty) {
    section.fail("uncertainty", "`step` found beside it, one of the two expected");
  }
  constexpr Range triangles{1, 1e9};
  if (section.has("triangles") && (study.truth.stepTexels || study.truthUncertainty)) {
    section.fail("triangles", "`step` or `uncertainty` found beside it, one of them expected");
  }
  study.truth.leastTriangles = section.number("triangles", triangles, study.truth.leastTriangles);
  section.finish();
}

std::string readMetric(const TomlReader& section) {
  std::string metric = section.text("metric", "error_rate");
  const auto& names = metricNames();
  if (std::find(names.begin(), names.end(), metric) == names.end()) {
    section.fail("metric",
                 fmt::format("\"{}\" found, one of {} expected", metric, fmt::join(names, ", ")));
  }
  return metric;
}

/// Refuses a name that no entry of the study bears; an empty one stands for all.
template <typename Entries, typename NameOf>
std::string readFilter(const TomlReader& section, const char* key, const Entries& entries,
                       const NameOf& nameOf, std::string_view fallback) {
  std::string asked = section.text(key, fallback);
  if (asked.empty()) return asked;
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const auto& entry : entries) names.emplace_back(nameOf(entry));
  if (std::find(names.begin(), names.end(), asked) == names.end()) {
    section.fail(key,
                 fmt::format("\"{}\" found, one of {} expected", asked, fmt::join(names, ", ")));
  }
  return asked;
}

std::vector<std::string> regionNames() {
  std::vector<std::string> names = {"all"};
  for (const Region region : reportedRegions) names.emplace_back(regionName(region));
  names.emplace_back(seamRegion);
  return names;
}

Answer readAnswer(const TomlReader& section) {
  const auto itself = [](const std::string& text) { return text; };
  std::vector<std::string> names;
  for (const Answer answer : allAnswers) names.emplace_back(answerName(answer));
  return *answerOfName(
      readFilter(section, "answer", names, itself, std::string(answerName(Answer::drawn))));
}

Gate readThreshold(const TomlReader& section, const StudySpec& study) {
  const auto label = [](const MethodSpec& method) { return method.label; };
  const auto name = [](const auto& entry) { return entry.name; };
  const auto itself = [](const std::string& text) { return text; };
  section.allow({"method", "light", "view", "region", "metric", "min", "max", "answer", "quick"});
  Gate threshold;
  threshold.method = readFilter(section, "method", study.methods, label, "");
  threshold.light = readFilter(section, "light", study.lights, name, "");
  threshold.view = readFilter(section, "view", study.views, name, "");
  threshold.region = readFilter(section, "region", regionNames(), itself, "all");
  threshold.metric = readMetric(section);
  readLimits(section, study, threshold);
  threshold.answer = readAnswer(section);
  threshold.origin = Threshold{section.line(), section.flag("quick", true), section.written()};
  section.finish();
  return threshold;
}

ClaimSpec readClaim(const TomlReader& section, const StudySpec& study) {
  const auto label = [](const MethodSpec& method) { return method.label; };
  const auto itself = [](const std::string& text) { return text; };
  section.allow({"text", "source", "less", "than", "gain_exceeds", "gain_grows", "method", "above",
                 "below", "metric", "region", "answer"});
  ClaimSpec claim;
  claim.text = section.text("text");
  claim.source = section.text("source");
  section.requireOneOf("less", "method");
  if (section.has("method")) {
    claim.method = readFilter(section, "method", study.methods, label, section.text("method"));
    claim.above = section.optionalNumber("above", anyNumber);
    claim.below = section.optionalNumber("below", anyNumber);
    if (!claim.above && !claim.below) section.fail("above", "`above` or `below` expected");
    if (claim.above && claim.below && !(*claim.above < *claim.below)) {
      section.fail("below", fmt::format("{} found, more than `above` = {} expected", *claim.below,
                                        *claim.above));
    }
  } else {
    claim.less = readFilter(section, "less", study.methods, label, section.text("less"));
    claim.than = readFilter(section, "than", study.methods, label, section.text("than"));
    claim.gainExceeds = section.text("gain_exceeds", "");
    claim.gainGrows = section.flag("gain_grows", false);
    if (claim.gainExceeds == study.name) {
      section.fail("gain_exceeds",
                   fmt::format("\"{}\" found, the name of another study expected", study.name));
    }
    if (claim.gainGrows && !claim.gainExceeds.empty()) {
      section.fail("gain_grows", "`gain_exceeds` found beside it, one of the two expected");
    }
  }
  claim.metric = readMetric(section);
  claim.region = readFilter(section, "region", regionNames(), itself, "all");
  claim.answer = readAnswer(section);
  claim.written = section.written();
  section.finish();
  return claim;
}

template <typename Entries, typename NameOf>
void requireDistinct(const Entries& entries, const NameOf& nameOf, const std::string& file,
                     const char* what) {
  std::set<std::string> seen;
  for (const auto& entry : entries) {
    if (!seen.insert(nameOf(entry)).second) {
      throw InputError(fmt::format("{}: {} \"{}\" appears twice, distinct names expected", file,
                                   what, nameOf(entry)));
    }
  }
}

/// Names become file names.
void requirePlainName(const TomlReader& section, const std::string& name) {
  if (name.front() == '.' || !std::all_of(name.begin(), name.end(), isNameCharacter)) {
    section.fail("name", fmt::format("\"{}\" found, letters, digits, - and _ expected", name));
  }
}

}  // namespace

Vec3 LightSpec::direction() const {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

StudySpec readStudy(const fs::path& file, const StudyOptions& options) {
  return readStudy(StudyText{file, readFile(file)}, options);
}

StudySpec readStudy(const StudyText& text, const StudyOptions& options) {
  const fs::path& file = text.file;
  const fs::path folder = studyFolder(file);
  const toml::table table = studyTable(text, options);
  const TomlReader root(table, file.string(), "");
  root.allow({"study", "surface", "relief", "bake", "base", "truth", "view", "light", "method",
              "threshold", "claim", "ladder", "sweep"});
  const TomlReader header = root.table("study");
  header.allow({"name", "title", "source", "ranked", "quick"});
  const TomlReader surface = root.table("surface");
  const TomlReader relief = root.table("relief");
  StudySpec study{file,
                  header.text("name"),
                  header.text("title"),
                  header.text("source"),
                  readSurfaceSection(surface, folder),
                  readReliefSection(relief, folder),
                  {},
                  1,
                  {},
                  {},
                  {},
                  {},
                  {},
                  {},
                  {},
                  {},
                  {}};
  study.ranked = header.flag("ranked", true);
  study.quick = header.flag("quick", false) || options.quick;
  study.surfaceSection = surface.given();
  study.reliefSection = relief.given();
  study.text = text.text;
  requirePlainName(header, study.name);
  for (const TomlReader* section : {&header, &surface, &relief}) section->finish();

  if (const auto base = root.optionalTable("base")) {
    readBase(*base, study.baseSubdivisions, study.baseCurvature);
  }
  if (const auto truth = root.optionalTable("truth")) {
    readTruth(*truth, study);
  }
  if (study.quick) {
    if (study.truth.stepTexels) *study.truth.stepTexels = quickStep(*study.truth.stepTexels);
    if (study.truthUncertainty) *study.truthUncertainty *= 4;  // it falls as the step does
    study.truth.leastTriangles /= 16;
  }
  for (const TomlReader& view : root.tables("view")) {
    study.views.push_back(readView(view, study.quick));
  }
  for (const TomlReader& light : root.tables("light")) readLights(light, study.lights);
  readStudyBake(root, study);
  const MethodDefaults defaults{folder,
                                shaderFolder(),
                                study.bake,
                                study.baseSubdivisions,
                                study.baseCurvature,
                                study.relief.resample};
  for (const TomlReader& method : root.tables("method")) {
    study.methods.push_back(readMethodSection(method, defaults));
  }
  const auto name = [](const auto& entry) { return entry.name; };
  requireDistinct(study.views, name, file.string(), "view");
  requireDistinct(study.lights, name, file.string(), "light");
  requireDistinct(
      study.methods, [](const MethodSpec& m) { return m.label; }, file.string(), "method label");
  for (const TomlReader& gate : root.optionalTables("threshold")) {
    study.thresholds.push_back(readThreshold(gate, study));
  }
  for (const TomlReader& claim : root.optionalTables("claim")) {
    study.claims.push_back(readClaim(claim, study));
    if (study.claims.back().gainGrows && !root.optionalTable("sweep")) {
      claim.fail("gain_grows", "no [sweep] found, over which a gain could grow");
    }
  }
  study.ladders = readLadders(root, study, defaults);
  (void)root.optionalTable("sweep");
  root.finish();
  reduce(study, options);
  return study;
}

}  // namespace gnomon
