#include "render/check/pass_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "common/error.h"
#include "common/mask.h"
#include "horizon/angle_table.h"
#include "render/check/known_scene.h"
#include "render/passes/drawing.h"

namespace gnomon::render {
namespace {

using check::KnownPoint;
using Shaders = std::filesystem::path;

/// Counts pixels that are as they must be, and others.
class Tally {
 public:
  void add(bool isRight) {
    ++all_;
    wrong_ += isRight ? 0 : 1;
  }
  [[nodiscard]] std::string fault() const {
    if (all_ == 0) throw InternalError("the check of a pass has looked at nothing");
    return wrong_ == 0 ? "" : fmt::format("{} of {} pixels are wrong", wrong_, all_);
  }

 private:
  std::size_t all_ = 0;
  std::size_t wrong_ = 0;
};

// ---- Samples and pictures ----

/// Compares the places that a view's samples show.
void addSamples(Tally& tally, const Shaders& shaders, const check::KnownView& known,
                double nearEnough) {
  const surface::SampleGrid grid =
      SamplesPass(shaders).render(known.view, check::KnownScene().drawing().mesh);
  for (std::size_t i = 0; i < known.points.size(); ++i) {
    const KnownPoint& point = known.points[i];
    if (!point.isClear) continue;
    const surface::SurfaceSample& found = grid.samples.at(i);
    const Vec2 off = Vec2(found.s, found.t) - point.st;
    tally.add(found.face == point.face &&
              (found.face < 0 || std::max(std::abs(off.x), std::abs(off.y)) < nearEnough));
  }
}

std::string cameraFault(const Shaders& shaders) {
  Tally tally;
  for (const check::KnownView& known : check::cameraViews()) {
    addSamples(tally, shaders, known, 1e-3);
  }
  return tally.fault();
}

std::string atlasFault(const Shaders& shaders) {
  Tally tally;
  addSamples(tally, shaders, check::atlasView(), 1e-6);
  return tally.fault();
}

std::string pictureFault(const Shaders& shaders) {
  const auto& [view, points] = check::cameraViews().front();
  Mask mask{view.width, view.height, {}};
  for (int i = 0; i < view.width * view.height; ++i) {
    const bool isDark = (i % view.width / 4 + i / view.width / 4) % 2 == 0;
    mask.samples.push_back(isDark ? Shade::shadowed : Shade::lit);
  }
  const check::KnownScene scene;
  const auto picture = ShadePass(shaders, relief::Wrap::repeat, DrawnMesh::displaced)
                           .render(view, scene.drawing(), mask);
  // As shade.frag has it: ambient light alone, and with it a cosine of at least 0.02.
  const auto red = [](double cosine) {
    return 255 * std::pow(0.86 * (0.16 + 0.84 * cosine), 1 / 2.2);
  };
  constexpr double white = 255;
  Tally tally;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].isClear) continue;
    const double cosine = mask.samples[i] == Shade::lit ? std::max(points[i].facing, 0.02) : 0;
    const double expected = points[i].face < 0 ? white : red(cosine);
    tally.add(std::abs(picture.at(3 * i) - expected) < 1.5);
  }
  return tally.fault();
}

// ---- Methods ----

/// @param glsl  defines `isShadowed` or `visibility`, and the functions of its passes
Method methodOf(DrawnMesh mesh, const std::string& glsl) {
  Method method;
  method.name = "check";
  method.mesh = mesh;
  method.source = {"the check of a pass", glsl};
  method.code = {method.source};
  return method;
}

/// What a method's test must say at a point; none where it is not compared.
using Expected = std::function<std::optional<bool>(const KnownPoint&)>;

