#include "render/check/pass_faults.h"
#include "render/check/tally.h"
#include "render/check/tile_scene.h"

namespace gnomon::render::check {

std::string textureFault(const Shaders& shaders) {
  Method method = methodOf(DrawnMesh::base,
                           "float resolveTexel(Pixel pixel) { return heightAt(pixel.texel); }\n"
                           "bool isShadowed(Pixel pixel, LocalLight light) {\n"
                           "  return resolvedAt(pixel.texel) > 0.5;\n"
                           "}\n");
  method.tables.height = method.tables.angles = true;
  method.passes.texture = true;
  return tileFault(shaders, method, TableFilter::exact, [](const TileValues& tiles, int x, int y) {
    return TileValues::bit(tiles.heights, 0, x, y);
  });
}

}  // namespace gnomon::render::check
