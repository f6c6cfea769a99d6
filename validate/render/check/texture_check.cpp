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
  OwnPass turned = copied;
  turned.name = "turned";
  turned.raster = PassRaster::filter;
  turned.source = 0;
  turned.channels = 3;
  turned.bits = horizon::TableBits::sixteen;
  method.passes.own = {copied, turned};
  return tileFault(shaders, method, TableFilter::exact, [](const TileValues& tiles, int x, int y) {
    return TileValues::bit(tiles.heights, 0, x, y);
  });
}

}  // namespace gnomon::render::check
