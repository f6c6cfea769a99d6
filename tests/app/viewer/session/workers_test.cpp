#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "app/viewer/viewed_study.h"
#include "model/light_angles.h"
#include "truth/shadow_tracer.h"
#include "truth/visibility_tracer.h"
#include "viewer/session/background_worker.h"
#include "viewer/session/truth_worker.h"

namespace gnomon::app {
namespace {

using Worker = BackgroundWorker<int, int>;

template <typename Condition>
bool comesTrue(const Condition& condition) {
  for (int i = 0; i < 2000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

int resultOf(Worker& worker) {
  std::optional<int> result;
  comesTrue([&] { return (result = worker.take()).has_value(); });
  return result.value_or(-1);
}

TEST(BackgroundWorker, ComputesWhatWasAskedForLast) {
  Worker worker([](const int& request, const Worker::Job& job) { job.publish(request * request); },
                [] {});
  worker.request(3);
  EXPECT_EQ(resultOf(worker), 9);
  worker.request(4);
  EXPECT_EQ(resultOf(worker), 16);
  EXPECT_FALSE(worker.take());
}

TEST(BackgroundWorker, ANewRequestCancelsTheOneUnderWay) {
  std::atomic<int> cancelled = 0;
  const auto endless = [&](const int& request, const Worker::Job& job) {
    if (request == 2) return job.publish(2);
    try {
      const Progress progress = job.progress("endless");
      while (true) {
        progress(0.5);
        std::this_thread::yield();
      }
    } catch (const Cancelled&) {
      ++cancelled;
      throw;
    }
  };
  Worker worker(endless, [] {});
  worker.request(1);
  ASSERT_TRUE(comesTrue([&] { return worker.status().stage == "endless"; }));
  EXPECT_TRUE(worker.status().busy);
  EXPECT_EQ(worker.status().share, 0.5);
  worker.request(2);
  EXPECT_EQ(resultOf(worker), 2);
  EXPECT_EQ(cancelled, 1);
}

TEST(BackgroundWorker, ResultsOfOlderRequestsAreNotTaken) {
  std::atomic<int> published = 0;
  Worker worker(
      [&](const int& request, const Worker::Job& job) {
        job.publish(request);
        ++published;
      },
      [] {});
  worker.request(1);
  ASSERT_TRUE(comesTrue([&] { return published == 1; }));
  worker.request(2);
  EXPECT_EQ(resultOf(worker), 2);
  EXPECT_FALSE(worker.take());
}

TEST(BackgroundWorker, ResultsOfACancelledRequestAreNotTaken) {
  std::atomic<int> published = 0;
  Worker worker(
      [&](const int& request, const Worker::Job& job) {
        job.publish(request);
        ++published;
      },
      [] {});
  worker.request(1);
  ASSERT_TRUE(comesTrue([&] { return published == 1; }));
  worker.cancel();
  EXPECT_FALSE(worker.take());
  worker.request(2);
  EXPECT_EQ(resultOf(worker), 2);
}

TEST(BackgroundWorker, EndsDuringAComputation) {
  std::atomic<bool> ended = false;
  {
    Worker worker(
        [&](const int&, const Worker::Job& job) {
          try {
            while (true) job.check();
          } catch (const Cancelled&) {
            ended = true;
            throw;
          }
        },
        [] {});
    worker.request(1);
    ASSERT_TRUE(comesTrue([&] { return worker.status().busy; }));
  }
  EXPECT_TRUE(ended);
}

/// Remembers which thread dropped it.
struct Dropped {
  explicit Dropped(std::atomic<std::thread::id>& place) : where(&place) {}
  Dropped(Dropped&& other) noexcept : where(std::exchange(other.where, nullptr)) {}
  Dropped& operator=(Dropped&&) = delete;
  Dropped(const Dropped&) = delete;
  Dropped& operator=(const Dropped&) = delete;
  ~Dropped() {
    if (where != nullptr) *where = std::this_thread::get_id();
  }
  std::atomic<std::thread::id>* where;
};

TEST(BackgroundWorker, DropsValuesOnItsOwnThread) {
  std::atomic<std::thread::id> dropper{};
  Worker worker([](const int&, const Worker::Job&) {}, [] {});
  worker.dispose(Dropped(dropper));
  ASSERT_TRUE(comesTrue([&] { return dropper.load() != std::thread::id(); }));
  EXPECT_NE(dropper.load(), std::this_thread::get_id());
}

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
