#include "image/images.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "common/files/atomic_file.h"

namespace gnomon::image {
namespace {

void requireWhole(const Mask& mask) {
  if (mask.width < 0 || mask.height < 0 ||
      mask.size() != static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height)) {
    throw InternalError(fmt::format("mask: {} x {} expected, {} samples found", mask.width,
                                    mask.height, mask.size()));
  }
}

std::uint8_t maskGrey(Shade shade) {
  if (shade == Shade::none) return MaskGreys::none;
  return shade == Shade::lit ? MaskGreys::lit : MaskGreys::shadowed;
}

/// The colours of a difference.
enum DifferencePlace : std::uint8_t { none, bothLit, bothShadowed, falseShadow, falseLight };

DifferencePlace differencePlace(Shade candidate, Shade truth) {
  if (truth == Shade::none) return none;
  if (candidate == truth) return truth == Shade::lit ? bothLit : bothShadowed;
  return truth == Shade::lit ? falseShadow : falseLight;
}

/// @throws InputError where only one of the two has a sample
void requireSameSamples(const Mask& candidate, const Mask& truth) {
  const auto [own, right] =
      std::mismatch(candidate.samples.begin(), candidate.samples.end(), truth.samples.begin(),
                    [](Shade a, Shade b) { return (a == Shade::none) == (b == Shade::none); });
  if (own == candidate.samples.end()) return;
  const std::ptrdiff_t place = own - candidate.samples.begin();
  throw InputError(fmt::format("masks: column {}, row {} has a sample in only one of the two",
                               place % truth.width, place / truth.width));
}

}  // namespace

ByteImage maskImage(const Mask& mask) {
  requireWhole(mask);
  ByteImage image{mask.width, mask.height, std::vector<std::uint8_t>(mask.size())};
  std::transform(mask.samples.begin(), mask.samples.end(), image.values.begin(), maskGrey);
  return image;
}

PaletteImage differenceImage(const Mask& candidate, const Mask& truth) {
  requireWhole(candidate);
  requireWhole(truth);
  if (candidate.width != truth.width || candidate.height != truth.height) {
    throw InputError(fmt::format("candidate mask: {} x {} samples, but the truth has {} x {}",
                                 candidate.width, candidate.height, truth.width, truth.height));
  }
  requireSameSamples(candidate, truth);
  using Colours = DifferenceColours;
  PaletteImage image{truth.width,
                     truth.height,
                     {Colours::none, Colours::bothLit, Colours::bothShadowed, Colours::falseShadow,
                      Colours::falseLight},
                     std::vector<std::uint8_t>(truth.size())};
  std::transform(candidate.samples.begin(), candidate.samples.end(), truth.samples.begin(),
                 image.values.begin(), differencePlace);
  return image;
}

Image unfolded(const PaletteImage& image) {
  Image whole{image.width, image.height, std::vector<std::uint8_t>(3 * image.values.size())};
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const Rgb& colour = image.colours.at(image.values[i]);
    std::copy(colour.begin(), colour.end(), &whole.rgb[3 * i]);
  }
  return whole;
}

void writePng(const std::filesystem::path& path, const Image& image) {
  writeTextAtomically(path, pngOf(image));
}

void writePng(const std::filesystem::path& path, const ByteImage& image) {
  writeTextAtomically(path, pngOf(image));
}

void writePng(const std::filesystem::path& path, const PaletteImage& image) {
  writeTextAtomically(path, pngOf(image));
}

}  // namespace gnomon::image
