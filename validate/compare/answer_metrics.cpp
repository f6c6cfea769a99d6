#include "compare/answer_metrics.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.h"
#include "compare/answer_pair.h"
#include "compare/boundaries.h"

namespace gnomon::compare {

namespace {

void requireSize(const char* what, const Mask& mask, const Mask& truth) {
  if (mask.width == truth.width && mask.height == truth.height) return;
  throw InputError(fmt::format("{}: {} × {} pixels found, but the truth has {} × {}", what,
                               mask.width, mask.height, truth.width, truth.height));
}

/// Pixels without an answer of the candidate's, among those that count.
struct Missing {
  std::size_t count = 0;
  std::size_t first = 0;
};

void requireAll(const Missing& missing, const ComparedMasks& masks) {
  if (missing.count == 0) return;
  const auto width = static_cast<std::size_t>(masks.truth.width);
  throw InputError(fmt::format(
      "candidate: no sample at {} of the {} pixels to compare, first at column {}, row {}: give a "
      "region of interest without them",
      missing.count, missing.count + masks.compared, missing.first % width, missing.first / width));
}

bool haveSameSamples(const Mask& a, const Mask& b) {
  return a.width == b.width && a.height == b.height &&
         std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(),
                    [](Shade one, Shade other) { return isAnswer(one) == isAnswer(other); });
}

void requireSome(const ComparedMasks& masks, const Mask* roi) {
  if (masks.compared > 0) return;
  if (roi == nullptr || masks.outsideRoi == 0) throw InputError("truth: no pixel has a sample");
  const bool dark = std::none_of(roi->samples.begin(), roi->samples.end(),
                                 [](Shade shade) { return shade == Shade::lit; });
  throw InputError(dark ? "region of interest: no pixel is white"
                        : "region of interest: the truth has no sample in it");
}

}  // namespace

ComparedMasks commonPixels(Mask candidate, Mask truth, const Mask* roi) {
  requireSize("candidate", candidate, truth);
  if (roi != nullptr) requireSize("region of interest", *roi, truth);
  ComparedMasks masks{std::move(candidate), std::move(truth)};
  Missing missing;
  for (std::size_t i = 0; i < masks.truth.size(); ++i) {
    const bool isSample = isAnswer(masks.truth.samples[i]);
    const bool counts = isSample && (roi == nullptr || roi->samples[i] == Shade::lit);
    if (!counts) {
      ++(isSample ? masks.outsideRoi : masks.withoutSample);
      masks.candidate.samples[i] = masks.truth.samples[i] = Shade::none;
    } else if (isAnswer(masks.candidate.samples[i])) {
      ++masks.compared;
    } else if (missing.count++ == 0) {
      missing.first = i;
    }
  }
  requireAll(missing, masks);
  requireSome(masks, roi);
  return masks;
}

ComparedMasks commonPixels(const Visibility& candidate, const Visibility& truth, const Mask* roi) {
  ComparedMasks masks = commonPixels(cutInHalf(candidate), cutInHalf(truth), roi);
  masks.candidateShares = candidate;
  masks.truthShares = truth;
  for (std::size_t i = 0; i < masks.truth.size(); ++i) {
    if (isAnswer(masks.truth.samples[i])) continue;
    masks.candidateShares.shares[i] = masks.truthShares.shares[i] = noSample;
  }
  return masks;
}

Counts countsOf(const ComparedMasks& masks, std::span<const double> weights) {
  return masks.truthShares.size() > 0
             ? countSamples(masks.candidateShares, masks.truthShares, weights)
             : countSamples(masks.candidate, masks.truth, weights);
}

