#include "study/spec/suite/drawn_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/files/input_file.h"
#include "study/spec/suite/drawn_surface.h"

namespace gnomon::study {
namespace {

RandomStream streamOf(const std::string& name) {
  const std::string hash = sha256(name);
  RandomStream::State state{};
  for (std::size_t word = 0; word < state.size(); ++word) {
    state.at(word) = std::strtoull(hash.substr(16 * word, 16).c_str(), nullptr, 16);
  }
  return RandomStream(state);
}

/// One of a list by the entries' weights.
template <typename Entry>
const Entry& drawWeighted(const std::vector<const Entry*>& entries, RandomStream& random) {
  std::uint64_t sum = 0;
  for (const Entry* entry : entries) sum += static_cast<std::uint64_t>(entry->weight);
  std::uint64_t draw = random.below(sum);
  for (const Entry* entry : entries) {
    const auto weight = static_cast<std::uint64_t>(entry->weight);
    if (draw < weight) return *entry;
    draw -= weight;
  }
  throw InternalError("a draw beyond the weights");
}

const SuiteSurface& drawSurfaceFamily(const SuiteSpec& suite, RandomStream& random) {
  std::vector<const SuiteSurface*> all;
  for (const SuiteSurface& surface : suite.surfaces) all.push_back(&surface);
  return drawWeighted(all, random);
}

const SuiteRelief& drawReliefFamily(const SuiteSpec& suite, const SuiteSurface& surface,
                                    RandomStream& random) {
  std::vector<const SuiteRelief*> fitting;
  for (const SuiteRelief& relief : suite.reliefs) {
    const auto& on = relief.on;
    if (std::find(on.begin(), on.end(), classOf(surface)) != on.end()) fitting.push_back(&relief);
  }
  return drawWeighted(fitting, random);
}

toml::array arrayOf(const Vec3& p) {
  return toml::array(p.x, p.y, p.z);
}

Vec3 roundedPoint(const Vec3& p) {
  return {roundedNumber(p.x), roundedNumber(p.y), roundedNumber(p.z)};
}

/// What both kinds of view and all lights of a scene are drawn for.
struct Families {
  const SuiteSurface& surface;
  const SuiteRelief& relief;
  bool isCamera;

