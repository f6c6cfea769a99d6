// How methods rank against the truth on a sphere, and what more azimuths and bits do.
//
// Errors are means over eight lights, none of which lies in an azimuth of a table. Two settings of
// one method are compared light by light; with d the differences of their errors, s their standard
// deviation and n = 8 lights, the mean of d is known to s / √n. A rise counts where it exceeds
// three times that: of 32 comparisons of settings that are alike, less than one would in ten runs.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "relief/patterns.h"
#include "render/render_scene.h"
#include "render/traced_scene.h"

namespace gnomon {
namespace {

using test::difference;
using test::lightToward;
using test::RenderScene;
using test::shareShadowed;
using test::TracedScene;

constexpr int lightCount = 8;

std::vector<Vec3> lights() {
  std::vector<Vec3> all;
  for (int l = 0; l < lightCount; ++l)
    all.push_back(lightToward(11 + 46.3 * l, l % 2 == 0 ? 45 : 30));
  return all;
}

Cage sphere() {
  return makeSphere(1 / 0.015, 1.44, 1.44, 24, 24);
}

Relief columns() {
  return {makeColumns(96, 96, {32, 8, 1}, 8, Wrap::repeat), HeightSpace::world, Vec2(1)};
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Truths of the sphere's samples under all lights, traced once.
class SphereErrors : public testing::Test {
 protected:
  static RenderScene scene(const BakeSettings& bake, TableBits bits) {
    return {sphere(), columns(), bake, bits, 2};
  }

  /// One a light.
  std::vector<double> errors(const RenderScene& on, const std::string& method) {
    const RenderView view = atlasView(on.surface, 8);
    const std::vector<Vec3> all = lights();
    if (truths_.empty()) {
      const TracedScene traced(on.surface, on.relief, 0.125);
      const SampleGrid samples = on.samples(view);
      for (const Vec3& light : all) {
        truths_.push_back(traced.mask(on.surface, on.relief, samples, light));
      }
    }
    std::vector<double> result;
    for (std::size_t l = 0; l < all.size(); ++l) {
      result.push_back(difference(on.answer(method, view, all[l]), truths_[l]));
    }
    return result;
  }

  [[nodiscard]] const std::vector<Mask>& truths() const { return truths_; }

 private:
  GlContext gl_;
  std::vector<Mask> truths_;
};

/// By how much the mean error rises beyond three of its standard errors.
double riseBeyondNoise(const std::vector<double>& coarse, const std::vector<double>& fine) {
  std::vector<double> d(coarse.size());
  for (std::size_t l = 0; l < d.size(); ++l) d[l] = fine[l] - coarse[l];
  const double rise = mean(d);
  double squares = 0;
  for (const double value : d) squares += (value - rise) * (value - rise);
  const auto n = static_cast<double>(d.size());
  return rise - 3 * std::sqrt(squares / (n - 1) / n);
}

const std::vector<std::string> tableMethods = {"max-forsyth", "onoue-2004", "sloan-cohen",
                                               "resampled-horizon"};

TEST_F(SphereErrors, DoNotRiseWithMoreAzimuthsAndBits) {
  std::map<std::string, std::map<std::pair<int, TableBits>, std::vector<double>>> found;
  const std::vector<int> azimuths = {8, 16, 32, 64};
  const std::vector<TableBits> depths = {TableBits::eight, TableBits::sixteen,
                                         TableBits::thirtyTwo};
  for (const int m : azimuths) {
    for (const TableBits bits : depths) {
      const RenderScene on = scene({m, 64}, bits);
      for (const std::string& method : tableMethods) found[method][{m, bits}] = errors(on, method);
    }
  }
  for (const Mask& truth : truths()) {
    EXPECT_GT(shareShadowed(truth), 0.1);
    EXPECT_LT(shareShadowed(truth), 0.9);
  }
  for (const std::string& method : tableMethods) {
    auto& of = found[method];
    for (const TableBits bits : depths) {
      for (std::size_t k = 1; k < azimuths.size(); ++k) {
        EXPECT_LE(riseBeyondNoise(of[{azimuths[k - 1], bits}], of[{azimuths[k], bits}]), 0)
            << method << ", " << azimuths[k] << " azimuths";
      }
    }
    for (const int m : azimuths) {
      for (std::size_t k = 1; k < depths.size(); ++k) {
        EXPECT_LE(riseBeyondNoise(of[{m, depths[k - 1]}], of[{m, depths[k]}]), 0)
            << method << ", bits";
      }
    }
    // The comparison can tell settings apart: the coarsest is clearly worse than the finest. But
    // for the method that only finds its candidates in the table, and them in eight azimuths
    // already.
    const double coarsest = mean(of[{8, TableBits::eight}]);
    const double finest = mean(of[{64, TableBits::thirtyTwo}]);
    if (method != "resampled-horizon") {
      EXPECT_LT(finest, 0.95 * coarsest) << method;
    }
    RecordProperty(method + "_8x8", std::to_string(coarsest));
    RecordProperty(method + "_64x32", std::to_string(finest));
  }
}

TEST_F(SphereErrors, OfTheOsculatingMarchAreTheLeastOfLocalMethods) {
  const RenderScene on = scene({32, 64}, TableBits::sixteen);
  const double march = mean(errors(on, "osculating-march"));
  for (const char* method : {"unshadowed", "max-forsyth", "onoue-2003", "onoue-2004", "sloan-cohen",
                             "ellipse", "relief-march"}) {
    const double error = mean(errors(on, method));
    RecordProperty(method, std::to_string(error));
    EXPECT_LT(march, error) << method;
  }
  const std::vector<double> geodesic = errors(on, "geodesic-march");
  RecordProperty("osculating-march", std::to_string(march));
  RecordProperty("geodesic-march", std::to_string(mean(geodesic)));
  EXPECT_LE(mean(geodesic), march);
}

}  // namespace
}  // namespace gnomon