/// Compares both answers, of the test and of the picture. Methods on the base mesh draw the atlas,
/// with tables in 8, 16 and 32 bits, and are shaded by bumped normals; those on displaced geometry
/// draw what some cameras see.
std::string methodFault(const Shaders& shaders, const Method& method, const Expected& expected,
                        TableFilter filter = TableFilter::exact, std::size_t cameras = 2) {
  const MethodPass pass(shaders, method, relief::Wrap::repeat, filter, {});
  std::optional<BakePass> bakes;
  if (!method.bakes.empty())
    bakes.emplace(shaders, method, relief::Wrap::repeat, filter, std::map<std::string, double>());
  Tally tally;
  const auto addView = [&](const check::KnownScene& scene, const check::KnownView& known) {
    GpuTables tables = scene.tables();
    std::vector<GpuBake> own;
    if (bakes) {
      own = gpuBakes(method, bakes->bake(scene.bakeScene(), tables), scene.bakeScene());
      tables.bakes = &own;
    }
    const MethodAnswers answers = pass.render(known.view, scene.drawing(), tables);
    const bool isBase = method.mesh == DrawnMesh::base;
    for (std::size_t i = 0; i < known.points.size(); ++i) {
      const KnownPoint& point = known.points[i];
      if (!point.isClear) continue;
      const auto shade = [&](bool isDark) {
        return point.face < 0 ? Shade::none : isDark ? Shade::shadowed : Shade::lit;
      };
      const std::optional<bool> isHidden = expected(point);
      const double cosine = isBase ? point.bumped : point.facing;
      const bool isDark = isHidden.value_or(false) || !(cosine > 0);
      tally.add((!isHidden || answers.test.samples.at(i) == shade(*isHidden)) &&
                (std::abs(cosine) < 1e-3 || answers.drawn.samples.at(i) == shade(isDark)));
    }
  };
  using horizon::TableBits;
  if (method.mesh == DrawnMesh::base) {
    for (const TableBits bits : {TableBits::eight, TableBits::sixteen, TableBits::thirtyTwo}) {
      addView(check::KnownScene(bits), check::atlasView());
    }
  } else {
    const check::KnownScene scene;
    for (std::size_t i = 0; i < cameras; ++i) addView(scene, check::cameraViews().at(i));
  }
  return tally.fault();
}

bool heightBit(const KnownPoint& point) {
  return check::bitOf(check::knownMaps().heights, 0, point.texel);
}

// ---- Tables ----

/// Both sides mix bits by the same rule; the result depends on every bit and on their order.
std::uint32_t mixed(std::uint32_t hash, bool bit) {
  hash = (hash + (bit ? 1U : 2U)) * 2654435761U;
  return hash ^ hash >> 15;
}

/// The layer that is read at a texel.
int layerAt(glm::ivec2 texel) {
  return (texel.x + texel.y) % check::azimuths;
}

/// A method that mixes what it reads of tables, one map further, where they repeat.
/// @param hash  GLSL: mixes into `hash`, at `at`, from layer `k`
Method probeOf(const MethodTables& tables, const std::string& hash) {
  Method method = methodOf(DrawnMesh::base,
                           fmt::format("uint mixed(uint hash, bool bit) {{\n"
                                       "  hash = (hash + (bit ? 1u : 2u)) * 2654435761u;\n"
                                       "  return hash ^ hash >> 15;\n"
                                       "}}\n"
                                       "bool isShadowed(Pixel pixel, LocalLight light) {{\n"
                                       "  vec2 at = pixel.texel + vec2({}.0, -{}.0);\n"
                                       "  int k = (int(pixel.texel.x) + int(pixel.texel.y)) % {};\n"
                                       "  uint hash = 0u;\n"
                                       "{}"
                                       "  return (hash & 1u) != 0u;\n"
                                       "}}\n",
                                       check::mapSize.x, check::mapSize.y, check::azimuths, hash));
  method.tables = tables;
  return method;
}

template <TableFilter filter>
std::string tableFault(const Shaders& shaders) {
  MethodTables tables;
  tables.height = tables.horizon = tables.distance = true;
  const Method method =
      probeOf(tables,
              "  hash = mixed(hash, heightAt(at) > 0.5);\n"
              "  hash = mixed(hash, horizonAt(at, 0.5 * pi * float(k)) > 0.5);\n"
              "  hash = mixed(hash, distanceAt(at, 0.5 * pi * float(k)) > 0.5);\n");
  const auto expected = [](const KnownPoint& point) {
    const check::KnownMaps& maps = check::knownMaps();
    const int k = layerAt(point.texel);
    std::uint32_t hash = mixed(0, heightBit(point));
    hash = mixed(hash, check::bitOf(maps.horizon, k, point.texel));
    return (mixed(hash, check::bitOf(maps.distance, k, point.texel)) & 1U) != 0;
  };
  return methodFault(shaders, method, expected, filter);
}

