#include "render/check/pass_faults.h"
#include "render/check/tally.h"
#include "render/check/tile_scene.h"

namespace gnomon::render::check {
namespace {

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

}  // namespace

std::string bakeFault(const Shaders& shaders, TableFilter filter) {
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
      "  return isOne && thirdTexel(ivec2(3, 5), 1, 4) > 0.9;\n"
      "}\n");
  method.tables.height = true;
  method.bakes = {copyOf("first", horizon::TableBits::eight),
                  copyOf("second", horizon::TableBits::sixteen),
                  copyOf("third", horizon::TableBits::thirtyTwo)};
  return tileFault(shaders, method, filter, [](const TileValues& tiles, int x, int y) {
    return TileValues::bit(tiles.heights, 0, x, y);
  });
}

}  // namespace gnomon::render::check