std::optional<std::string> invertedNotice(const ComparedMasks& masks,
                                          std::span<const double> weights) {
  constexpr double nearlyAll = 0.95;
  const auto errorOf = [&](const ComparedMasks& pair) {
    return rate(countsOf(pair, weights), metrics::errorRate).value.value_or(0);
  };
  const double error = errorOf(masks);
  if (!(error >= nearlyAll)) return std::nullopt;
  ComparedMasks complement = masks;
  for (Shade& shade : complement.candidate.samples) {
    if (isAnswer(shade)) shade = shade == Shade::lit ? Shade::shadowed : Shade::lit;
  }
  for (float& share : complement.candidateShares.shares) share = 1 - share;
  return fmt::format(
      "{:.3g} % of the samples are wrong, and the complement would be {:.3g} % wrong: is one of "
      "them inverted?",
      100 * error, 100 * errorOf(complement));
}

std::vector<Metric> maskMetrics(const ComparedMasks& masks) {
  if (masks.truthShares.size() == 0) return maskMetrics(masks.candidate, masks.truth);
  std::vector<Metric> metrics = rates(countsOf(masks));
  for (const auto& more : {compareBoundaries(masks.candidate, masks.truth),
                           shareMetrics(masks.candidateShares, masks.truthShares)}) {
    metrics.insert(metrics.end(), more.begin(), more.end());
  }
  return metrics;
}

std::vector<Metric> maskMetrics(const Mask& candidate, const Mask& truth) {
  std::vector<Metric> metrics = rates(countSamples(candidate, truth));
  const std::vector<Metric> boundaries = compareBoundaries(candidate, truth);
  metrics.insert(metrics.end(), boundaries.begin(), boundaries.end());
  return metrics;
}

ConfidenceInterval maskConfidence(std::span<const ComparedMasks> lights,
                                  std::span<const double> weights) {
  const Mask& view = lights.front().truth;
  for (const ComparedMasks& light : lights) {
    if (!haveSameSamples(light.truth, view)) return {{}, "the pictures are of several views", 0};
  }
  const Tiling tiling = chooseTiling(view, weights);
  const auto errorsOf = [&](const ComparedMasks& light) {
    return light.truthShares.size() > 0
               ? blockErrors(light.candidateShares, light.truthShares, tiling.cellSide, weights)
               : blockErrors(light.candidate, light.truth, tiling.cellSide, weights);
  };
  BlockErrors errors = errorsOf(lights.front());
  for (const ComparedMasks& light : lights.subspan(1)) errors += errorsOf(light);
  return rateConfidence(errors, tiling);
}

namespace {

/// Checks that a map holds what its width and height promise, without overflow for any of the two.
template <typename Map>
void requireWhole(const Map& map, const char* who) {
  const bool negative = map.width < 0 || map.height < 0;
  const std::size_t expected =
      negative ? 0 : static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  if (negative || map.size() != expected) {
    throw InputError(fmt::format("{} mask: {} x {} expected, {} samples found", who, map.width,
                                 map.height, map.size()));
  }
}

template <typename Map>
void requireSame(const Map& candidate, const Map& truth) {
  requireWhole(candidate, "candidate");
  requireWhole(truth, "truth");
  if (candidate.width != truth.width || candidate.height != truth.height) {
    throw InputError(fmt::format("candidate mask: {} x {} samples, but the truth has {} x {}",
                                 candidate.width, candidate.height, truth.width, truth.height));
  }
}

}  // namespace

bool answersAllOf(const Mask& truth, const Mask& candidate) {
  const Shade* right = truth.samples.data();
  const Shade* own = candidate.samples.data();
  // Without a branch and in bytes, so that many are looked at at once.
  std::uint8_t left = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    left = static_cast<std::uint8_t>(left | (isAnswer(right[i]) & !isAnswer(own[i])));
  }
  return left == 0;
}

void requireSameView(const Mask& candidate, const Mask& truth) {
  requireSame(candidate, truth);
}

void requireSameView(const Visibility& candidate, const Visibility& truth) {
  requireSame(candidate, truth);
}

void requireOnePerSample(std::size_t found, std::size_t samples, const char* what) {
  if (found != 0 && found != samples) {
    throw InputError(fmt::format("{}: {} values for {} samples, one each or none expected", what,
                                 found, samples));
  }
}

