#include "compare/mask_checks.h"

#include <fmt/core.h>

#include <cstdint>

#include "common/error.h"

namespace gnomon::compare {
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

}  // namespace gnomon::compare
