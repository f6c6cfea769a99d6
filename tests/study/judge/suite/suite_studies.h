#pragma once

#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "study/judge/suite/suite_statistics.h"

namespace gnomon::test {

/// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  /// From 0 to below 1.
  double unit() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
  /// Normal (Box & Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - unit()));
    return radius * std::cos(2 * 3.14159265358979323846 * unit());
  }

 private:
  std::mt19937_64 generator_;
};

/// One method's error rate on one scene.
using ErrorOf = std::function<double(std::size_t scene, std::size_t method)>;

/// Scenes "scene-000", … of the suite "drawn", with methods "m0", "m1", … under one light.
inline std::vector<study::StudyMeans> drawnStudies(std::size_t scenes, std::size_t methods,
                                                   const ErrorOf& errorOf, double uncertainty = 0) {
  std::vector<study::StudyMeans> studies;
  for (std::size_t s = 0; s < scenes; ++s) {
    study::StudyMeans study;
    study.name = fmt::format("scene-{:03}", s);
    study.title = "Title of <" + study.name + ">";
    study.suite = "drawn";
    for (std::size_t m = 0; m < methods; ++m) {
      const std::string label = fmt::format("m{}", m);
      const double error = errorOf(s, m);
      study.methods.push_back(
          {label, label, error, error / 4, 3 * error / 4, uncertainty, {error}});
    }
    studies.push_back(std::move(study));
  }
  return studies;
}

/// Scenes of very different difficulty, on which each method errs by a factor of its own more or
/// less than by that difficulty.
/// @param factor  of each method
inline std::vector<study::StudyMeans> randomStudies(std::size_t scenes,
                                                    const std::vector<double>& factors,
                                                    std::uint64_t seed, double uncertainty = 0) {
  Random random(seed);
  std::vector<double> difficulty;
  for (std::size_t s = 0; s < scenes; ++s) difficulty.push_back(0.02 * std::exp(random.normal()));
  return drawnStudies(
      scenes, factors.size(),
      [&](std::size_t s, std::size_t m) {
        return std::min(1.0, difficulty[s] * factors[m] * std::exp(0.5 * random.normal()));
      },
      uncertainty);
}

}  // namespace gnomon::test
