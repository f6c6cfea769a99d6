#include <fmt/core.h>

#include <cstdint>

#include "horizon/horizon_ellipses.h"
#include "render/check/pass_faults.h"
#include "render/check/tally.h"
#include "render/check/tile_scene.h"

namespace gnomon::render::check {
namespace {

/// Both sides mix bits by the same rule, of which each and their order count.
std::uint32_t mixed(std::uint32_t hash, bool bit) {
  hash = (hash + (bit ? 1U : 2U)) * 2654435761U;
  return hash ^ hash >> 15;
}

/// What a method's shader adds up of what it reads, and the same of what is known.
struct Probe {
  const char* hash;  ///< GLSL: mixes into `hash`, at `at`, layers chosen by `k`
  std::uint32_t (*expected)(const TileValues& tiles, int x, int y, int k);
};

const Probe tableProbe = {
    "  hash = mixed(hash, heightAt(at) > 0.5);\n"
    "  hash = mixed(hash, horizonAt(at, 0.5 * pi * float(k)) > 0.5);\n"
    "  hash = mixed(hash, distanceAt(at, 0.5 * pi * float(k)) > 0.5);\n",
    [](const TileValues& tiles, int x, int y, int k) {
      const auto bit = [&](const auto& bits, int layer) {
        return TileValues::bit(bits, layer, x, y);
      };
      return mixed(mixed(mixed(0, bit(tiles.heights, 0)), bit(tiles.horizon, k)),
                   bit(tiles.distance, k));
    }};

const Probe ellipseProbe = {
    "  Ellipse ellipse = ellipseAt(at);\n"
    "  hash = mixed(hash, ellipse.centre.x > 0.5);\n"
    "  hash = mixed(hash, ellipse.centre.y > 0.5);\n"
    "  hash = mixed(hash, ellipse.spread[0][0] > 0.5);\n"
    "  hash = mixed(hash, ellipse.spread[0][1] > 0.5);\n"
    "  hash = mixed(hash, ellipse.spread[1][1] > 0.5);\n",
    [](const TileValues& tiles, int x, int y, int) {
      std::uint32_t hash = 0;
      for (int layer = 0; layer < horizon::EllipseTable::numbers; ++layer) {
        hash = mixed(hash, TileValues::bit(tiles.ellipse, layer, x, y));
      }
      return hash;
    }};

/// The two lookup maps of angles are smooth: some of their values are known.
const Probe angleProbe = {
    "  int map = k / 2;\n"
    "  vec4 four = anglesOfTexel(ivec2(floor(at)), map);\n"
    "  for (int i = 0; i < 4; ++i) hash = mixed(hash, four[i] > 0.5);\n"
    "  hash = mixed(hash, basisOf(vec2(0.0, 1.0 - 2.0 * float(map)), map).z > 0.9);\n"
    "  hash = mixed(hash, abs(angleOfCosine(0.5) * angleLimit - pi / 3.0) < 0.02);\n",
    [](const TileValues& tiles, int x, int y, int k) {
      std::uint32_t hash = 0;
      for (int i = 0; i < 4; ++i)
        hash = mixed(hash, TileValues::bit(tiles.angles, 4 * (k / 2) + i, x, y));
      return mixed(mixed(hash, true), true);
    }};

/// Reads one map further, where the tables repeat.
std::string probeText(const Probe& probe) {
  return fmt::format(
      "uint mixed(uint hash, bool bit) {{\n"
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
      tile::columns, tile::side, tile::azimuths, probe.hash);
}

std::string probeFault(const Shaders& shaders, const Probe& probe, const MethodTables& tables,
                       TableFilter filter) {
  Method method = methodOf(DrawnMesh::base, probeText(probe));
  method.tables = tables;
  return tileFault(shaders, method, filter, [&](const TileValues& tiles, int x, int y) {
    return (probe.expected(tiles, x, y, (x + y) % tile::azimuths) & 1U) != 0;
  });
}

}  // namespace

std::string tableFault(const Shaders& shaders, TableFilter filter) {
  MethodTables tables;
  tables.height = tables.horizon = tables.distance = true;
  return probeFault(shaders, tableProbe, tables, filter);
}

std::string ellipseFault(const Shaders& shaders) {
  MethodTables tables;
  tables.ellipse = true;
  return probeFault(shaders, ellipseProbe, tables, TableFilter::exact);
}

std::string angleFault(const Shaders& shaders) {
  MethodTables tables;
  tables.angles = true;
  return probeFault(shaders, angleProbe, tables, TableFilter::exact);
}

}  // namespace gnomon::render::check
