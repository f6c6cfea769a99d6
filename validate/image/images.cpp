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

Image emptyImage(const Mask& mask) {
  return {mask.width, mask.height, std::vector<std::uint8_t>(3 * mask.size())};
}

void colour(Image& image, std::size_t pixel, const Rgb& with) {
  std::copy(with.begin(), with.end(), &image.rgb[3 * pixel]);
}

std::uint8_t maskGrey(Shade shade) {
  if (shade == Shade::none) return MaskGreys::none;
  return shade == Shade::lit ? MaskGreys::lit : MaskGreys::shadowed;
}

Rgb differenceColour(Shade candidate, Shade truth) {
  if (truth == Shade::none) return DifferenceColours::none;
  if (candidate == truth) {
    return truth == Shade::lit ? DifferenceColours::bothLit : DifferenceColours::bothShadowed;
  }
  return truth == Shade::lit ? DifferenceColours::falseShadow : DifferenceColours::falseLight;
}

}  // namespace

ByteImage maskImage(const Mask& mask) {
  requireWhole(mask);
  ByteImage image{mask.width, mask.height, std::vector<std::uint8_t>(mask.size())};
  std::transform(mask.samples.begin(), mask.samples.end(), image.values.begin(), maskGrey);
  return image;
}

Image differenceImage(const Mask& candidate, const Mask& truth) {
  requireWhole(candidate);
  requireWhole(truth);
  if (candidate.width != truth.width || candidate.height != truth.height) {
    throw InputError(fmt::format("candidate mask: {} x {} samples, but the truth has {} x {}",
                                 candidate.width, candidate.height, truth.width, truth.height));
  }
  Image image = emptyImage(truth);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if ((candidate.samples[i] == Shade::none) != (truth.samples[i] == Shade::none)) {
      const auto width = static_cast<std::size_t>(truth.width);
      throw InputError(fmt::format("masks: column {}, row {} has a sample in only one of the two",
                                   i % width, i / width));
    }
    colour(image, i, differenceColour(candidate.samples[i], truth.samples[i]));
  }
  return image;
}

void writePng(const std::filesystem::path& path, const Image& image) {
  writeTextAtomically(path, pngOf(image));
}

void writePng(const std::filesystem::path& path, const ByteImage& image) {
  writeTextAtomically(path, pngOf(image));
}

}  // namespace gnomon::image