  [[nodiscard]] bool isOpen() const { return classOf(surface) == SurfaceClass::open; }
  [[nodiscard]] bool isBody() const { return surface.kind == SurfaceKind::mesh; }
};

/// The map, in texels and in the surface's world units.
struct DrawnMap {
  glm::ivec2 texels{0};
  double feature = 0;  ///< world units
  double period =
      0;  ///< the feature in the unit of the relief's lengths: texels, of a solid the world's
  double share = 0;   ///< height over feature
  double height = 0;  ///< world units
};

std::optional<DrawnMap> drawMap(const SuiteSpec& suite, const Families& families,
                                RandomStream& random) {
  const auto& [surface, relief, isCamera] = families;
  DrawnMap map;
  if (relief.texels) {
    map.texels = *relief.texels;
    map.feature = *relief.feature;
  } else if (families.isBody()) {
    map.texels = glm::ivec2(static_cast<int>(suite.bodySide.draw(random)));
    map.feature = roundedNumber(suite.bodyFeature.draw(random) * surface.radius);
    const double texel = surface.texel * 1000 / map.texels.x;
    if (map.feature < suite.fewestTexels * texel) return std::nullopt;
    if (relief.form != "solid") map.period = map.feature / texel;
  } else {
    map.texels.x = static_cast<int>(suite.side.draw(random));
    map.texels.y = static_cast<int>(suite.side.draw(random));
    map.feature = suite.feature.draw(random);
    const int shorter = std::min(map.texels.x, map.texels.y);
    if (shorter < suite.fewestFeatures * map.feature) return std::nullopt;
    const bool mustFit = surface.kind == SurfaceKind::torus && relief.wholePeriods;
    const auto fits = [&](int side) { return std::fmod(side, map.feature) == 0; };
    if (mustFit && !(fits(map.texels.x) && fits(map.texels.y))) return std::nullopt;
  }
  if (map.period == 0) map.period = map.feature;
  map.share = relief.height.draw(random);
  map.height = roundedNumber(map.share * map.feature);
  return map;
}

toml::table reliefSection(const Families& families, const DrawnMap& map, RandomStream& random) {
  const SuiteRelief& relief = families.relief;
  toml::table section;
  section.insert(relief.form, relief.name);
  if (relief.form != "image") section.insert("texels", toml::array(map.texels.x, map.texels.y));
  section.insert("height", map.height);
  section.insert("height_space", families.isBody() ? "world" : "texture");
  section.insert("wrap", families.isBody()        ? families.surface.wrap
                         : relief.form == "image" ? "clamp"
                                                  : "repeat");
  for (const auto& [key, lengths] : relief.lengths) {
    section.insert(key, roundedNumber(lengths.draw(random) * map.period));
  }
  for (const auto& [key, shares] : relief.shares) {
    const double value = shares.draw(random);
    // Whole numbers stay whole: `octaves` takes no other.
    if (value == std::floor(value)) {
      section.insert(key, static_cast<std::int64_t>(value));
    } else {
      section.insert(key, value);
    }
  }
  constexpr std::uint64_t seeds = 1000000;
  if (relief.seeded) section.insert("seed", static_cast<std::int64_t>(random.below(seeds)));
  return section;
}

/// Degrees over the xy plane and from +x.
struct Heading {
  double elevation = 0, azimuth = 0;
  [[nodiscard]] Vec3 direction() const { return exactDirection(elevation, azimuth); }
};

/// Whether the light is one that the suite takes.
bool isFit(const SuiteSpec& suite, const Families& families, const DrawnMap& map,
           const DrawnSurface& surface, const Heading& light, const Heading& camera) {
  if (!families.isOpen()) {
    const double cosine = glm::dot(light.direction(), camera.direction());
    return cosine <= sineCosine(suite.leastFromCamera).cosine &&
           cosine >= sineCosine(suite.mostFromCamera).cosine;
  }
  const SineCosine height = sineCosine(light.elevation);
  const double shadow = map.share * height.cosine / height.sine;
  const Vec2 bounds = families.relief.shadow;
  const bool isAbove = surface.rim == 0 || light.elevation >= surface.rim + suite.aboveRim;
  return shadow >= bounds.x && shadow <= bounds.y && isAbove;
}

toml::table cameraSection(const SuiteSpec& suite, const Families& families,
                          const DrawnSurface& surface, const Heading& heading) {
  const SineCosine half = sineCosine(suite.fov / 2);
  const double distance = suite.margin * surface.radius * half.cosine / half.sine;
  toml::table view;
  view.insert("type", "camera");
  view.insert("eye", arrayOf(roundedPoint(surface.target + distance * heading.direction())));
  view.insert("target", arrayOf(surface.target));
  view.insert("up", families.isOpen() ? toml::array(0, 0, 1) : toml::array(0, 1, 0));
  view.insert("fov", suite.fov);
  view.insert("width", suite.pixels);
  view.insert("height", suite.pixels);
  return view;
}

/// An odd number a side: it keeps samples off the lines of the truth's mesh.
toml::table atlasSection(const SuiteSpec& suite, const DrawnSurface& surface) {
  int side = 1;
  while ((side + 2) * (side + 2) * static_cast<double>(surface.faces) <= suite.atlasSamples) {
    side += 2;
  }
  toml::table view;
  view.insert("type", "atlas");
  view.insert("samples", side);
  return view;
}

toml::table rules(const SuiteSpec& suite, DrawnScene& scene, const DrawnSurface& surface) {
  toml::table bake;
  bake.insert("azimuths", suite.azimuths);
  bake.insert("bits", suite.bits);
  scene.study.insert("bake", bake);
  toml::table base;
  base.insert("subdivisions", surface.subdivisions);
  scene.study.insert("base", base);
  toml::table truth;
  truth.insert("triangles", suite.triangles);
  return truth;
}

/// All but the families; false where a limit is broken.
bool drawRest(const SuiteSpec& suite, const Families& families, RandomStream& random,
              DrawnScene& scene) {
  const std::optional<DrawnMap> map = drawMap(suite, families, random);
  if (!map) return false;
  const std::optional<DrawnSurface> surface =
      drawSurface(suite, families.surface, {map->texels, map->height}, random);
  if (!surface) return false;
  const bool isOpen = families.isOpen();
  Heading light;
  light.elevation = (isOpen ? suite.lightElevation : suite.bodyLightElevation).draw(random);
  light.azimuth = suite.lightAzimuth.draw(random);
  Heading camera;
  camera.elevation = (isOpen ? suite.cameraElevation : suite.bodyCameraElevation).draw(random);
  camera.azimuth = suite.cameraAzimuth.draw(random);
  if (!isFit(suite, families, *map, *surface, light, camera)) return false;
  // A camera that looks along its own upward direction has no picture.
  constexpr double steepest = 0.9;
  if (!isOpen && std::abs(camera.direction().y) > steepest) return false;

  toml::table truth = rules(suite, scene, *surface);
  scene.study.insert("truth", std::move(truth));
  scene.study.insert("surface", surface->section);
  scene.study.insert("relief", reliefSection(families, *map, random));
  toml::array views;
  views.push_back(families.isCamera ? cameraSection(suite, families, *surface, camera)
                                    : atlasSection(suite, *surface));
  scene.study.insert("view", std::move(views));
  toml::table lightSection;
  lightSection.insert("elevation", light.elevation);
  lightSection.insert("azimuth", light.azimuth);
  if (suite.lightRadius) lightSection.insert("radius", suite.lightRadius->draw(random));
  toml::array lights;
  const std::optional<double> radius = lightSection["radius"].value<double>();
  lights.push_back(std::move(lightSection));
  scene.study.insert("light", std::move(lights));

  toml::table& facts = scene.facts;
  facts.insert("surface", families.surface.name);
  facts.insert("relief", (families.relief.form == "solid" ? "solid " : "") + families.relief.name);
  facts.insert("view", families.isCamera ? "camera" : "atlas");
  facts.insert("texels", toml::array(map->texels.x, map->texels.y));
  facts.insert("feature", map->feature);
  facts.insert("height_over_feature", map->share);
  facts.insert("height", map->height);
  if (!families.isBody()) facts.insert("kappa_height", roundedNumber(surface->curvature));
  facts.insert("elevation", light.elevation);
  facts.insert("azimuth", light.azimuth);
  if (radius) facts.insert("radius", *radius);
  return true;
}

std::string article(const std::string& noun) {
  return std::string("aeiou").find(noun.front()) != std::string::npos ? "an " + noun : "a " + noun;
}

}  // namespace

std::string splitName(SuiteSplit split) {
  return split == SuiteSplit::train ? "train" : "test";
}

DrawnScene drawScene(const SuiteSpec& suite, SuiteSplit split, const std::string& seed,
                     int number) {
  const std::string part = splitName(split);
  RandomStream random = streamOf(fmt::format("{}\n{}\n{}\n{}\n", suite.name, part, seed, number));
  const SuiteSurface& surface = drawSurfaceFamily(suite, random);
  const SuiteRelief& relief = drawReliefFamily(suite, surface, random);
  const auto views = static_cast<std::uint64_t>(suite.cameraWeight + suite.atlasWeight);
  const bool isCamera = random.below(views) < static_cast<std::uint64_t>(suite.cameraWeight);
  for (int tries = 1; tries <= suite.tries; ++tries) {
    DrawnScene scene;
    scene.name = fmt::format("{}-{}-{:04}", suite.name, part, number);
    scene.tries = tries;
    if (!drawRest(suite, {surface, relief, isCamera}, random, scene)) continue;
    toml::table header;
    header.insert("name", scene.name);
    const std::string what = (relief.form == "solid"   ? "solid "
                              : relief.form == "image" ? "terrain "
                                                       : "") +
                             (relief.form == "image" ? "" : relief.name);
    header.insert("title", fmt::format("{}on {}", relief.form == "image" ? what : what + " ",
                                       article(surface.name)));
    header.insert("source", fmt::format("{}, {}, scene {}", suite.name, part, number));
    // A population of its own: statistics never mix training and test scenes.
    header.insert("suite", fmt::format("{}-{}", suite.name, part));
    header.insert("frames", suite.frames);
    scene.study.insert("study", header);
    if (!surface.file.empty()) scene.files.push_back(surface.file);
    if (relief.form == "image") scene.files.push_back(relief.name);
    return scene;
  }
  throw InputError(fmt::format("{}: no scene of {} on {} keeps the limits in {} tries",
                               suite.file.string(), relief.name, surface.name, suite.tries));
}

}  // namespace gnomon::study
