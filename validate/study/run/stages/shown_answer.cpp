#include "study/run/stages/shown_answer.h"

#include <algorithm>
#include <cmath>

#include "image/images.h"

namespace gnomon::study {
namespace {

/// The colour between two of shade.frag's by a share of light, which is linear before its encoding.
std::uint8_t between(std::uint8_t dark, std::uint8_t lit, double share) {
  constexpr double encoding = 2.2;
  const auto light = [](std::uint8_t value) { return std::pow(value / 255.0, encoding); };
  const double mixed = light(dark) + share * (light(lit) - light(dark));
  return static_cast<std::uint8_t>(std::lround(255 * std::pow(mixed, 1 / encoding)));
}

/// @param rgb  of the sample lit
void shadeSample(const ShownAnswer& shown, std::size_t sample, const RgbPixels& darkColours,
                 std::uint8_t* rgb) {
  const std::uint8_t* dark = &darkColours[3 * sample];
  const double share = shown.isSoft() ? static_cast<double>(shown.shares.shares[sample]) : 0;
  if (share > 0) {
    for (std::size_t k = 0; share < 1 && k < 3; ++k) rgb[k] = between(dark[k], rgb[k], share);
  } else if (shown.mask.samples[sample] == Shade::shadowed) {
    std::copy_n(dark, 3, rgb);
  }
}

/// Of shadowed samples many lie together.
void darkenShadows(const std::vector<Shade>& samples, const RgbPixels& dark, RgbPixels& rgb) {
  for (auto first = samples.begin(); first != samples.end();) {
    first = std::find(first, samples.end(), Shade::shadowed);
    const auto end =
        std::find_if(first, samples.end(), [](Shade shade) { return shade != Shade::shadowed; });
    const auto byte = 3 * (first - samples.begin());
    std::copy_n(dark.begin() + byte, 3 * (end - first), rgb.begin() + byte);
    first = end;
  }
}

}  // namespace

ShownAnswer shownOf(const truth::Truth& truth) {
  return {truth.mask, truth.visibility};
}

RgbPixels shadingOf(const MeshColours& colours, const ShownAnswer& shown) {
  RgbPixels rgb = colours.lit;
  if (shown.isSoft()) {
    for (std::size_t i = 0; i < shown.mask.size(); ++i) {
      shadeSample(shown, i, *colours.dark, &rgb[3 * i]);
    }
  } else {
    darkenShadows(shown.mask.samples, *colours.dark, rgb);
  }
  return rgb;
}

std::array<std::uint8_t, 3> shadingAt(const MeshColours& colours, const ShownAnswer& shown,
                                      std::size_t sample) {
  std::array<std::uint8_t, 3> rgb{};
  std::copy_n(&colours.lit[3 * sample], 3, rgb.data());
  shadeSample(shown, sample, *colours.dark, rgb.data());
  return rgb;
}

std::array<std::uint8_t, 3> maskGrey(const ShownAnswer& shown, std::size_t sample) {
  constexpr std::uint8_t none = image::MaskGreys::none;
  if (shown.mask.samples[sample] == Shade::none) return {none, none, none};
  const float hard = shown.mask.samples[sample] == Shade::lit ? 1.0F : 0.0F;
  const float share = shown.isSoft() ? shown.shares.shares[sample] : hard;
  const auto grey = static_cast<std::uint8_t>(std::lround(255 * share));
  return {grey, grey, grey};
}

std::string maskFile(const RunWriter& writer, const ShownAnswer& shown) {
  return shown.isSoft() ? writer.shares(shown.shares) : writer.mask(shown.mask);
}

std::string differenceFile(const RunWriter& writer, const ShownAnswer& shown,
                           const ShownAnswer& truth) {
  return shown.isSoft() ? writer.difference(shown.shares, truth.shares)
                        : writer.difference(shown.mask, truth.mask);
}

}  // namespace gnomon::study