std::string ellipseFault(const Shaders& shaders) {
  MethodTables tables;
  tables.ellipse = true;
  const Method method = probeOf(tables,
                                "  Ellipse ellipse = ellipseAt(at);\n"
                                "  hash = mixed(hash, ellipse.centre.x > 0.5);\n"
                                "  hash = mixed(hash, ellipse.centre.y > 0.5);\n"
                                "  hash = mixed(hash, ellipse.spread[0][0] > 0.5);\n"
                                "  hash = mixed(hash, ellipse.spread[0][1] > 0.5);\n"
                                "  hash = mixed(hash, ellipse.spread[1][1] > 0.5);\n");
  return methodFault(shaders, method, [](const KnownPoint& point) {
    std::uint32_t hash = 0;
    for (int layer = 0; layer < horizon::EllipseTable::numbers; ++layer) {
      hash = mixed(hash, check::bitOf(check::knownMaps().ellipse, layer, point.texel));
    }
    return (hash & 1U) != 0;
  });
}

/// The two lookup maps of angles are smooth: some of their values are known.
std::string angleFault(const Shaders& shaders) {
  MethodTables tables;
  tables.angles = true;
  const Method method =
      probeOf(tables,
              "  int map = k / 2;\n"
              "  vec4 four = anglesOfTexel(ivec2(floor(at)), map);\n"
              "  for (int i = 0; i < 4; ++i) hash = mixed(hash, four[i] > 0.5);\n"
              "  hash = mixed(hash, basisOf(vec2(0.0, 1.0 - 2.0 * float(map)), map).z > 0.9);\n"
              "  hash = mixed(hash, abs(angleOfCosine(0.5) * angleLimit - pi / 3.0) < 0.02);\n");
  return methodFault(shaders, method, [](const KnownPoint& point) {
    std::uint32_t hash = 0;
    for (int i = 0; i < 4; ++i) {
      const int layer = 4 * (layerAt(point.texel) / 2) + i;
      hash = mixed(hash, check::bitOf(check::knownMaps().angles, layer, point.texel));
    }
    return (mixed(mixed(hash, true), true) & 1U) != 0;
  });
}

/// Copies the map, and its negative into a second layer, in one number of bits.
MethodBake copyOf(const char* name, horizon::TableBits bits) {
  MethodBake bake;
  bake.name = name;
  bake.bits = bits;
  if (bits != horizon::TableBits::thirtyTwo) bake.ranges = {{-1, 3}};
  bake.layers = 2;
  bake.mips = {MipRule::maximum};
  return bake;
}

template <TableFilter filter>
std::string bakeFault(const Shaders& shaders) {
  // The third is made from the second; the coarsest level of a random map's maximum is 1.
  Method method = methodOf(
      DrawnMesh::base,
      "float copied(vec2 texel, int layer) { return abs(float(layer) - heightAt(texel)); }\n"
      "float bakeFirst(vec2 texel, int layer) { return copied(texel, layer); }\n"
      "float bakeSecond(vec2 texel, int layer) { return copied(texel, layer); }\n"
      "float bakeThird(vec2 texel, int layer) { return secondTexel(ivec2(texel), layer); }\n"
      "bool isShadowed(Pixel pixel, LocalLight light) {\n"
      "  vec2 at = pixel.texel + mapSize;\n"
      "  bool isOne = firstAt(at, 0) > 0.5 && firstAt(at, 1) < 0.5 && secondAt(at, 0) > 0.5 &&\n"
      "               secondAt(at, 1) < 0.5 && thirdAt(at, 0, 0.0) > 0.5 && thirdAt(at, 1) < 0.5;\n"
      "  return isOne && thirdTexel(ivec2(3, 5), 1, 6) > 0.9;\n"
      "}\n");
  method.tables.height = true;
  method.bakes = {copyOf("first", horizon::TableBits::eight),
                  copyOf("second", horizon::TableBits::sixteen),
                  copyOf("third", horizon::TableBits::thirtyTwo)};
  return methodFault(shaders, method, heightBit, filter);
}

