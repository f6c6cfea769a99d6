#include "viewer/session/truth_worker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "app/viewer/viewed_study.h"
#include "truth/shadow_tracer.h"

namespace gnomon::app {
namespace {

class TruthTracerTest : public ViewedStudy {
 protected:
  TruthTracerTest()
      : maker_(study(), tryNone),
        scene_(made(maker_, {}, {})),
        worker_([this](const TruthRequest& request,
                       const TruthTracer::Worker::Job& job) { tracer_.trace(request, job); },
                [] {}) {}

  /// Every face's parameters along the rows, with some pixels that show nothing.
  [[nodiscard]] std::shared_ptr<const surface::SampleGrid> samples() const {
    surface::SampleGrid grid{61, 37, {}};
    const int faces = scene_->surface->faceCount();
    for (int i = 0; i < grid.width * grid.height; ++i) {
      const auto share = [i](int step) { return static_cast<float>(i * step % 97) / 97; };
      grid.samples.push_back(i % 11 == 0 ? surface::SurfaceSample{}
                                         : surface::SurfaceSample{i % faces, share(13), share(29)});
    }
    return std::make_shared<const surface::SampleGrid>(std::move(grid));
  }
  [[nodiscard]] TruthRequest request() const {
    TruthRequest asked;
    asked.scene = scene_;
    asked.light = scene_->study->lights.front().direction();
    asked.views = {{scene_->standardMesh(), samples()}};
    return asked;
  }
  /// All truths until the whole one, or until half a minute is over.
  std::vector<PartialTruth> truths() {
    std::vector<PartialTruth> found;
    for (int i = 0; i < 3000; ++i) {
      while (auto result = worker_.take()) {
        EXPECT_EQ(result->error, "");
        if (result->truth) found.push_back(*result->truth);
      }
      if (!found.empty() && found.back().share() == 1) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return found;
  }

  SceneMaker maker_;
  std::shared_ptr<const SceneData> scene_;
  TruthTracer tracer_;
  TruthTracer::Worker worker_;
};

TEST_F(TruthTracerTest, EndsWithTheMaskThatARunTraces) {
  const TruthRequest asked = request();
  worker_.request(asked);
  const auto found = truths();
  ASSERT_FALSE(found.empty());
  const truth::MicroMesh mesh(*scene_->surface, scene_->study->relief, scene_->study->truth);
  const truth::MicroScene scene(mesh);
  const truth::Truth truth = truth::traceShadows(
      *scene_->surface, scene_->study->relief, mesh, scene, *asked.views[0].samples,
      {asked.light, scene_->study->bake.settings.radiusTexels, truth::standardRayOffset});
  EXPECT_EQ(found.back().mask.samples, truth.mask.samples);
  EXPECT_EQ(found.back().share(), 1);
}

TEST_F(TruthTracerTest, GrowsAndNeverTakesAnAnswerBack) {
  worker_.request(request());
  const auto found = truths();
  ASSERT_GE(found.size(), 2U);
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_GE(found[i].tracedCount, found[i - 1].tracedCount);
    for (std::size_t k = 0; k < found[i].mask.size(); ++k) {
      if (found[i - 1].traced[k] == 0) continue;
      EXPECT_EQ(found[i].traced[k], 1);
      EXPECT_EQ(found[i].mask.samples[k], found[i - 1].mask.samples[k]);
    }
  }
}

TEST_F(TruthTracerTest, AnotherLightAnswersForItself) {
  worker_.request(request());
  (void)truths();
  TruthRequest low = request();
  low.light = glm::normalize(Vec3(1, 0, 0.2));
  worker_.request(low);
  const auto found = truths();
  ASSERT_FALSE(found.empty());
  const auto shadowed = std::count(found.back().mask.samples.begin(),
                                   found.back().mask.samples.end(), Shade::shadowed);
  worker_.request(request());
  const auto again = truths();
  EXPECT_GT(shadowed, std::count(again.back().mask.samples.begin(), again.back().mask.samples.end(),
                                 Shade::shadowed));
}

TEST_F(TruthTracerTest, TheDisplacedSurfaceComesAtTheAskedSize) {
  TruthRequest asked = request();
  asked.views.clear();
  asked.picture = std::get<Camera>(scene_->study->views.front().kind);
  worker_.request(asked);
  std::optional<image::Image> picture;
  for (int i = 0; i < 3000 && (!picture || picture->width < 101); ++i) {
    while (auto result = worker_.take()) {
      if (result->picture) picture = std::move(result->picture);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, 101);
  EXPECT_EQ(picture->height, 67);
}

}  // namespace
}  // namespace gnomon::app
