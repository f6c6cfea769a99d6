#include "compare/scenes/resampled_mean.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "common/error.h"

namespace gnomon::compare {
namespace {

/// Normal numbers, the same with every standard library (Box & Muller 1958).
class Normals {
 public:
  explicit Normals(std::uint64_t seed) : generator_(seed) {}
  double next() {
    const double u = (static_cast<double>(generator_() >> 11) + 1) * 0x1p-53;
    const double v = static_cast<double>(generator_() >> 11) * 0x1p-53;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.14159265358979323846 * v);
  }
  std::vector<double> next(std::size_t count, double mean) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(mean + next());
    return values;
  }

 private:
  std::mt19937_64 generator_;
};

// ---- the draws

/// As the header says, computed once more: SplitMix64 and FNV-1a by their definitions.
TEST(SceneResamples, AreThoseOfTheDefinition) {
  const auto split = [](std::uint64_t state) {
    std::uint64_t z = state + 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  };
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : {'s', 'c', 'e', 'n', 'e', 's'}) {
    hash = (hash ^ static_cast<std::uint64_t>(c)) * 1099511628211ULL;
  }
  const SceneResamples resamples(200, 50);
  std::array<std::uint32_t, 200> drawn{};
  for (std::size_t b = 0; b < 50; ++b) {
    resamples.draw(b, drawn);
    for (std::size_t k = 0; k < 200; ++k) {
      const std::uint64_t bits = split(split(split(0) ^ hash) ^ (b * 200 + k));
      EXPECT_EQ(drawn.at(k), static_cast<std::uint32_t>(std::ldexp(bits >> 11, -53) * 200));
    }
  }
}

/// Each scene is drawn as often as the others: χ² of 24 degrees, which 52 exceeds once in 1000.
/// Else Holm's correction leaves every pair of a large family in doubt, however far apart.
TEST(SceneResamples, AreEnoughToTellOneOfManyPairsApart) {
  for (const std::size_t comparisons : {0UL, 1UL, 100UL, 499UL, 500UL, 501UL, 1378UL, 100000UL}) {
    const std::size_t resamples = resamplesFor(comparisons);
    EXPECT_GE(resamples, standardResamples);
    const double smallest = 1.0 / static_cast<double>(1 + resamples);
    EXPECT_LE(smallest * static_cast<double>(comparisons), 0.025 + 1e-12) << comparisons;
    EXPECT_EQ((1 + resamples) % 20, 0U);
  }
  EXPECT_EQ(resamplesFor(325), standardResamples);
}

TEST(SceneResamples, DrawEveryScene) {
  const SceneResamples resamples(25, 4000);
  std::array<double, 25> counts{};
  std::array<std::uint32_t, 25> drawn{};
  for (std::size_t b = 0; b < resamples.count(); ++b) {
    resamples.draw(b, drawn);
    for (const std::uint32_t s : drawn) ++counts.at(s);
  }
  double squares = 0;
  for (const double count : counts) squares += (count - 4000) * (count - 4000) / 4000;
  EXPECT_LT(squares, 52);
}

// ---- the interval

/// How many of `trials` intervals of 95 % hold the mean that the values were drawn around.
template <typename Draw>
double coverage(int trials, std::size_t scenes, double mean, const Draw& draw) {
  const SceneResamples resamples(scenes, 999);
  int held = 0;
  for (int i = 0; i < trials; ++i) {
    std::vector<double> values;
    for (std::size_t s = 0; s < scenes; ++s) values.push_back(draw());
    const auto interval = ResampledMean(values, resamples).interval(0.05);
    held += interval && interval->holds(mean) ? 1 : 0;
  }
  return static_cast<double>(held) / trials;
}

TEST(ResampledMean, HoldsTheMeanOfNormalScenesIn95Of100Cases) {
  Normals normals(1);
  const double share = coverage(2000, 30, 2, [&] { return 2 + normals.next(); });
  EXPECT_GT(share, 0.935);
  EXPECT_LT(share, 0.965);
}

/// Errors of scenes are skewed: here nine of ten lie within a factor of 5 about the median. Then it
/// is a little too narrow, but less than Student's t, which gets 0.90.
TEST(ResampledMean, HoldsTheMeanOfSkewedScenesNearlyAsOften) {
  Normals normals(2);
  const double share = coverage(2000, 40, std::exp(0.5), [&] { return std::exp(normals.next()); });
  EXPECT_GT(share, 0.91);
  EXPECT_LT(share, 0.97);
}

