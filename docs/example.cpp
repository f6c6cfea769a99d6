// How wrong a sphere with columns looks if its bump map casts no shadow.
#include <gnomon/compare.h>
#include <gnomon/horizon.h>
#include <gnomon/truth.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

int main() {
  std::vector<float> texels;  // columns 8 texels high on a lattice of 32
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      texels.push_back(std::hypot(x % 32 - 15.5F, y % 32 - 15.5F) < 8 ? 8.0F : 0.0F);
  const gnomon::HeightMap map{128, 128, texels};
  const gnomon::HorizonMaps horizons = gnomon::bakeHorizons(map, 32, 64);
  std::printf("steepest horizon: %g\n", *std::ranges::max_element(horizons.slopes));

  const gnomon::Surface sphere = gnomon::makeShape("sphere", {66.7, 1.92, 1.92}, 20, 20);
  const gnomon::SurfaceSamples samples = gnomon::atlasSamples(sphere, 16);
  const gnomon::Displacement relief{.map = map, .heightsInTexels = true};
  const auto truths =
      gnomon::traceTruth(sphere, relief, samples, {{0.8, 0.3, 0.5}}, {.step = 0.25});

  const gnomon::ShadowTruth& truth = truths.front();
  const std::vector<std::uint8_t> unshadowed(truth.mask.size(), 0);
  const auto figures =
      gnomon::compareMasks({truth.width, truth.height, unshadowed},
                           {truth.width, truth.height, truth.mask}, {.weights = samples.weights});
  std::printf("wrong on %.1f %% of the surface (truth: ± %.1f %%)\n",
              100 * figures.value("error_rate").value(), 100 * truth.uncertainty);
}
