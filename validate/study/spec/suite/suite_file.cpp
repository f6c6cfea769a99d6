#include "study/spec/suite/suite_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "render/shader_files.h"
#include "study/spec/sections/view_section.h"

namespace gnomon::study {

namespace {

/// 2¹⁰ steps in geometric progression: the products of the ratio's square root, that one's square
/// root and so on, by the bits of the step.
std::vector<double> progression(double first, double last) {
  std::array<double, 10> roots{};
  double root = last / first;
  for (double& one : roots) one = root = std::sqrt(root);
  constexpr unsigned steps = 1U << roots.size();
  std::vector<double> values;
  for (unsigned k = 0; k < steps; ++k) {
    double value = first;
    for (std::size_t bit = 0; bit < roots.size(); ++bit) {
      if ((k >> (roots.size() - 1 - bit) & 1U) != 0) value *= roots.at(bit);
    }
    values.push_back(roundedNumber(value));
  }
  values.push_back(roundedNumber(last));
  return values;
}

/// In whole millionths, so that each value is the double nearest to its decimal.
std::vector<double> steps(const TomlReader& section) {
  constexpr double millionths = 1e6;
  constexpr double most = 1e9;
  const auto whole = [&](std::string_view key, NumberRange range) {
    const double value = section.number(key, range) * millionths;
    const double rounded = std::round(value);
    if (std::abs(value - rounded) > 1e-3) section.fail(key, "six decimals at most expected");
    return static_cast<std::int64_t>(rounded);
  };
  const std::int64_t from = whole("from", {-most, most});
  const std::int64_t to = whole("to", {-most, most});
  const std::int64_t step = whole("step", {0, most, true});
  constexpr std::int64_t mostSteps = 100000;
  if (step < 1 || to < from || (to - from) / step > mostSteps || (to - from) % step != 0) {
    section.fail("step", fmt::format("a whole number of steps from `from` to `to` expected, at "
                                     "most {}",
                                     mostSteps));
  }
  std::vector<double> values;
  for (std::int64_t value = from; value <= to; value += step) {
    values.push_back(static_cast<double>(value) / millionths);
  }
  return values;
}

std::vector<double> valuesOf(const TomlReader& form, NumberRange range) {
  if (form.has("log")) {
    form.allow({"log"});
    const std::vector<double> ends = form.list("log", positive, 2);
    if (!(ends[0] < ends[1])) form.fail("log", "two rising numbers expected");
    return progression(ends[0], ends[1]);
  }
  if (form.has("among")) {
    form.allow({"among"});
    return form.numbers("among", range);
  }
  form.allow({"from", "to", "step"});
  return steps(form);
}

}  // namespace

double roundedNumber(double value) {
  return std::strtod(fmt::format("{:.3e}", value).c_str(), nullptr) + 0.0;  // no -0
}

double Distribution::draw(RandomStream& random) const {
  return values_[random.below(values_.size())];
}

Distribution readDistribution(const TomlReader& section, std::string_view key, NumberRange range) {
  const toml::node* node = section.find(key);
  if (node == nullptr || !node->is_table()) return Distribution({section.number(key, range)});
  std::vector<double> values = valuesOf(section.table(key), range);
  const auto isOut = [&](double v) {
    return v < range.least || v > range.most || (range.openBelow && v == range.least);
  };
  if (std::any_of(values.begin(), values.end(), isOut)) {
    section.fail(key, expectedNumber(range) + " expected of every value");
  }
  return Distribution(std::move(values));
}

namespace {

/// Σ (-1)^k x^(2k + first) / (2k + first)! for |x| ≤ π/4.
double series(double x, int first) {
  double term = first == 0 ? 1 : x;
  double sum = 0;
  for (int n = first; n < 24; n += 2) {
    sum += term;
    term *= -x * x / ((n + 1.0) * (n + 2.0));
  }
  return sum;
}

}  // namespace

SineCosine sineCosine(double degrees) {
  const double quarters = std::floor(degrees / 90 + 0.5);
  const double x = (degrees - 90 * quarters) * (pi / 180);
  const double sine = series(x, 1);
  const double cosine = series(x, 0);
  switch (static_cast<int>(quarters - 4 * std::floor(quarters / 4))) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

Vec3 exactDirection(double elevation, double azimuth) {
  const SineCosine up = sineCosine(elevation);
  const SineCosine round = sineCosine(azimuth);
  return {up.cosine * round.cosine, up.cosine * round.sine, up.sine};
}

namespace {

constexpr NumberRange angle{-360, 360};

const std::vector<std::string> surfaceKinds = {"plane", "cylinder", "sphere",   "inside-sphere",
                                               "torus", "bezier",   "b-spline", "mesh"};
const std::vector<std::string> surfaceClasses = {"open", "torus", "body", "shared"};

bool isArc(SurfaceKind kind) {
  return kind == SurfaceKind::cylinder || kind == SurfaceKind::sphere ||
         kind == SurfaceKind::insideSphere;
}

bool isSpline(SurfaceKind kind) {
  return kind == SurfaceKind::bezier || kind == SurfaceKind::bSpline;
}

Vec3 pointAt(const TomlReader& section, std::string_view key) {
  const std::vector<double> numbers = section.list(key, anyNumber, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

SuiteSurface readSurface(const TomlReader& section) {
  SuiteSurface surface;
  const std::size_t kind = section.choice("kind", surfaceKinds);
  surface.kind = static_cast<SurfaceKind>(kind);
  surface.name = surfaceKinds.at(kind);
  surface.weight = section.integer("weight", 1, 1000000);
  if (isArc(surface.kind)) surface.turn = readDistribution(section, "turn", {1, 180});
  if (isSpline(surface.kind)) {
    surface.bend = readDistribution(section, "bend", {0, 2});
    surface.sway = readDistribution(section, "sway", {-0.25, 0.25});
  }
  if (surface.kind == SurfaceKind::mesh) {
    surface.file = section.text("file");
    surface.name = section.text("name");
    const std::vector<std::string> wraps = {"clamp", "repeat"};
    surface.wrap = wraps.at(section.choice("wrap", wraps));
    surface.target = pointAt(section, "target");
    surface.radius = section.number("radius", positive);
    surface.texel = section.number("texel", positive);
    surface.face = section.number("face", {0, 1, true});
    if (section.has("shared")) surface.shared = section.flag("shared");
  }
  section.finish();
  return surface;
}

std::map<std::string, Distribution> readKeys(const TomlReader& section, std::string_view key) {
  std::map<std::string, Distribution> distributions;
  if (const auto table = section.optionalTable(key)) {
    for (const auto& [name, node] : table->written()) {
      distributions.emplace(name.str(), readDistribution(*table, name.str()));
    }
  }
  return distributions;
}

SuiteRelief readRelief(const TomlReader& section) {
  SuiteRelief relief;
  section.requireOneOf({"pattern", "solid", "image"});
  for (const char* form : {"pattern", "solid", "image"}) {
    if (!section.has(form)) continue;
    relief.form = form;
    relief.name = section.text(form);
  }
  relief.weight = section.integer("weight", 1, 1000000);
  const toml::node* on = section.find("on");
  if (on == nullptr || !on->is_array() || on->as_array()->empty()) {
    section.fail("on", "a list of open, torus, body and shared expected");
  }
  for (const toml::node& one : *on->as_array()) {
    const auto found =
        std::find(surfaceClasses.begin(), surfaceClasses.end(), one.value_or<std::string>(""));
    if (found == surfaceClasses.end()) section.fail("on", "open, torus, body or shared expected");
    relief.on.push_back(static_cast<SurfaceClass>(found - surfaceClasses.begin()));
  }
  relief.height = readDistribution(section, "height", positive);
  const std::vector<double> shadow = section.list("shadow", positive, 2);
  relief.shadow = {shadow[0], shadow[1]};
  if (section.has("whole_periods")) relief.wholePeriods = section.flag("whole_periods");
  if (section.has("seeded")) relief.seeded = section.flag("seeded");
  relief.lengths = readKeys(section, "lengths");
  relief.shares = readKeys(section, "shares");
  if (relief.form == "image") {
    const std::vector<double> texels = section.list("texels", {1, 16384}, 2);
    relief.texels = {static_cast<int>(texels[0]), static_cast<int>(texels[1])};
    relief.feature = section.number("feature", positive);
  }
  section.finish();
  return relief;
}

/// Every surface must have a relief that may lie on it, and the reverse.
void requireMatches(const TomlReader& root, const SuiteSpec& suite) {
  for (const SuiteSurface& surface : suite.surfaces) {
    const auto fits = [&](const SuiteRelief& relief) {
      return std::count(relief.on.begin(), relief.on.end(), classOf(surface)) > 0;
    };
    if (std::none_of(suite.reliefs.begin(), suite.reliefs.end(), fits)) {
      root.fail("relief", "none found that lies on the surface " + surface.name);
    }
  }
}

/// Of a file that takes all from another, but its name and the size of its lights.
SuiteSpec readLike(const TomlReader& root, const TomlReader& header,
                   const std::filesystem::path& file) {
  const std::filesystem::path other = file.parent_path() / header.text("like");
  if (parseToml(other).at_path("suite.like")) {
    header.fail("like", other.string() + " found, a file with distributions of its own expected");
  }
  SuiteSpec suite = readSuite(other);
  suite.name = header.text("name");
  header.finish();
  const TomlReader light = root.table("light");
  suite.lightRadius = readDistribution(light, "radius", {0, largestLightRadius});
  light.finish();
  root.finish();
  return suite;
}

}  // namespace

SurfaceClass classOf(const SuiteSurface& surface) {
  if (surface.kind == SurfaceKind::torus) return SurfaceClass::torus;
  if (surface.kind != SurfaceKind::mesh) return SurfaceClass::open;
  return surface.shared ? SurfaceClass::shared : SurfaceClass::body;
}

SuiteSpec readSuite(const std::filesystem::path& file) {
  const toml::table table = parseToml(file);
  const TomlReader root(table, file.string(), "");
  const TomlReader header = root.table("suite");
  if (header.has("like")) return readLike(root, header, file);
  SuiteSpec suite;
  suite.file = file;
  suite.name = header.text("name");
  suite.tries = header.integer("tries", 1, 1000000);
  header.finish();
  for (const TomlReader& surface : root.tables("surface")) {
    suite.surfaces.push_back(readSurface(surface));
  }
  for (const TomlReader& relief : root.tables("relief")) {
    suite.reliefs.push_back(readRelief(relief));
  }
  requireMatches(root, suite);

  const TomlReader map = root.table("map");
  suite.side = readDistribution(map, "side", {16, 16384});
  suite.bodySide = readDistribution(map, "body_side", {16, 16384});
  suite.feature = readDistribution(map, "feature", positive);
  suite.bodyFeature = readDistribution(map, "body_feature", positive);
  suite.fewestFeatures = map.number("fewest_features", positive);
  suite.fewestTexels = map.number("fewest_texels", positive);
  map.finish();

  const TomlReader curvature = root.table("curvature");
  const std::vector<double> bounds = curvature.list("bounds", {0}, 2);
  suite.leastCurvature = bounds[0];
  suite.mostCurvature = bounds[1];
  curvature.finish();

  const TomlReader light = root.table("light");
  suite.lightElevation = readDistribution(light, "elevation", {1, 89});
  suite.lightAzimuth = readDistribution(light, "azimuth", angle);
  suite.bodyLightElevation = readDistribution(light, "body_elevation", {-90, 90});
  suite.aboveRim = light.number("above_rim", {0, 90});
  const std::vector<double> apart = light.list("from_camera", {0, 180}, 2);
  suite.leastFromCamera = apart[0];
  suite.mostFromCamera = apart[1];
  light.finish();

  const TomlReader view = root.table("view");
  suite.cameraWeight = view.integer("camera", 0, 1000);
  suite.atlasWeight = view.integer("atlas", 0, 1000);
  if (suite.cameraWeight + suite.atlasWeight == 0) view.fail("camera", "a weight above 0 expected");
  suite.cameraElevation = readDistribution(view, "elevation", {1, 89});
  suite.cameraAzimuth = readDistribution(view, "azimuth", angle);
  suite.bodyCameraElevation = readDistribution(view, "body_elevation", {-90, 90});
  suite.pixels = view.integer("pixels", 16, 16384);
  suite.atlasSamples = view.integer("atlas_samples", 1, 100000000);
  suite.fov = view.number("fov", {1, 120});
  suite.margin = view.number("margin", positive);
  view.finish();

  const TomlReader rules = root.table("rules");
  suite.texelsPerFace = rules.number("texels_per_face", positive);
  suite.radiansPerFace = rules.number("radians_per_face", {0, 0.1, true});
  suite.triangles = rules.number("triangles", {1, 1e9});
  suite.azimuths = rules.integer("azimuths", 1, 1024);
  suite.bits = rules.integer("bits", 8, 32);
  suite.frames = rules.integer("frames", 1, 10000);
  rules.finish();
  root.finish();
  return suite;
}

std::filesystem::path standardSuiteFile() {
  return render::shaderFolder().parent_path() / "scenes/suite/suite-1.toml";
}

}  // namespace gnomon::study