/// Of many normal values t* is Student's t.
TEST(ResampledMean, IsNearlyStudentsOnManyScenes) {
  Normals normals(3);
  const std::vector<double> values = normals.next(200, 5);
  const ResampledMean mean(values, SceneResamples(200));
  double sum = 0;
  for (const double value : values) sum += value;
  double squares = 0;
  for (const double value : values) squares += (value - sum / 200) * (value - sum / 200);
  const double half = studentQuantile(199) * std::sqrt(squares / 199 / 200);
  EXPECT_NEAR(mean.mean(), sum / 200, 1e-12);
  EXPECT_NEAR(mean.interval(0.05)->high, sum / 200 + half, 0.04 * half);
  EXPECT_NEAR(mean.interval(0.05)->low, sum / 200 - half, 0.04 * half);
}

/// An interval leaves 0 out just where p is no more than its error.
TEST(ResampledMean, IntervalAndProbabilitySayTheSame) {
  Normals normals(4);
  const SceneResamples resamples(25, 999);
  int left = 0;
  int kept = 0;
  for (int i = 0; i < 300; ++i) {
    const ResampledMean mean(normals.next(25, 0.4), resamples);
    for (const double error : {0.05, 0.05 / 3, 0.05 / 10, 0.05 / 45}) {
      const auto interval = mean.interval(error);
      ASSERT_TRUE(interval);
      const bool rejects = mean.probabilityOfZero() <= error * (1 + 1e-9);
      EXPECT_EQ(!interval->holds(0), rejects) << mean.probabilityOfZero() << " " << error;
      (rejects ? left : kept) += 1;
    }
  }
  EXPECT_GT(left, 100);
  EXPECT_GT(kept, 100);
}

TEST(ResampledMean, OfTheNegativeIsTheNegative) {
  Normals normals(5);
  std::vector<double> values = normals.next(30, 0.3);
  const SceneResamples resamples(30);
  const ResampledMean mean(values, resamples);
  for (double& value : values) value = -value;
  const ResampledMean negative(values, resamples);
  EXPECT_EQ(negative.mean(), -mean.mean());
  EXPECT_EQ(negative.probabilityOfZero(), mean.probabilityOfZero());
  EXPECT_EQ(negative.interval(0.05)->low, -mean.interval(0.05)->high);
}

TEST(ResampledMean, SaysWhyThereIsNoInterval) {
  const ResampledMean few(std::vector<double>(19, 0.5), SceneResamples(19, 99));
  EXPECT_EQ(few.reason(), "fewer than 20 scenes");
  EXPECT_EQ(few.probabilityOfZero(), 1);
  EXPECT_FALSE(few.interval(0.05));
  const ResampledMean same(std::vector<double>(25, 0.1), SceneResamples(25, 99));
  EXPECT_EQ(same.reason(), "every scene gives the same");
  EXPECT_FALSE(same.interval(0.05));
}

/// One scene of 25 decides: in a third of the resamples it is missing, and nothing is known.
TEST(ResampledMean, OneSceneDecidesNothing) {
  std::vector<double> values(25);
  values[7] = 0.5;
  const ResampledMean mean(values, SceneResamples(25));
  EXPECT_EQ(mean.reason(), "");
  EXPECT_GT(mean.probabilityOfZero(), 0.3);
  EXPECT_FALSE(mean.interval(0.05));
}

/// p by its definition, of one set of values at a time.
double probabilityByDefinition(const std::vector<double>& values, const SceneResamples& resamples) {
  const auto n = static_cast<double>(values.size());
  const auto studentOf = [n](const std::vector<double>& of, double around) {
    double mean = 0;
    for (const double value : of) mean += value / n;
    double variance = 0;
    for (const double value : of) variance += (value - mean) * (value - mean) / (n - 1);
    return std::abs(mean - around) / std::sqrt(variance / n);
  };
  double mean = 0;
  for (const double value : values) mean += value / n;
  const double found = studentOf(values, 0);
  std::vector<std::uint32_t> drawn(values.size());
  double reached = 0;
  for (std::size_t b = 0; b < resamples.count(); ++b) {
    resamples.draw(b, drawn);
    std::vector<double> resample;
    for (const std::uint32_t s : drawn) resample.push_back(values[s]);
    if (studentOf(resample, mean) >= found) ++reached;
  }
  return (1 + reached) / (1 + static_cast<double>(resamples.count()));
}