// ---- Passes in the texture's plane ----

std::string textureFault(const Shaders& shaders) {
  Method method = methodOf(DrawnMesh::base,
                           "float resolveTexel(Pixel pixel) { return heightAt(pixel.texel); }\n"
                           "bool isShadowed(Pixel pixel, LocalLight light) {\n"
                           "  return resolvedAt(pixel.texel) > 0.5;\n"
                           "}\n");
  method.tables.height = method.tables.angles = true;
  method.passes.texture = true;
  return methodFault(shaders, method, heightBit);
}

/// A pass that filters another.
OwnPass filterOf(OwnPass pass, const char* name, int channels) {
  pass.name = name;
  pass.raster = PassRaster::filter;
  pass.source = 0;
  pass.channels = channels;
  return pass;
}

std::string ownPassFault(const Shaders& shaders) {
  Method method =
      methodOf(DrawnMesh::base,
               "vec2 passCopied(Pixel pixel) {\n"
               "  float height = heightAt(pixel.texel);\n"
               "  return vec2(height, 1.0 - height);\n"
               "}\n"
               "vec3 passTurned(ivec2 texel) { return vec3(0.5, copiedTexel(texel).yx); }\n"
               "bool isShadowed(Pixel pixel, LocalLight light) {\n"
               "  vec2 copied = copiedAt(pixel.texel);\n"
               "  vec3 turned = turnedAt(pixel.texel);\n"
               "  bool isSame = all(lessThan(abs(turned - vec3(0.5, copied.yx)), vec3(0.01)));\n"
               "  return copied.x > 0.5 && copied.y < 0.5 && isSame;\n"
               "}\n");
  method.tables.height = true;
  OwnPass copied;
  copied.name = "copied";
  copied.channels = 2;
  copied.bits = horizon::TableBits::eight;
  OwnPass turned = filterOf(copied, "turned", 3);
  turned.bits = horizon::TableBits::sixteen;
  method.passes.own = {copied, turned};
  return methodFault(shaders, method, heightBit);
}

std::string sharesFault(const Shaders& shaders) {
  constexpr double radius = radians(10.0);
  Method method =
      methodOf(DrawnMesh::base,
               "float visibility(Pixel pixel, LocalLight light) {\n"
               "  return float((int(pixel.texel.x) + 3 * int(pixel.texel.y)) % 17) / 16.0;\n"
               "}\n");
  method.hasTest = false;
  method.answersShares = true;
  const MethodPass pass(shaders, method, relief::Wrap::repeat, TableFilter::exact, {});
  const check::KnownScene scene;
  Drawing soft = scene.drawing();
  soft.light.radius = radius;
  const auto& [view, points] = check::atlasView();
  const VisibilityAnswers answers = pass.renderVisibility(view, soft, scene.tables());
  Tally tally;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double share = (points[i].texel.x + 3 * points[i].texel.y) % 17 / 16.0;
    const double drawn = std::min(share, discShare(std::asin(points[i].bumped) / radius));
    tally.add(answers.test.shares.at(i) == static_cast<float>(share) &&
              std::abs(static_cast<double>(answers.drawn.shares.at(i)) - drawn) < 1e-3);
  }
  return tally.fault();
}

// ---- Displaced geometry ----

bool isNever(const KnownPoint& /*point*/) {
  return false;
}

bool isHidden(const KnownPoint& point) {
  return point.isHidden;
}

/// By a depth map from the light. On a side turned from the light, the answer depends on how deep
/// it lies in the box: not compared.
std::optional<bool> isHiddenByDepth(const KnownPoint& point) {
  return point.face >= 0 && point.facesAway() ? std::nullopt : std::optional(point.isHidden);
}

std::string facetFault(const Shaders& shaders) {
  const char* glsl = "bool isShadowed(Pixel pixel, LocalLight light) { return false; }\n";
  return methodFault(shaders, methodOf(DrawnMesh::displaced, glsl), isNever);
}

