#include "viewer/session/scene_data.h"

#include <gtest/gtest.h>

#include "app/viewer/viewed_study.h"
#include "common/error.h"
#include "viewer/session/background_worker.h"

namespace gnomon::app {
namespace {

class SceneMakerTest : public ViewedStudy {
 protected:
  SceneMaker maker_{study(), tryNone};
};

TEST_F(SceneMakerTest, MakesWhatTheShownMethodsRead) {
  const auto scene = made(maker_, {}, {"max-forsyth", "ellipse"});
  ASSERT_EQ(scene->methods.size(), 2U);
  const MethodData& horizons = *scene->methods.at("max-forsyth");
  ASSERT_TRUE(horizons.tables);
  EXPECT_FALSE(horizons.ellipses);
  EXPECT_EQ(horizons.tables->horizon.shape.layers, 8);
  // The same bytes as a run stores.
  const horizon::HorizonTables baked =
      horizon::bakeHorizons(scene->study->relief.field, horizons.spec.bake.settings);
  EXPECT_EQ(horizons.tables->horizon.values.bytes,
            horizon::storeTable(baked.horizon, horizon::TableBits::eight).bytes);
  EXPECT_TRUE(scene->methods.at("ellipse")->ellipses);
}

TEST_F(SceneMakerTest, KeepsWhatAChangeDoesNotTouch) {
  const auto first = made(maker_, {}, {"max-forsyth"});
  const auto tessellated = made(maker_, {"base.subdivisions=2"}, {"max-forsyth"});
  EXPECT_EQ(tessellated->surface, first->surface);
  EXPECT_EQ(tessellated->heights, first->heights);
  EXPECT_EQ(tessellated->methods.at("max-forsyth")->tables,
            first->methods.at("max-forsyth")->tables);
  EXPECT_EQ(tessellated->keys.truth, first->keys.truth);
  EXPECT_NE(tessellated->meshes, first->meshes);

  const auto higher = made(maker_, {"relief.height=5"}, {"max-forsyth"});
  EXPECT_EQ(higher->surface, first->surface);
  EXPECT_NE(higher->heights, first->heights);
  EXPECT_NE(higher->methods.at("max-forsyth")->tables, first->methods.at("max-forsyth")->tables);
  EXPECT_NE(higher->keys.truth, first->keys.truth);

  // A radius that is stated: the rule looks at the surface.
  const std::string radius = "bake.radius=20";
  const auto stated = made(maker_, {"relief.height=5", radius}, {"max-forsyth"});
  const auto bent =
      made(maker_, {"relief.height=5", radius, "surface.curvature=0.03"}, {"max-forsyth"});
  EXPECT_NE(bent->surface, first->surface);
  EXPECT_EQ(bent->methods.at("max-forsyth")->tables, stated->methods.at("max-forsyth")->tables)
      << "tables of the flat relief do not know the surface";
}

TEST_F(SceneMakerTest, AnImageThatChangesIsAnotherRelief) {
  const std::vector<std::string> image = {
      R"(relief={image="heights.pgm", height=4, height_space="world"})"};
  std::ofstream(file("heights.pgm")) << "P2\n3 2\n255\n0 90 255 10 30 70\n";
  const auto first = made(maker_, image, {"max-forsyth"});
  EXPECT_EQ(made(maker_, image, {"max-forsyth"})->heights, first->heights);
  std::ofstream(file("heights.pgm")) << "P2\n3 2\n255\n0 90 255 10 30 71\n";
  const auto second = made(maker_, image, {"max-forsyth"});
  EXPECT_EQ(second->heights->texels(), second->study->relief.field.texels());
  EXPECT_NE(second->keys.relief, first->keys.relief);
  EXPECT_NE(second->keys.truth, first->keys.truth);
  EXPECT_NE(second->methods.at("max-forsyth")->tables, first->methods.at("max-forsyth")->tables);
  EXPECT_EQ(second->surface, first->surface);
}

TEST_F(SceneMakerTest, AMeshThatChangesIsAnotherSurface) {
  const auto write = [&](const char* height) {
    std::ofstream(file("square.obj")) << "v 0 0 0\nv 1 0 " << height << "\nv 1 1 0\nv 0 1 0\n"
                                      << "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
  };
  const std::vector<std::string> mesh = {R"(surface={mesh="square.obj",scheme="catmull-clark"})"};
  write("0");
  const auto first = made(maker_, mesh, {"max-forsyth"});
  EXPECT_EQ(made(maker_, mesh, {"max-forsyth"})->surface, first->surface);
  write("0.25");
  const auto second = made(maker_, mesh, {"max-forsyth"});
  EXPECT_NE(second->surface, first->surface);
  EXPECT_NE(second->meshes, first->meshes);
  EXPECT_NE(second->keys.truth, first->keys.truth);
  EXPECT_EQ(second->methods.at("max-forsyth")->tables, first->methods.at("max-forsyth")->tables);
}

TEST_F(SceneMakerTest, ChangingTheTablesBakesAgain) {
  const auto first = made(maker_, {}, {"max-forsyth"});
  const auto finer = made(maker_, {"bake.azimuths=16"}, {"max-forsyth"});
  EXPECT_EQ(finer->methods.at("max-forsyth")->tables->horizon.shape.layers, 16);
  EXPECT_EQ(finer->keys.truth, first->keys.truth);
}

TEST_F(SceneMakerTest, OtherMethodsThanTheStudysCanBeShown) {
  SceneRequest request;
  request.options.addedMethods = {"onoue-2004"};
  request.options.overrides = {"method.3.bake.azimuths=4"};  // as a slider does
  request.shown = {"onoue-2004"};
  const auto scene =
      maker_.make(request, [](const std::string&) { return Progress([](double) {}); });
  EXPECT_EQ(scene->study->methods.size(), 4U);
  ASSERT_TRUE(scene->methods.contains("onoue-2004"));
  EXPECT_EQ(scene->methods.at("onoue-2004")->spec.bake.settings.azimuths, 4);
}

TEST_F(SceneMakerTest, AProgressThatThrowsCancelsAndTheNextSceneIsWhole) {
  SceneRequest request;
  request.shown = {"max-forsyth"};
  const auto cancels = [](const std::string& stage) {
    return Progress([stage](double) {
      if (stage == "Baking horizons") throw Cancelled{};
    });
  };
  EXPECT_THROW(maker_.make(request, cancels), Cancelled);
  EXPECT_TRUE(made(maker_, {}, {"max-forsyth"})->methods.at("max-forsyth")->tables);
}

TEST_F(SceneMakerTest, KeysOutOfRangeAreRefused) {
  EXPECT_THROW((void)made(maker_, {"bake.azimuths=0"}, {}), InputError);
}

}  // namespace
}  // namespace gnomon::app
