#include "image/mask_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "image/grey_picture.h"

namespace gnomon::image {
namespace {

bool isGrey(float value) {
  constexpr float halfRounding = 0x1p-12F;  // of a half between 1/2 and 1
  return std::abs(value - 128.0F / 255.0F) <= 1.01F * halfRounding;
}

/// The grey of a map of visibility, which no share has (share_picture.h).
bool isSixteenBitGrey(float value) {
  return std::abs(value - 128.0F / 255.0F) <= 1e-5F;
}

/// Pixels of a kind, and the first of them.
struct Found {
  std::size_t count = 0;
  std::size_t first = 0;

  void add(std::size_t pixel) {
    if (count++ == 0) first = pixel;
  }
};

class PictureReader {
 public:
  PictureReader(const std::filesystem::path& path, GreyPicture picture)
      : path_(path), picture_(std::move(picture)) {
    for (std::size_t i = 0; i < picture_.values.size(); ++i) {
      if (!std::isfinite(alpha(i)) || (alpha(i) > 0 && !std::isfinite(picture_.values[i]))) {
        infinite_.add(i);
      } else if (!isPlain(i)) {
        soft_.add(i);
      }
    }
  }

  [[nodiscard]] MaskPicture read(std::optional<double> threshold) const {
    if (infinite_.count > 0) {
      throw InputError(fmt::format("{}: {}, finite numbers expected", path_.string(),
                                   described(infinite_, "are not finite")));
    }
    if (soft_.count > 0 && !threshold) {
      throw InputError(fmt::format(
          "{}: {}: masks of 0 and 1 expected, or --binarise with a value that parts lit from "
          "shadowed",
          path_.string(), described(soft_, "are neither black, white nor Gnomon's grey")));
    }
    MaskPicture result{{picture_.width, picture_.height, {}}, soft_.count};
    result.mask.samples.reserve(picture_.values.size());
    for (std::size_t i = 0; i < picture_.values.size(); ++i) {
      result.mask.samples.push_back(soft_.count > 0 ? parted(i, *threshold) : plain(i));
    }
    return result;
  }

 private:
  [[nodiscard]] float alpha(std::size_t i) const {
    return picture_.alphas.empty() ? 1.0F : picture_.alphas[i];
  }

  [[nodiscard]] bool isPlain(std::size_t i) const {
    const float value = picture_.values[i];
    return alpha(i) == 0 || (alpha(i) == 1 && (value == 0 || value == 1 || isGrey(value)));
  }

  [[nodiscard]] Shade plain(std::size_t i) const {
    const float value = picture_.values[i];
    if (alpha(i) == 0 || isGrey(value)) return Shade::none;
    return value == 1 ? Shade::lit : Shade::shadowed;
  }

  [[nodiscard]] Shade parted(std::size_t i, double threshold) const {
    if (alpha(i) < 0.5F || (picture_.integerBits == 16 && isSixteenBitGrey(picture_.values[i]))) {
      return Shade::none;
    }
    return picture_.values[i] >= threshold ? Shade::lit : Shade::shadowed;
  }

  [[nodiscard]] std::string described(const Found& found, const char* what) const {
    const auto width = static_cast<std::size_t>(picture_.width);
    const std::string cover =
        alpha(found.first) == 1 ? "" : fmt::format(" with alpha {}", alpha(found.first));
    return fmt::format("{} of {} pixels {}, first {}{} at column {}, row {}", found.count,
                       picture_.values.size(), what, picture_.values[found.first], cover,
                       found.first % width, found.first / width);
  }

  const std::filesystem::path& path_;
  GreyPicture picture_;
  Found infinite_, soft_;
};

void invert(Mask& mask) {
  for (Shade& shade : mask.samples) {
    if (shade == Shade::none) continue;
    shade = shade == Shade::lit ? Shade::shadowed : Shade::lit;
  }
}

void turnUpsideDown(Mask& mask) {
  const auto width = static_cast<std::ptrdiff_t>(mask.width);
  for (std::ptrdiff_t top = 0, bottom = mask.height - 1; top < bottom; ++top, --bottom) {
    std::swap_ranges(mask.samples.begin() + top * width, mask.samples.begin() + (top + 1) * width,
                     mask.samples.begin() + bottom * width);
  }
}

}  // namespace

MaskPicture readMaskPicture(const std::filesystem::path& path, const MaskReading& reading) {
  MaskPicture picture =
      PictureReader(path, readGreyPicture(path, reading.channel)).read(reading.threshold);
  if (reading.inverted) invert(picture.mask);
  if (reading.upward) turnUpsideDown(picture.mask);
  return picture;
}

}  // namespace gnomon::image