std::string lightDepthFault(const Shaders& shaders) {
  // Nearer to the light by more than 0.3, where the box is above the floor by 2 and more.
  Method method = methodOf(DrawnMesh::displaced,
                           "bool isShadowed(Pixel pixel, LocalLight light) {\n"
                           "  vec3 place = lightMapPlace(pixel.position);\n"
                           "  float before = place.z - lightDepthOf(ivec2(floor(place.xy)));\n"
                           "  return before * lightMapLengths.y > 0.3;\n"
                           "}\n");
  method.passes.lightDepth = true;
  method.parameters["depth_side"] = {512, 512, 512, ""};
  return methodFault(shaders, method, isHiddenByDepth, TableFilter::exact, 1);
}

std::string volumeFault(const Shaders& shaders) {
  Method method =
      methodOf(DrawnMesh::displaced,
               "bool isShadowed(Pixel pixel, LocalLight light) { return shadowCount() != 0u; }\n");
  method.passes.shadowVolumes = true;
  return methodFault(shaders, method, isHidden);
}

std::string ownLightFault(const Shaders& shaders) {
  // As lightDepthFault; a disagreement of the levels, the filter and the depth inverts the answer.
  Method method =
      methodOf(DrawnMesh::displaced,
               "vec2 passSeen(Pixel pixel, float depth) { return vec2(depth, 1.0); }\n"
               "vec2 passCopied(ivec2 texel) { return seenTexel(texel); }\n"
               "bool isShadowed(Pixel pixel, LocalLight light) {\n"
               "  vec3 place = lightMapPlace(pixel.position);\n"
               "  ivec2 texel = ivec2(floor(place.xy));\n"
               "  float depth = copiedTexel(texel).x;\n"
               "  float covered = copiedTexel(ivec2(0), 9).y;\n"
               "  vec2 corner = seenTexel(ivec2(0));\n"
               "  bool isOdd = abs(depth - lightDepthOf(texel)) > 1e-6 || covered < 0.01 ||\n"
               "               covered > 0.99 || corner.x != 1.0 || corner.y != 0.0;\n"
               "  return ((place.z - lightDepthOf(texel)) * lightMapLengths.y > 0.3) != isOdd;\n"
               "}\n");
  OwnPass seen;
  seen.name = "seen";
  seen.raster = seen.root = PassRaster::light;
  seen.channels = 2;
  seen.clear = {1, 0, 0, 0};
  OwnPass copied = filterOf(seen, "copied", 2);
  copied.mips = true;
  method.passes.own = {seen, copied};
  method.parameters["depth_side"] = {512, 512, 512, ""};
  return methodFault(shaders, method, isHiddenByDepth, TableFilter::exact, 1);
}

std::string cameraPassFault(const Shaders& shaders) {
  // Shadowed where the ways to tell a pixel's point do not agree.
  Method method =
      methodOf(DrawnMesh::displaced,
               "vec3 passSeen(Pixel pixel) { return pixel.position; }\n"
               "vec4 passCopied(ivec2 texel) { return vec4(seenTexel(texel), 1.0); }\n"
               "bool isShadowed(Pixel pixel, LocalLight light) {\n"
               "  ivec2 at = ivec2(gl_FragCoord.xy);\n"
               "  vec3 byDepth = cameraPoint(vec3(gl_FragCoord.xy, cameraDepthOf(at)));\n"
               "  vec3 nearer = pixel.position + 0.1 * viewDirection(pixel);\n"
               "  return distance(byDepth, pixel.position) > 0.02 ||\n"
               "         distance(copiedTexel(at).xyz, pixel.position) > 1e-3 ||\n"
               "         distance(cameraPlace(nearer).xy, gl_FragCoord.xy) > 0.05 ||\n"
               "         cameraPlace(nearer).z > cameraDepthOf(at);\n"
               "}\n");
  method.passes.cameraDepth = true;
  OwnPass seen;
  seen.name = "seen";
  seen.raster = seen.root = PassRaster::camera;
  seen.channels = 3;
  method.passes.own = {seen, filterOf(seen, "copied", 4)};
  return methodFault(shaders, method, isNever);
}

