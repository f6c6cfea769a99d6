// How wrong a sphere with columns looks if its bump map casts no shadow.
#include <gnomon/compare.h>
#include <gnomon/truth.h>

#include <cmath>
#include <cstdio>

int main() {
  std::vector<float> texels;  // columns 8 texels high on a lattice of 32
  for (int i = 0; i < 128 * 128; ++i)
    texels.push_back(std::hypot(i % 32 - 15.5F, i / 128 % 32 - 15.5F) < 8 ? 8.0F : 0.0F);
  const gnomon::Displacement relief{.map = {128, 128, texels}, .heightsInTexels = true};
  const auto sphere = gnomon::makeShape(
      "sphere", {{"quads", {20, 20}}, {"curvature", {0.015}}, {"size", {128, 128}}});
  const auto samples = gnomon::atlasSamples(sphere, 16);
  const auto truths = gnomon::traceTruth(sphere, relief, samples, {{0.8, 0.3, 0.5}});
  const gnomon::ShadowTruth& truth = truths.front();
  const std::vector<std::uint8_t> unshadowed(truth.mask.size(), 1);  // 1 is lit
  const auto figures =
      gnomon::compareMasks({truth.width, truth.height, unshadowed},
                           {truth.width, truth.height, truth.mask}, {samples.weights});
  std::printf("wrong on %.1f %% of the surface (truth: ± %.1f %%)\n",
              100 * *figures.value("error_rate"), 100 * truth.uncertainty);
}
