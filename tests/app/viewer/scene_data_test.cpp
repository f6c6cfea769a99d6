#include "viewer/scene_data.h"

#include <gtest/gtest.h>

#include "app/viewer/viewed_study.h"
#include "common/error.h"
#include "viewer/background_worker.h"

namespace gnomon {
namespace {

class SceneMakerTest : public ViewedStudy {
 protected:
  SceneMaker maker_{study()};
};

TEST_F(SceneMakerTest, MakesWhatTheShownMethodsRead) {
  const auto scene = made(maker_, {}, {"max-forsyth", "ellipse"});
  ASSERT_EQ(scene->methods.size(), 2U);
  const MethodData& horizons = *scene->methods.at("max-forsyth");
  ASSERT_TRUE(horizons.tables);
  EXPECT_FALSE(horizons.ellipses);
  EXPECT_EQ(horizons.tables->horizon.layers, 8);
  // The same bytes as a run stores.
  const HorizonTables baked = bakeHorizons(scene->study->relief.field, horizons.spec.bake.settings);
  EXPECT_EQ(horizons.tables->horizon.values.bytes,
            storeTable(baked.horizon, TableBits::eight).bytes);
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

  const auto bent = made(maker_, {"relief.height=5", "surface.curvature=0.03"}, {"max-forsyth"});
  EXPECT_NE(bent->surface, first->surface);
  EXPECT_EQ(bent->methods.at("max-forsyth")->tables, higher->methods.at("max-forsyth")->tables)
      << "tables of the flat relief do not know the surface";
}

TEST_F(SceneMakerTest, ChangingTheTablesBakesAgain) {
  const auto first = made(maker_, {}, {"max-forsyth"});
  const auto finer = made(maker_, {"bake.azimuths=16"}, {"max-forsyth"});
  EXPECT_EQ(finer->methods.at("max-forsyth")->tables->horizon.layers, 16);
  EXPECT_EQ(finer->keys.truth, first->keys.truth);
}

TEST_F(SceneMakerTest, OtherMethodsThanTheStudysCanBeShown) {
  SceneRequest request;
  request.options.overrides = {"method.3.name=onoue-2004"};
  request.shown = {"onoue-2004"};
  const auto scene =
      maker_.make(request, [](const std::string&) { return Progress([](double) {}); });
  EXPECT_EQ(scene->study->methods.size(), 4U);
  EXPECT_TRUE(scene->methods.contains("onoue-2004"));
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
}  // namespace gnomon