/// A kind of pass with its name and its check.
struct PassEntry {
  PassKind kind;
  std::string_view name;
  std::string (*fault)(const Shaders& shaders);
};

constexpr std::array passEntries = {
    PassEntry{PassKind::cameraSamples, "the samples of a camera", cameraFault},
    PassEntry{PassKind::atlasSamples, "the samples of an atlas", atlasFault},
    PassEntry{PassKind::tables, "answers from tables", tableFault<TableFilter::exact>},
    PassEntry{PassKind::filteredTables, "answers from tables by the GPU's filter",
              tableFault<TableFilter::hardware>},
    PassEntry{PassKind::angles, "answers from horizon angles", angleFault},
    PassEntry{PassKind::ellipses, "answers from ellipses", ellipseFault},
    PassEntry{PassKind::bakes, "answers from a method's own bakes", bakeFault<TableFilter::exact>},
    PassEntry{PassKind::filteredBakes, "answers from a method's own bakes by the GPU's filter",
              bakeFault<TableFilter::hardware>},
    PassEntry{PassKind::facets, "facets of displaced geometry", facetFault},
    PassEntry{PassKind::texture, "a pass in the texture's plane", textureFault},
    PassEntry{PassKind::lightDepth, "the depth that the light sees", lightDepthFault},
    PassEntry{PassKind::shadowVolumes, "shadow volumes", volumeFault},
    PassEntry{PassKind::ownPasses, "passes of a method's own", ownPassFault},
    PassEntry{PassKind::ownLightPasses, "a method's own passes from the light", ownLightFault},
    PassEntry{PassKind::cameraPasses, "passes in the camera's picture", cameraPassFault},
    PassEntry{PassKind::shares, "shares of light", sharesFault},
    PassEntry{PassKind::pictures, "the pictures of masks", pictureFault},
};

const PassEntry& entryOf(PassKind kind) {
  const auto* found = std::find_if(passEntries.begin(), passEntries.end(),
                                   [kind](const PassEntry& entry) { return entry.kind == kind; });
  if (found == passEntries.end()) throw InternalError("pass: not one of its kinds");
  return *found;
}

}  // namespace

std::string_view passName(PassKind kind) {
  return entryOf(kind).name;
}

std::string passFault(PassKind kind, const std::filesystem::path& shaders) {
  return entryOf(kind).fault(shaders);
}

std::vector<PassKind> passesOf(const Method& method, TableFilter filter, bool isSoft) {
  const MethodTables& tables = method.tables;
  std::vector<PassKind> kinds;
  if (method.mesh == DrawnMesh::displaced) kinds.push_back(PassKind::facets);
  // Base meshes are shaded by the height map whatever the method reads.
  if (method.mesh == DrawnMesh::base || tables.height || tables.horizon || tables.distance) {
    kinds.push_back(filter == TableFilter::hardware ? PassKind::filteredTables : PassKind::tables);
  }
  if (tables.angles || tables.surfaceAngles) kinds.push_back(PassKind::angles);
  if (tables.ellipse) kinds.push_back(PassKind::ellipses);
  if (!method.bakes.empty()) {
    kinds.push_back(filter == TableFilter::hardware ? PassKind::filteredBakes : PassKind::bakes);
  }
  if (method.passes.texture) kinds.push_back(PassKind::texture);
  if (method.passes.lightDepth) kinds.push_back(PassKind::lightDepth);
  if (method.passes.shadowVolumes) kinds.push_back(PassKind::shadowVolumes);
  const bool fromLight = method.passes.hasOwn(PassRaster::light);
  if (fromLight) kinds.push_back(PassKind::ownLightPasses);
  if (!method.passes.own.empty()) kinds.push_back(PassKind::ownPasses);
  const bool inCamera = method.passes.cameraDepth || method.passes.hasOwn(PassRaster::camera);
  if (inCamera) kinds.push_back(PassKind::cameraPasses);
  if (isSoft && (method.answersShares || method.hasHorizon)) kinds.push_back(PassKind::shares);
  return kinds;
}

}  // namespace gnomon::render
