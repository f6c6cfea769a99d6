#include "compare/mask_checks.h"

#include <fmt/core.h>

#include "common/error.h"

namespace gnomon::compare {
namespace {

/// Checks that a mask holds what its width and height promise, without overflow for any of the two.
void requireWhole(const Mask& mask, const char* who) {
  const bool negative = mask.width < 0 || mask.height < 0;
  const std::size_t expected =
      negative ? 0 : static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height);
  if (negative || mask.size() != expected) {
    throw InputError(fmt::format("{} mask: {} x {} expected, {} samples found", who, mask.width,
                                 mask.height, mask.size()));
  }
}

}  // namespace

void requireSameView(const Mask& candidate, const Mask& truth) {
  requireWhole(candidate, "candidate");
  requireWhole(truth, "truth");
  if (candidate.width != truth.width || candidate.height != truth.height) {
    throw InputError(fmt::format("candidate mask: {} x {} samples, but the truth has {} x {}",
                                 candidate.width, candidate.height, truth.width, truth.height));
  }
}

void requireOnePerSample(std::size_t found, std::size_t samples, const char* what) {
  if (found != 0 && found != samples) {
    throw InputError(fmt::format("{}: {} values for {} samples, one each or none expected", what,
                                 found, samples));
  }
}

}  // namespace gnomon::compare
