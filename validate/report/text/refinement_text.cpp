#include "report/text/refinement_text.h"

#include <fmt/core.h>

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

std::string refinementText(const study::TruthRecord& truth) {
  if (!truth.wantedUncertainty) return "";
  std::string text =
      fmt::format("Refined until at most {} % of the samples differ from the level before:",
                  flipText(truth.wantedUncertainty));
  const char* separator = " ";
  for (const study::RefinementRecord& level : truth.refinement) {
    text += fmt::format("{}step {} ({} micro-triangles", separator, stepText(level.stepTexels),
                        groupedText(level.microTriangles));
    text += level.flipRate ? fmt::format(", {} %)", flipText(level.flipRate)) : ")";
    separator = ", ";
  }
  return text + ".";
}

}  // namespace gnomon::report
