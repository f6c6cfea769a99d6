#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "compare/confidence_interval.h"

namespace gnomon::compare {
/// Fewer scenes than this give no interval.
constexpr std::size_t leastScenes = 20;

/// How many resamples are drawn unless told otherwise.
constexpr std::size_t standardResamples = 19'999;

/// How many resamples so many comparisons of one family take. The smallest p of B resamples is
/// 1 / (1 + B); corrected for the number of comparisons it must be able to fall well below 0.05, or
/// no pair is ever distinguishable. At least standardResamples, else the fewest that make it 0.025.
std::size_t resamplesFor(std::size_t comparisons);

/// Scenes drawn anew with replacement, as often as there are resamples. Draw k of resample b is
/// ⌊n u⌋, where u is randomUnit(0, "scenes", b n + k) of common/random_stream.h: the same on every
/// machine.
class SceneResamples {
 public:
  /// @param scenes  n, 1 or more
  /// @param resamples  1 more than these is best a multiple of 20: then 5 % of them are a whole
  ///   number
  explicit SceneResamples(std::size_t scenes, std::size_t resamples = standardResamples);
  [[nodiscard]] std::size_t scenes() const { return scenes_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Fills n places with the scenes of a resample, each below n.
  void draw(std::size_t resample, std::span<std::uint32_t> scenes) const;

 private:
  std::size_t scenes_, count_;
};

/// What a mean over scenes is known by: the symmetric bootstrap-t (Hall 1988).
///
/// With the mean v̄ of n values, their standard deviation s and that of a resample s*, every
/// resample gives t* = |v̄* - v̄| √n / s*. A t* stands for how far, in standard errors, a mean lies
/// from what it estimates. Where all values of a resample are the same, t* is 0 if that is v̄ and
/// else infinite: such a resample says nothing of the error.
class ResampledMean {
 public:
  /// @param values  one a scene, as many as the resamples have scenes
  ResampledMean(std::span<const double> values, const SceneResamples& resamples);

  /// The same of several sets of values over the same scenes, one each, to the last bit: a resample
  /// is drawn once for all of them.
  static std::vector<ResampledMean> ofAll(std::span<const std::vector<double>> sets,
                                          const SceneResamples& resamples);

  [[nodiscard]] double mean() const { return mean_; }
  /// Why nothing can be said of the mean's error; empty if something can.
  [[nodiscard]] std::string_view reason() const { return reason_; }

  /// v̄ ± q s / √n, where q is what a share `error` of all t* reaches or exceeds, rounded to the
  /// wider side. It leaves out 0 just where probabilityOfZero() is no more than `error`.
  /// @param error  0.05 for 95 %; largestError over a whole number, as corrections for the number
  ///   of comparisons ask for: a mean keeps the t* that these need alone
  /// @returns none where there is a reason, and where the resamples are too few to tell so small an
  ///   error or some of them too uniform
  /// @throws InternalError for any other error
  [[nodiscard]] std::optional<Interval> interval(double error) const;

  /// p: how probable a mean at least as far from 0 would be if it estimated 0. With c of the B
  /// t* that reach |v̄| √n / s it is (1 + c) / (1 + B), never 0; 1 where there is a reason.
  [[nodiscard]] double probabilityOfZero() const { return probabilityOfZero_; }

  static constexpr double largestError = 0.05;

 private:
  /// All but what resamples tell.
  ResampledMean(std::span<const double> values, std::size_t resamples);
  /// @param all  the t*, one a resample; their order is lost
  /// @param places  of those to keep, from 1 for the largest, falling
  void setDeviates(std::vector<double>& all, const std::vector<std::size_t>& places);

  /// A t*, and how many are at least as large.
  struct Deviate {
    std::size_t place;
    double value;
  };

  double mean_ = 0;
  double standardError_ = 0;
  double probabilityOfZero_ = 1;
  std::string_view reason_;
  std::size_t resamples_ = 0;
  std::vector<Deviate> largest_;  ///< at the places that were to be kept
};

/// What a scene gives to a bin: of its samples, those whose value on an axis lies there.
struct SceneShare {
  double weight = 0;  ///< their share of the scene's samples, 0 to 1
  double wrong = 0;   ///< the share of the scene's samples that lie there and are wrong
};

/// A method's error rate over the samples of all scenes that lie in a bin, each scene with the same
/// weight: R = Σ wrong / Σ weight.
struct BinnedError {
  std::size_t scenes = 0;  ///< with a sample in the bin
  double weight = 0;       ///< mean over all scenes
  double errorRate = 0;
  /// 95 %, by ResampledMean of (wrong - R weight) / mean weight over all scenes, which has the mean
  /// 0 and, to first order, the error of R; cut to 0 to 1. None in fewer than `leastBinScenes`.
  std::optional<Interval> interval;
};

/// Fewer scenes with a sample in a bin give no interval.
constexpr std::size_t leastBinScenes = 10;

/// @param shares  one a scene
/// @returns none where no scene has a sample there
std::optional<BinnedError> binnedError(std::span<const SceneShare> shares,
                                       const SceneResamples& resamples);

}  // namespace gnomon::compare
