// What the section says of a pixel against what the shaders answered there.

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "model/cross_section.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon {
namespace {

using test::lightToward;
using test::randomRelief;
using test::RenderScene;
using test::shareShadowed;

using Verdict = std::function<bool(const SectionHorizons&)>;

/// Share of a view's samples where the section and the shader differ.
double differingShare(const RenderScene& scene, const RenderView& view, const std::string& method,
                      const Verdict& verdict) {
  const SectionTables tables{
      scene.horizon,
      scene.distance,
      {scene.tables.width, scene.tables.height, scene.tables.azimuths, scene.tables.wrap}};
  const Vec3 light = lightToward(50, 30);
  const SampleGrid samples = scene.samples(view);
  const Mask mask = scene.answer(method, view, light);
  EXPECT_GT(shareShadowed(mask), 0.2);
  EXPECT_LT(shareShadowed(mask), 0.9);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const auto section =
        crossSection(scene.surface, scene.relief, samples.samples[i], light, {6, 0}, &tables);
    const bool dark = verdict(section.value().fromTables.value());
    differ += dark != (mask.samples[i] == Shade::shadowed) ? 1 : 0;
  }
  return static_cast<double>(differ) / static_cast<double>(mask.size());
}

/// The base mesh is so fine that its frames are the limit surface's but for rounding.
TEST(CrossSection, SaysOfEveryPixelWhatTheShaderAnswers) {
  const GlContext gl;
  for (const HeightSpace space : {HeightSpace::world, HeightSpace::texture}) {
    Relief relief = randomRelief(64, 32, 2, 21);
    relief.space = space;
    const RenderScene scene(makeTorus(30, 10, 96, 66), relief, {16, 6}, TableBits::sixteen, 6);
    const RenderView view = atlasView(scene.surface, 1);
    const auto share = [&](const char* method, const Verdict& verdict) {
      return differingShare(scene, view, method, verdict);
    };
    const auto flat = [](const SectionHorizons& at) { return at.flat.shadowed; };
    const auto of2003 = [](const SectionHorizons& at) { return at.onoue2003; };
    const auto of2004 = [](const SectionHorizons& at) { return at.onoue2004; };
    const auto exact = [](const SectionHorizons& at) { return at.onoueExact; };
    EXPECT_LT(share("max-forsyth", flat), 1e-3);
    EXPECT_LT(share("onoue-2003", of2003), 1e-3);
    EXPECT_LT(share("onoue-2004", of2004), 1e-3);
    EXPECT_LT(share("onoue-exact", exact), 1e-3);
    // The methods differ here, so that the agreement says something.
    EXPECT_GT(share("onoue-2004", flat), 0.01);
    EXPECT_GT(share("onoue-2004", exact), 0.002);
  }
}

}  // namespace
}  // namespace gnomon
