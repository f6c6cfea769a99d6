#include "report/text/truth_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "report/text/number_text.h"

namespace gnomon::report {

std::string stepText(double texels) {
  return fmt::format("{:.4g}", requireFinite(texels, "truth.step_texels"));
}

std::string flipText(std::optional<double> rate) {
  return rate ? fmt::format("{:.3g}", 100 * requireFinite(*rate, "flip rate")) : "–";
}

std::string radiusText(const study::RadiusRecord& radius) {
  return fmt::format("{} texels: {}", stepText(radius.texels), radius.reason);
}

std::string truthErrorText(const study::TruthRecord& truth) {
  const auto largest =
      std::max_element(truth.flips.begin(), truth.flips.end(),
                       [](const auto& a, const auto& b) { return a.flipRate < b.flipRate; });
  if (largest == truth.flips.end() || !largest->brightening) return "";
  const study::UncertaintyRecord& flip = *largest;
  const double change = *flip.brightening;
  const std::string where =
      truth.flips.size() == 1
          ? ""
          : fmt::format(" under \"{}\" in \"{}\", the most", flip.light, flip.view);
  if (!flip.percentile999) {
    return fmt::format(
        "Traced at half its resolution the truth changes at {} % of the samples{}. Of all samples "
        "{} "
        "% more turn {} than the reverse.",
        flipText(flip.flipRate), where, flipText(std::abs(change)), change < 0 ? "dark" : "lit");
  }
  return fmt::format(
      "Traced at half its resolution, toward half as many directions, V changes by {:.2g} in the "
      "mean{}. A single sample may be off by far more: 99.9 % of them change by at most {:.2g}. In "
      "the mean the coarser truth is {} by {:.2g}.",
      flip.flipRate, where, *flip.percentile999, change < 0 ? "darker" : "brighter",
      std::abs(change));
}

}  // namespace gnomon::report
