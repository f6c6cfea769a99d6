#include "image/mask_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "common/error.h"
#include "image/grey_picture.h"

namespace gnomon::image {

namespace {

constexpr float grey = 128.0F / 255.0F;

bool isGrey(float value) {
  constexpr float halfRounding = 0x1p-12F;  // of a half between 1/2 and 1
  return std::abs(value - grey) <= 1.01F * halfRounding;
}

/// Less than a step of 16 bits, more than a half's rounding of the grey.
constexpr float greyTolerance = 1e-5F;

/// The grey of a map of visibility, which no share has.
bool isNoSampleGrey(float value) {
  return std::abs(value - grey) <= greyTolerance;
}

float alphaOf(const GreyPicture& picture, std::size_t i) {
  return picture.alphas.empty() ? 1.0F : picture.alphas[i];
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
  PictureReader(const std::filesystem::path& file, GreyPicture picture)
      : path_(file), picture_(std::move(picture)) {
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
  [[nodiscard]] float alpha(std::size_t i) const { return alphaOf(picture_, i); }

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
    if (alpha(i) < 0.5F || (picture_.integerBits == 16 && isNoSampleGrey(picture_.values[i]))) {
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

}  // namespace

MaskPicture readMaskPicture(const std::filesystem::path& file, const MaskReading& reading) {
  MaskPicture picture =
      PictureReader(file, readGreyPicture(file, reading.channel)).read(reading.threshold);
  if (reading.inverted) invert(picture.mask);
  if (reading.upward) flipRows(picture.mask.samples, picture.mask.width);
  return picture;
}

namespace {

constexpr std::uint16_t greyLevel = 128 * 257;
constexpr double mostLevel = 65535;

std::uint16_t levelOf(float share) {
  if (std::isnan(share)) return greyLevel;
  const auto level =
      static_cast<std::uint16_t>(std::lround(mostLevel * static_cast<double>(share)));
  return level == greyLevel ? greyLevel - 1 : level;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const GreyPicture& picture,
                         std::size_t i, const char* expected) {
  const auto width = static_cast<std::size_t>(picture.width);
  throw InputError(fmt::format("{}: {} with alpha {} at column {}, row {}, {} expected",
                               file.string(), picture.values[i], alphaOf(picture, i), i % width,
                               i / width, expected));
}

float shareAt(const std::filesystem::path& file, const GreyPicture& picture, std::size_t i,
              bool isInverted) {
  const float alpha = alphaOf(picture, i);
  if (alpha == 0) return noSample;
  if (alpha != 1) refuse(file, picture, i, "alpha 0 or 1");
  const float value = picture.values[i];
  if (!(value >= 0 && value <= 1)) refuse(file, picture, i, "a share of 0 to 1");
  if (isNoSampleGrey(value)) return noSample;
  return isInverted ? 1 - value : value;
}

Rgb mixed(const Rgb& from, const Rgb& to, double share) {
  Rgb colour{};
  for (std::size_t k = 0; k < colour.size(); ++k) {
    colour[k] = static_cast<std::uint8_t>(std::lround(from[k] + share * (to[k] - from[k])));
  }
  return colour;
}

Rgb differenceColour(float candidate, float truth) {
  using Colours = DifferenceColours;
  if (std::isnan(truth)) return Colours::none;
  const Rgb base = mixed(Colours::bothShadowed, Colours::bothLit, static_cast<double>(truth));
  const double off = static_cast<double>(candidate) - static_cast<double>(truth);
  return mixed(base, off > 0 ? Colours::falseLight : Colours::falseShadow, std::abs(off));
}

/// What a colour of a signed difference tells.
struct SharesOfColour {
  double candidate, truth;
};

/// The inverse of differenceColour: only an error's colour has tint, and the rest is the grey of
/// the truth's share.
SharesOfColour sharesOfColour(const Rgb& colour) {
  using Colours = DifferenceColours;
  const bool isDarker = colour[0] > colour[2];
  const Rgb& error = isDarker ? Colours::falseShadow : Colours::falseLight;
  const double off =
      std::min(1.0, static_cast<double>(colour[0] - colour[2]) / (error[0] - error[2]));
  const double level = off < 1 ? (colour[1] - off * error[1]) / (1 - off) : 0;
  const double share =
      (level - Colours::bothShadowed[1]) / (Colours::bothLit[1] - Colours::bothShadowed[1]);
  // The candidate's share is one, too.
  const double truth = isDarker ? std::clamp(share, off, 1.0) : std::clamp(share, 0.0, 1 - off);
  return {isDarker ? truth - off : truth + off, truth};
}

/// @throws InputError for a colour that no signed difference has
float candidateOf(const Rgb& colour, const std::filesystem::path& file) {
  if (colour == DifferenceColours::none) return noSample;
  const SharesOfColour shares = sharesOfColour(colour);
  const auto candidate = static_cast<float>(shares.candidate);
  const Rgb expected = differenceColour(candidate, static_cast<float>(shares.truth));
  for (std::size_t k = 0; k < colour.size(); ++k) {
    if (std::abs(colour[k] - expected[k]) <= 2) continue;
    throw InputError(
        fmt::format("{}: a colour found that no signed difference has", file.string()));
  }
  return candidate;
}

void requireSameSamples(const Visibility& candidate, const Visibility& truth) {
  if (candidate.width != truth.width || candidate.height != truth.height) {
    throw InputError(fmt::format("candidate: {} x {} samples, but the truth has {} x {}",
                                 candidate.width, candidate.height, truth.width, truth.height));
  }
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (std::isnan(candidate.shares[i]) == std::isnan(truth.shares[i])) continue;
    const auto width = static_cast<std::size_t>(truth.width);
    throw InputError(fmt::format("maps: column {}, row {} has a sample in only one of the two",
                                 i % width, i / width));
  }
}

}  // namespace

std::string sharePng(const Visibility& map) {
  GreyImage image{map.width, map.height, {}};
  image.values.reserve(map.size());
  for (const float share : map.shares) image.values.push_back(levelOf(share));
  return pngOf(image);
}

std::string shareExr(const Visibility& map) {
  ChannelImage image{map.width, map.height, {"V", "A"}, {}};
  image.values.reserve(2 * map.size());
  for (const float share : map.shares) {
    const bool isThere = !std::isnan(share);
    image.values.push_back(!isThere                ? 0.0F
                           : isNoSampleGrey(share) ? grey - 2 * greyTolerance
                                                   : share);
    image.values.push_back(isThere ? 1.0F : 0.0F);
  }
  return exrBytes(image);
}

Visibility readSharePicture(const std::filesystem::path& file, const MaskReading& reading) {
  const GreyPicture picture = readGreyPicture(file, reading.channel);
  Visibility map{picture.width, picture.height, {}};
  map.shares.reserve(picture.values.size());
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    map.shares.push_back(shareAt(file, picture, i, reading.inverted));
  }
  if (reading.upward) flipRows(map.shares, map.width);
  return map;
}

bool holdsShares(const std::filesystem::path& file, const MaskReading& reading) {
  const GreyPicture picture = readGreyPicture(file, reading.channel);
  if (picture.integerBits == 8) return false;
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    const float value = picture.values[i];
    if (alphaOf(picture, i) != 0 && value > 0 && value < 1 && !isNoSampleGrey(value)) return true;
  }
  return false;
}

Image shareDifferenceImage(const Visibility& candidate, const Visibility& truth) {
  requireSameSamples(candidate, truth);
  Image image{truth.width, truth.height, {}};
  image.rgb.reserve(3 * truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Rgb colour = differenceColour(candidate.shares[i], truth.shares[i]);
    image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
  }
  return image;
}

Visibility sharesOfDifference(const std::filesystem::path& file) {
  std::array<GreyPicture, 3> channels;
  for (std::size_t k = 0; k < 3; ++k) channels[k] = readGreyPicture(file, std::string(1, "RGB"[k]));
  Visibility map{channels[0].width, channels[0].height, {}};
  map.shares.reserve(channels[0].values.size());
  for (std::size_t i = 0; i < channels[0].values.size(); ++i) {
    Rgb colour{};
    for (std::size_t k = 0; k < 3; ++k) {
      colour[k] = static_cast<std::uint8_t>(std::lround(255 * channels[k].values[i]));
    }
    map.shares.push_back(candidateOf(colour, file));
  }
  return map;
}

}  // namespace gnomon::image
