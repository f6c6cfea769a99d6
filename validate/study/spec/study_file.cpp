#include "study/spec/study_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "render/shader_files.h"
#include "study/spec/method_changes.h"
#include "study/spec/sections/study_files.h"
#include "study/spec/study_sections.h"
#include "truth/visibility_tracer.h"

namespace gnomon::study {

namespace fs = std::filesystem;

StudyText readStudyText(const fs::path& file) {
  return {file, readFileOrStream(file)};
}

fs::path studyFolder(const fs::path& file) {
  return isGivenStream(file) ? fs::path() : file.parent_path();
}

namespace {

/// Makes a part that is not there yet.
template <typename Part, typename Make>
const Part& remembered(std::map<std::string, Part>& parts, const std::string& key,
                       const Make& make) {
  const auto found = parts.find(key);
  return found != parts.end() ? found->second : parts.emplace(key, make()).first->second;
}

/// The text of a table, by which its parts are looked up.
std::string keyOf(const TomlReader& section) {
  return tomlValueText(section.written());
}

/// A part that is called like another region would make its rows ambiguous.
void requireOwnNames(const TomlReader& section, const surface::Cage& cage) {
  std::set<std::string> names;
  for (const std::string& name : judgedRegions(cage.partNames)) {
    if (names.insert(name).second) continue;
    section.fail("mesh",
                 fmt::format("an object or group of the file is named \"{}\", as a region of "
                             "the truth is: rename it",
                             name));
  }
}

surface::Cage sharedCage(StudyParts& parts, const TomlReader& section,
                         const SurfaceSection& surface, const fs::path& folder, bool inSuite) {
  const std::string key = keyOf(section);
  if (parts.cage == nullptr || parts.surfaceKey != key) {
    parts.cage = std::make_shared<const surface::Cage>(cageOf(surface, section, folder, inSuite));
    requireOwnNames(section, *parts.cage);
    parts.surfaceKey = key;
    parts.limit.reset();
  }
  return *parts.cage;
}

const surface::LimitSurface& sharedLimit(StudyParts& parts) {
  if (!parts.limit) parts.limit = std::make_shared<const surface::LimitSurface>(*parts.cage);
  return *parts.limit;
}

bool isPolygons(const surface::Cage& cage) {
  return cage.scheme == surface::SubdivisionScheme::none;
}

void requireCurvature(const TomlReader& section, const surface::Cage& cage, const BaseSpec& base) {
  if (!isPolygons(cage) || base.curvature == surface::CurvatureSource::vertices) return;
  section.fail("curvature",
               "\"limit\" found, but with surface.scheme = \"none\" the polygons are no limit "
               "surface's cage: \"vertices\" expected, the curvature of the mesh itself");
}

relief::Relief sharedRelief(StudyParts& parts, const TomlReader& section,
                            const ReliefSection& relief, const fs::path& folder) {
  // A solid is sampled into the map of its surface.
  parts.reliefKey = parts.surfaceKey + keyOf(section);
  const auto limit = [&]() -> const surface::LimitSurface& { return sharedLimit(parts); };
  return remembered(parts.reliefs, parts.reliefKey,
                    [&] { return reliefOf(relief, section, folder, *parts.cage, limit); });
}

/// What no text tells: the map's border, and the radius by the rule.
/// @param parts  that the study was parsed with last
void prepare(StudySpec& study, StudyParts& parts) {
  relief::Relief& relief = study.relief;
  try {
    const relief::Border border =
        relief::borderOf(study.cage, sharedLimit(parts), relief.field.wrap(), relief.repeats);
    relief.field = std::move(relief.field).withBorder(border);
  } catch (const InputError& error) {
    throw InputError(study.file.string() + ": " + error.what());
  }
  double& own = study.bake.settings.radiusTexels;
  if (own > 0) {
    study.radius = {own, horizon::RadiusBound::stated};
  } else {
    std::vector<Vec3> lights;
    std::string key = parts.reliefKey;
    for (const Light& light : study.lights) {
      const Vec3& lowest = lights.emplace_back(truth::lowestOfDisc(light));
      key += fmt::format(" {} {} {}", lowest.x, lowest.y, lowest.z);
    }
    study.radius = remembered(parts.radii, key,
                              [&] { return horizon::searchRadius(*parts.limit, relief, lights); });
    own = study.radius.texels;
  }
  const auto take = [own](MethodSpec& method) {
    double& radius = method.bake.settings.radiusTexels;
    if (radius == 0) radius = own;
  };
  std::ranges::for_each(study.methods, take);
  for (LadderSpec& ladder : study.ladders) {
    std::ranges::for_each(ladder.forward, take);
    std::ranges::for_each(ladder.backward, take);
  }
}

/// Four times as long, but not over half a texel unless it was: there is a line through every
/// texel's centre, so that twice that would be the same mesh again.
double quickStep(double step) {
  return std::max(step, std::min(4 * step, 0.5));
}

void readTruth(const TomlReader& section, StudySpec& study) {
  readSection(section, keysOf(study.truth, study.relief.resample));
  if (section.has("triangles") && study.truth.stepTexels) {
    section.fail("triangles", "`step` found beside it, one of them expected");
  }
  if (study.truth.directions % 2 != 0) {
    section.fail("directions",
                 fmt::format("{} found, an even number expected", study.truth.directions));
  }
}

StudyNames namesIn(const StudySpec& study) {
  StudyNames names;
  for (const MethodSpec& method : study.methods) names.methods.push_back(method.label);
  for (const Light& light : study.lights) names.lights.push_back(light.name);
  for (const ViewSpec& view : study.views) names.views.push_back(view.name);
  names.regions = judgedRegions(study.cage.partNames);
  return names;
}

Gate readThreshold(const TomlReader& section, const StudySpec& study) {
  Gate threshold = newThreshold(section.line(), section.written());
  readSection(section, keysOf(threshold, namesIn(study)));
  readLimits(section, study, threshold);
  return threshold;
}

ClaimSpec readClaim(const TomlReader& section, const StudySpec& study) {
  ClaimSpec claim;
  const StudyKeys comparison = comparisonKeys(claim, namesIn(study));
  const StudyKeys bounds = boundKeys(claim, namesIn(study));
  KeyNames allowed = namesOf(keysOf(claim, namesIn(study)));
  for (const StudyKeys* keys : {&comparison, &bounds}) allowed.merge(namesOf(*keys));
  section.allow(allowed);
  section.requireOneOf("less", "method");
  readKeys(section, keysOf(claim, namesIn(study)));
  if (section.has("method")) {
    readKeys(section, bounds);
    if (!claim.above && !claim.below) section.fail("above", "`above` or `below` expected");
    if (claim.above && claim.below && !(*claim.above < *claim.below)) {
      section.fail("below", fmt::format("{} found, more than `above` = {} expected", *claim.below,
                                        *claim.above));
    }
  } else {
    readKeys(section, comparison);
  }
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

StudySpec readStudy(const fs::path& file, const StudyOptions& options) {
  return readStudy(StudyText{file, readFile(file)}, options);
}

StudySpec readStudy(const StudyText& text, const StudyOptions& options) {
  StudyParts parts;
  return readStudy(text, options, parts);
}

StudySpec readStudy(const StudyText& text, const StudyOptions& options, StudyParts& parts) {
  const fs::path& file = text.file;
  const fs::path folder = studyFolder(file);
  const toml::table table = studyTable(text, options);
  const TomlReader root(table, file.string(), "");
  root.allow(namesOf(studySections()));
  const TomlReader headerSection = root.table("study");
  StudyHeader header;
  readSection(headerSection, keysOf(header));
  requirePlainName(headerSection, header.name);
  header.quick |= options.quick;
  const TomlReader surface = root.table("surface");
  const TomlReader relief = root.table("relief");
  const SurfaceSection surfaceSection = readSurfaceSection(surface);
  ReliefSection reliefSection = readReliefSection(relief);
  const surface::Cage& cage =
      sharedCage(parts, surface, surfaceSection, folder, !header.suite.empty());
  if (!relief.has("wrap")) reliefSection.wrap = relief::defaultWrap(cage, reliefSection.repeats);
  StudySpec study{header, file, cage, sharedRelief(parts, relief, reliefSection, folder)};
  study.surfaceSection = surfaceSection;
  study.reliefSection = reliefSection;
  study.text = text.text;
  for (const TomlReader* section : {&surface, &relief}) section->finish();

  if (isPolygons(cage)) study.base.curvature = surface::CurvatureSource::vertices;
  if (const auto base = root.optionalTable("base")) {
    readSection(*base, keysOf(study.base));
    requireCurvature(*base, cage, study.base);
  }
  if (const auto truth = root.optionalTable("truth")) readTruth(*truth, study);
  if (study.quick) {
    study.frames = 0;
    if (study.truth.stepTexels) *study.truth.stepTexels = quickStep(*study.truth.stepTexels);
    study.truth.leastTriangles /= 16;
  }
  for (const TomlReader& view : root.tables("view")) {
    study.views.push_back(readView(view, study.quick));
  }
  for (const TomlReader& section : root.tables("light")) {
    for (Light& light : readLights(section)) study.lights.push_back(std::move(light));
  }
  study.bake.settings.radiusTexels = 0;
  if (const auto bake = root.optionalTable("bake")) {
    readSection(*bake, keysOf(study.bake, study.relief.resample));
  }
  const MethodDefaults defaults{folder,     render::shaderFolder(), study.bake,
                                study.base, study.relief.resample,  parts.methods};
  for (const TomlReader& method : root.tables("method")) {
    study.methods.push_back(readMethodSection(method, defaults));
    const auto base = method.optionalTable("base");
    requireCurvature(base ? *base : method, cage, study.methods.back().base);
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
  }
  study.ladders = readLadders(root, study, defaults);
  for (const LadderSpec& ladder : study.ladders) {
    for (const auto* states : {&ladder.forward, &ladder.backward}) {
      for (const MethodSpec& state : *states) requireCurvature(root, cage, state.base);
    }
  }
  (void)root.find("sweep");
  root.finish();
  reduce(study, options);
  if (!options.isOutline) prepare(study, parts);
  return study;
}

namespace {

CauseSpec readCause(const TomlReader& rung, const std::vector<CauseSpec>& before) {
  CauseSpec cause;
  rung.allow(namesOf(keysOf(cause)));
  readKeys(rung, keysOf(cause));
  const bool twice = std::any_of(before.begin(), before.end(),
                                 [&](const CauseSpec& other) { return other.name == cause.name; });
  if (twice)
    rung.fail("cause", fmt::format("\"{}\" found twice, distinct causes expected", cause.name));
  return cause;
}

/// The state after a rung.
MethodSpec climb(const TomlReader& rung, const MethodSpec& from, const MethodDefaults& defaults) {
  const TomlReader set = rung.table("set");
  MethodSpec changed = from;
  KeyNames names = namesOf(keysOf(changed));
  names.erase("label");
  names.erase("masks");
  set.allow(names);
  MethodSpec to = changedMethod(set, from, defaults);
  set.finish();
  if (isSameMethod(from, to)) rung.fail("set", "changes nothing, keys with other values expected");
  return to;
}

LadderSpec readLadder(const TomlReader& section, const StudySpec& study,
                      const MethodDefaults& defaults) {
  LadderSpec ladder;
  std::vector<std::string> labels;
  for (const MethodSpec& method : study.methods) labels.push_back(method.label);
  section.allow(namesOf(keysOf(ladder, labels)));
  readKeys(section, keysOf(ladder, labels));
  const auto method = std::find(labels.begin(), labels.end(), ladder.method) - labels.begin();
  ladder.written = section.written();
  if (study.methods[static_cast<std::size_t>(method)].isGiven()) {
    section.fail("method", fmt::format("\"{}\" is given as masks, a method with a shader expected",
                                       ladder.method));
  }
  const MethodSpec start =
      changedMethod(section, study.methods[static_cast<std::size_t>(method)], defaults);
  ladder.forward.push_back(start);
  ladder.backward.push_back(start);
  const std::vector<TomlReader> rungs = section.tables("rung");
  for (const TomlReader& rung : rungs) {
    ladder.causes.push_back(readCause(rung, ladder.causes));
    ladder.forward.push_back(climb(rung, ladder.forward.back(), defaults));
    rung.finish();
  }
  for (auto rung = rungs.rbegin(); rung != rungs.rend(); ++rung) {
    ladder.backward.push_back(climb(*rung, ladder.backward.back(), defaults));
  }
  section.finish();
  if (!isSameMethod(ladder.forward.back(), ladder.backward.back())) {
    section.fail(
        "rung",
        "rungs change the same keys, so that forward and backward end differently; keys of "
        "one rung each expected");
  }
  return ladder;
}

}  // namespace

std::vector<LadderSpec> readLadders(const TomlReader& root, const StudySpec& study,
                                    const MethodDefaults& defaults) {
  std::vector<LadderSpec> ladders;
  for (const TomlReader& section : root.optionalTables("ladder")) {
    LadderSpec ladder = readLadder(section, study, defaults);
    for (const LadderSpec& other : ladders) {
      if (other.method != ladder.method) continue;
      section.fail("method", fmt::format("\"{}\" has another ladder", ladder.method));
    }
    const bool atlas = std::any_of(study.views.begin(), study.views.end(), hasFixedSamples);
    if (!atlas) {
      section.fail("method", "no [[view]] of type atlas found, in which a ladder is measured");
    }
    ladders.push_back(std::move(ladder));
  }
  return ladders;
}

toml::table studyTable(const StudyText& study, const StudyOptions& options) {
  toml::table table = parseTomlText(study.text, study.file.string());
  if (toml::array* methods = table["method"].as_array()) {
    for (const std::string& name : options.addedMethods) {
      methods->push_back(toml::table{{"name", name}});
    }
  }
  applyOverrides(table, options.overrides);
  replaceMethods(table, study.file, options.replacements);
  return table;
}

toml::table studyTable(const std::filesystem::path& file, const StudyOptions& options) {
  return studyTable(StudyText{file, readFile(file)}, options);
}

}  // namespace gnomon::study
