#include "viewer/session/truth_worker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "app/viewer/viewed_study.h"
#include "model/light_angles.h"
#include "truth/shadow_tracer.h"
#include "truth/visibility_tracer.h"

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
  [[nodiscard]] std::shared_ptr<const surface::SampleGrid> samples(int width = 61,
                                                                   int height = 37) const {
    surface::SampleGrid grid{width, height, {}};
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
    asked.light = scene_->study->lights.front();
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

  static const Mask& maskOf(const PartialTruth& truth) { return std::get<Mask>(truth.answers); }
  static auto shadowCount(const PartialTruth& truth) {
    const std::vector<Shade>& samples = maskOf(truth).samples;
    return std::count(samples.begin(), samples.end(), Shade::shadowed);
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
  const truth::Truth truth =
      truth::traceShadows(*scene_->surface, scene_->study->relief, mesh, scene,
                          *asked.views[0].samples, truth::TraceSettings{asked.light});
  EXPECT_EQ(maskOf(found.back()).samples, truth.mask.samples);
  EXPECT_EQ(found.back().share(), 1);
}

/// In bands, while a run traces the whole view at once.
TEST_F(TruthTracerTest, UnderADiscEndsWithTheSharesThatARunTraces) {
  TruthRequest asked = request();
  asked.views = {{scene_->standardMesh(), samples(61, 100)}};
  asked.light.radius = radians(study::largestLightRadius);
  worker_.request(asked);
  const auto found = truths();
  ASSERT_FALSE(found.empty());
  EXPECT_LT(found.front().share(), 1);
  ASSERT_EQ(found.back().share(), 1);
  const truth::MicroMesh mesh(*scene_->surface, scene_->study->relief, scene_->study->truth);
  const truth::MicroScene scene(mesh);
  const truth::Truth hard =
      truth::traceShadows(*scene_->surface, scene_->study->relief, mesh, scene,
                          *asked.views[0].samples, truth::TraceSettings{asked.light});
  const Visibility truth = truth::traceVisibility(
      mesh, scene, *asked.views[0].samples, hard.mask,
      {asked.light, scene_->study->truth.directions, truth::standardRayOffset});
  EXPECT_TRUE(isSame(std::get<Visibility>(found.back().answers), truth));
  EXPECT_FALSE(isSame(truth, asShares(hard.mask))) << "no penumbra: the test shows nothing";
}

TEST_F(TruthTracerTest, GrowsAndNeverTakesAnAnswerBack) {
  worker_.request(request());
  const auto found = truths();
  ASSERT_GE(found.size(), 2U);
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_GE(found[i].tracedCount, found[i - 1].tracedCount);
    for (std::size_t k = 0; k < found[i].traced.size(); ++k) {
      if (found[i - 1].traced[k] == 0) continue;
      EXPECT_EQ(found[i].traced[k], 1);
      EXPECT_EQ(maskOf(found[i]).samples[k], maskOf(found[i - 1]).samples[k]);
    }
  }
}

TEST_F(TruthTracerTest, AnotherLightAnswersForItself) {
  worker_.request(request());
  (void)truths();
  TruthRequest low = request();
  low.light = makeLight({0, 11.3});
  worker_.request(low);
  const auto found = truths();
  ASSERT_FALSE(found.empty());
  const auto shadowed = shadowCount(found.back());
  worker_.request(request());
  const auto again = truths();
  EXPECT_GT(shadowed, shadowCount(again.back()));
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
