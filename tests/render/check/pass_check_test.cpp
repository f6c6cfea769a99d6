// Every kind of pass checks itself: on this driver all are right, and a fault in what one of them
// is made of is found by its check and by no other that does not use it.

#include "render/check/pass_check.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <fstream>
#include <regex>
#include <set>

#include "common/files/atomic_file.h"
#include "render/gl_context.h"
#include "render/shader_files.h"
#include "support/replaced.h"
#include "support/temporary_folder.h"

namespace gnomon::render {
namespace {

namespace fs = std::filesystem;

constexpr std::array allKinds = {
    PassKind::cameraSamples,  PassKind::atlasSamples, PassKind::tables,
    PassKind::filteredTables, PassKind::angles,       PassKind::ellipses,
    PassKind::facets,         PassKind::texture,      PassKind::bakes,
    PassKind::filteredBakes,  PassKind::ownPasses,    PassKind::ownLightPasses,
    PassKind::cameraPasses,   PassKind::lightDepth,   PassKind::shadowVolumes,
    PassKind::shares,         PassKind::pictures,
};

TEST(PassCheck, FindsNothingWrongHere) {
  const GlContext gl;
  for (const PassKind kind : allKinds) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(passFault(kind, shaderFolder()), "") << passName(kind);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    fmt::print("{}: {:.0f} ms\n", passName(kind), taken.count());
  }
}

/// A change of one shader that compiles and is wrong, and the kinds that it makes wrong.
struct Fault {
  const char* file;
  const char* text;
  const char* instead;
  std::set<PassKind> found;
};

class WrongShader : public TemporaryFolder, public testing::WithParamInterface<Fault> {};

TEST_P(WrongShader, IsFoundByTheKindsThatUseIt) {
  const Fault& fault = GetParam();
  const GlContext gl;
  fs::copy(shaderFolder(), folder() / "shaders", fs::copy_options::recursive);
  const fs::path file = folder() / "shaders/common" / fault.file;
  const std::string text = test::replaced(readFile(file), fault.text, fault.instead);
  std::ofstream(file) << text;
  for (const PassKind kind : allKinds) {
    const std::string found = passFault(kind, folder() / "shaders");
    EXPECT_EQ(found.empty(), !fault.found.contains(kind)) << passName(kind) << ": " << found;
  }
}

using enum PassKind;

INSTANTIATE_TEST_SUITE_P(
    PassCheck, WrongShader,
    testing::Values(
        Fault{"shadow_volume.geom",
              "if (!alone && facesLight(b.world, a.world, beyond) == lit) return;",
              "return;",
              {shadowVolumes}},
        Fault{"shadow_volume.geom",
              "  emitWall(lit, c, a, b.world, world[5]);\n",
              "",
              {shadowVolumes}},
        Fault{"shadow_volume.geom",
              "lit ? a.clip : b.clip, clipOfInfinity",
              "a.clip, clipOfInfinity",
              {shadowVolumes}},
        Fault{"shadow_cap.geom", "emitCorner(gl_in[4]", "emitCorner(gl_in[2]", {shadowVolumes}},
        Fault{"passes.glsl",
              "textureSize(lightDepthMap, 0) - 1), 0).r;",
              "textureSize(lightDepthMap, 0) - 1), 0).r + 1.0;",
              {lightDepth, ownLightPasses}},
        Fault{"passes.glsl",
              "return texelFetch(shadowCounts, ivec2(gl_FragCoord.xy), 0).r;",
              "return texelFetch(shadowCounts, ivec2(gl_FragCoord.yx), 0).r;",
              {shadowVolumes}},
        Fault{"passes.glsl",
              "return weights > 0.0 ? sum / weights",
              "return weights > 0.0 ? 0.8 * sum",
              {texture, ownPasses}},
        Fault{"tables.glsl", "float place = azimuth", "float place = 1.0 + azimuth", {tables}},
        Fault{"tables.glsl",
              "float layer = azimuth / (2.0 * pi) + 0.5",
              "float layer = azimuth / (2.0 * pi) - 0.5",
              {filteredTables}},
        Fault{"tables.glsl",
              "mat2(entry[2], entry[3], entry[3], entry[4])",
              "mat2(entry[2], entry[3], entry[3], entry[2])",
              {ellipses}},
        Fault{"angles.glsl",
              "return texelFetch(angleMaps, ivec3(at, map), 0);",
              "return texelFetch(angleMaps, ivec3(at, 1 - map), 0);",
              {angles}},
        Fault{"relief.glsl",
              "Cell(texels.wzxy,",
              "Cell(texels.wzyx,",
              {tables, filteredTables, angles, ellipses, bakes, filteredBakes, texture, ownPasses,
               shares}},
        Fault{"bakes.glsl",
              "clamp(layer, 0, size.z - 1)), level);",
              "clamp(layer + 1, 0, size.z - 1)), level);",
              {bakes, filteredBakes}},
        Fault{"bakes.glsl",
              "vec3(at / mapSize, float(layer)), float(level)",
              "vec3(at.yx / mapSize, float(layer)), float(level)",
              {filteredBakes}},
        Fault{"bakes.glsl", "return mix(low, high,", "return mix(high, low,", {bakes}},
        Fault{"values.frag",
              "widened(float value) { return vec4(value,",
              "widened(float value) { return vec4(1.0 - value,",
              {bakes, filteredBakes, texture}},
        Fault{"values.frag",
              "widened(vec2 value) { return vec4(value,",
              "widened(vec2 value) { return vec4(value.yx,",
              {ownPasses, ownLightPasses}},
        Fault{"values.frag",
              "widened(vec3 value) { return vec4(value,",
              "widened(vec3 value) { return vec4(value.yxz,",
              {ownPasses, cameraPasses}},
        Fault{"passes.glsl",
              "cameraDepthMap, clamp(pixel,",
              "cameraDepthMap, clamp(pixel + 9,",
              {cameraPasses}},
        Fault{"passes.glsl",
              "normalize(eyePosition - pixel.position)",
              "normalize(eyePosition + pixel.position)",
              {cameraPasses}},
        Fault{"plane.vert",
              "gl_VertexID == 1 ? 3.0",
              "gl_VertexID == 1 ? 1.0",
              {bakes, filteredBakes, ownPasses, ownLightPasses, cameraPasses}},
        Fault{"pixel.glsl",
              "dot(facet, pixel.normal) < 0.0 ? -facet : facet",
              "dot(facet, pixel.normal) < 0.0 ? facet : -facet",
              {facets, lightDepth, shadowVolumes, ownLightPasses, cameraPasses, pictures}},
        Fault{"mask.frag",
              "(isHidden ? 1u : 0u) | (isHidden || isTurned ? 2u : 0u)",
              "(isHidden ? 1u : 0u) | (isTurned ? 2u : 0u)",
              {tables, filteredTables, angles, ellipses, bakes, filteredBakes, texture, lightDepth,
               shadowVolumes, ownPasses, ownLightPasses}},
        Fault{"visibility.frag", "drawn = min(test, ", "drawn = max(test, ", {shares}},
        Fault{"disc.glsl", "within * chord", "chord", {shares}},
        Fault{"shade.frag",
              "share * ((1.0 - ambient) * cosine)",
              "0.5 * share * ((1.0 - ambient) * cosine)",
              {pictures}},
        Fault{"samples.frag",
              "sampleSt = clamp(st",
              "sampleSt = clamp(st.yx",
              {cameraSamples, atlasSamples}},
        Fault{"surface.vert",
              "vertexFace % atlasTiles.x, vertexFace / atlasTiles.x",
              "1 - vertexFace % atlasTiles.x, vertexFace / atlasTiles.x",
              {atlasSamples, tables, filteredTables, angles, ellipses, bakes, filteredBakes,
               texture, ownPasses, shares}}));

TEST(GeometryShaders, IndexTheirInputsByConstants) {
  // What differs from triangle to triangle is read wrong by llvmpipe of Mesa 25.0: see
  // shadow_volume.geom. No other stage has inputs that could be indexed.
  std::size_t indices = 0;
  for (const auto& entry : fs::directory_iterator(shaderFolder() / "common")) {
    if (entry.path().extension() != ".geom") continue;
    const std::string text = std::regex_replace(readFile(entry.path()), std::regex("//[^\n]*"), "");
    const std::regex index(R"((gl_in|world)\[([^\]]*)\])");
    for (std::sregex_iterator found(text.begin(), text.end(), index), end; found != end; ++found) {
      const std::string inside = (*found)[2];
      EXPECT_TRUE(std::regex_match(inside, std::regex("[0-9]*"))) << entry.path() << ": " << inside;
      indices += inside.empty() ? 0 : 1;
    }
  }
  EXPECT_EQ(indices, 12U);
}

}  // namespace
}  // namespace gnomon::render