/// More sets than one pass takes, some of which have a reason against an interval.
TEST(ResampledMean, OfManySetsIsThatOfEachByItself) {
  Normals normals(9);
  const SceneResamples resamples(30, 1999);
  std::vector<std::vector<double>> sets;
  for (int i = 0; i < 21; ++i) {
    sets.push_back(i % 5 == 3 ? std::vector<double>(30, 0.1 * i) : normals.next(30, 0.03 * i));
  }
  const std::vector<ResampledMean> means = ResampledMean::ofAll(sets, resamples);
  ASSERT_EQ(means.size(), sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const ResampledMean alone(sets[i], resamples);
    EXPECT_EQ(means[i].mean(), alone.mean());
    EXPECT_EQ(means[i].reason(), alone.reason());
    EXPECT_EQ(means[i].probabilityOfZero(), alone.probabilityOfZero());
    for (const double error : {0.05, 0.01}) {
      const auto interval = means[i].interval(error);
      ASSERT_EQ(interval.has_value(), alone.interval(error).has_value());
      if (!interval) continue;
      EXPECT_EQ(interval->low, alone.interval(error)->low);
      EXPECT_EQ(interval->high, alone.interval(error)->high);
    }
    if (i % 5 == 3) {
      EXPECT_EQ(means[i].reason(), "every scene gives the same");
    } else {
      EXPECT_EQ(means[i].probabilityOfZero(), probabilityByDefinition(sets[i], resamples));
    }
  }
  EXPECT_TRUE(ResampledMean::ofAll({}, resamples).empty());
}

TEST(ResampledMean, HasNoIntervalForAnErrorThatTheResamplesCannotTell) {
  Normals normals(6);
  const ResampledMean mean(normals.next(30, 1), SceneResamples(30, 199));
  EXPECT_TRUE(mean.interval(0.005));
  EXPECT_FALSE(mean.interval(0.004));
  EXPECT_THROW((void)mean.interval(0.06), InternalError);
  EXPECT_THROW((void)mean.interval(0.04), InternalError) << "0.05 / 1.25";
  EXPECT_THROW(ResampledMean(std::vector<double>(3), SceneResamples(4)), InternalError);
  EXPECT_THROW(SceneResamples(0), InternalError);
}

double unit(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

/// Where every scene lies in the bin with all of its samples, it is the mean over scenes.
TEST(BinnedError, OfWholeScenesIsTheirMean) {
  std::mt19937_64 generator(1);
  std::vector<SceneShare> shares;
  std::vector<double> errors;
  for (int s = 0; s < 40; ++s) {
    errors.push_back(0.2 + 0.2 * unit(generator));
    shares.push_back({1, errors.back()});
  }
  const SceneResamples resamples(40, 999);
  const auto bin = binnedError(shares, resamples);
  const ResampledMean mean(errors, resamples);
  ASSERT_TRUE(bin && bin->interval);
  EXPECT_EQ(bin->scenes, 40U);
  EXPECT_EQ(bin->weight, 1);
  EXPECT_NEAR(bin->errorRate, mean.mean(), 1e-12);
  EXPECT_NEAR(bin->interval->low, mean.interval(0.05)->low, 1e-9);
  EXPECT_NEAR(bin->interval->high, mean.interval(0.05)->high, 1e-9);
}

/// Scenes count by the share of their samples that lies in the bin.
TEST(BinnedError, IsWrongOverAllOfTheBin) {
  const std::vector<SceneShare> shares = {{0.5, 0.1}, {0, 0}, {0.1, 0.1}, {0.4, 0}};
  const auto bin = binnedError(shares, SceneResamples(4, 99));
  ASSERT_TRUE(bin);
  EXPECT_EQ(bin->scenes, 3U);
  EXPECT_DOUBLE_EQ(bin->weight, 0.25);
  EXPECT_DOUBLE_EQ(bin->errorRate, 0.2);
  EXPECT_FALSE(bin->interval) << "too few scenes";
  EXPECT_FALSE(binnedError(std::vector<SceneShare>(4), SceneResamples(4, 99)));
}

/// A ratio of two things that both vary from scene to scene: 0.1 of what lies in the bin is wrong,
/// a little more or less.
TEST(BinnedError, IntervalHoldsTheRatioIn95Of100Cases) {
  std::mt19937_64 generator(2);
  const SceneResamples resamples(50, 999);
  int held = 0;
  constexpr int trials = 1000;
  for (int i = 0; i < trials; ++i) {
    std::vector<SceneShare> shares;
    for (int s = 0; s < 50; ++s) {
      const double weight = unit(generator) < 0.3 ? 0 : unit(generator);
      shares.push_back({weight, weight * 0.2 * unit(generator)});
    }
    const auto bin = binnedError(shares, resamples);
    held += bin->interval->holds(0.1) ? 1 : 0;
  }
  EXPECT_GT(held, 0.93 * trials);
  EXPECT_LT(held, 0.97 * trials);
}

}  // namespace

}  // namespace gnomon::compare