namespace {

constexpr std::string_view noSamples = "no samples";
constexpr std::string_view noArea = "the samples have no area";
constexpr std::string_view noUmbra = "neither the truth nor the candidate has an umbra";
constexpr std::string_view noPenumbra = "neither the truth nor the candidate has a penumbra";
constexpr std::string_view noRun = "no penumbra with both ends in view";
constexpr std::string_view fewRuns = "fewer than 30 penumbrae with both ends in view";

constexpr double farOff = 0.1;

/// The weight of the samples that either of two maps puts into a class, and that both do.
struct Overlap {
  double both = 0;
  double either = 0;

  void add(bool ours, bool theirs, double weight) {
    if (ours && theirs) both += weight;
    if (ours || theirs) either += weight;
  }
  [[nodiscard]] Metric metric(MetricId id, std::string_view otherwise) const {
    if (!(either > 0)) return {id, std::nullopt, otherwise};
    return {id, both / either, {}};
  }
};

bool isUmbra(double share) {
  return share < umbraTolerance;
}
bool isPenumbra(double share) {
  return share >= umbraTolerance && share <= 1 - umbraTolerance;
}

/// Sums over the samples that both maps hold.
struct ShareSums {
  double squares = 0;
  double far = 0;
  Overlap umbra, penumbra;

  void add(double ours, double theirs, double weight) {
    const double off = ours - theirs;
    squares += weight * off * off;
    if (std::abs(off) > farOff) far += weight;
    umbra.add(isUmbra(ours), isUmbra(theirs), weight);
    penumbra.add(isPenumbra(ours), isPenumbra(theirs), weight);
  }
};

}  // namespace

std::vector<Metric> shareMetrics(const Visibility& candidate, const Visibility& truth,
                                 std::span<const double> weights) {
  const Counts counts = countSamples(candidate, truth, weights);
  const Metric mae = rate(counts, metrics::errorRate);
  if (!mae.value) {
    const std::string_view reason = counts.samples == 0 ? noSamples : noArea;
    std::vector<Metric> none;
    for (const MetricId id : metricsOfKinds({MetricKind::share}))
      none.push_back({id, std::nullopt, reason});
    return none;
  }
  const SharePair pair(candidate, truth);
  ShareSums sums;
  for (std::size_t i = 0; i < pair.size(); ++i) {
    if (!pair.hasBoth(i)) continue;
    sums.add(pair.candidate(i), pair.truth(i), weights.empty() ? 1 : weights[i]);
  }
  const double all = counts.total();
  return {{"mae", mae.value, {}},
          {"rmse", std::sqrt(sums.squares / all), {}},
          {"off_by_more_than_0.1", sums.far / all, {}},
          sums.umbra.metric("umbra_iou", noUmbra),
          sums.penumbra.metric("penumbra_iou", noPenumbra)};
}

Mask penumbraMask(const Visibility& map) {
  Mask mask{map.width, map.height, {}};
  mask.samples.reserve(map.size());
  for (const float share : map.shares) {
    const auto value = static_cast<double>(share);
    const bool isInside = value > penumbraBegin && value < penumbraEnd;
    mask.samples.push_back(std::isnan(share) ? Shade::none
                           : isInside        ? Shade::shadowed
                                             : Shade::lit);
  }
  return mask;
}

std::vector<Metric> penumbraMetrics(const ShadowLengths& widths) {
  static_assert(leastRuns == 30, "the reason names it");
  const std::string_view reason = widths.runs == 0 ? noRun : fewRuns;
  const auto metric = [&](MetricId id, std::optional<double> value) -> Metric {
    return {id, value, value ? std::string_view() : reason};
  };
  return {metric("penumbra_width_ratio", widths.ratio),
          metric("penumbra_width_q1", widths.lowerQuartile),
          metric("penumbra_width_q3", widths.upperQuartile), metric("penumbra_runs", widths.runs)};
}

const std::vector<std::string_view>& shareReasons() {
  static const std::vector<std::string_view> reasons = {noSamples,  noArea, noUmbra,
                                                        noPenumbra, noRun,  fewRuns};
  return reasons;
}

}  // namespace gnomon::compare
