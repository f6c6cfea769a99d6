#include "image/images.h"

#include <fmt/core.h>
#include <webp/encode.h>

#include <algorithm>
#include <memory>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"

namespace gnomon::image {

namespace {

ExrDescription describe(const ChannelImage& image, const ImageAttributes& attributes) {
  return {image.width, image.height, image.channels, NumberType::float32, attributes};
}

/// All rows at once.
/// @param name  of the picture, for a message
ImageRows rowsOf(const ChannelImage& image, const std::string& name) {
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.values.empty() || image.values.size() != pixels * image.channels.size()) {
    throw InternalError(fmt::format("{}: {} × {} pixels of {} channels expected, {} values found",
                                    name, image.width, image.height, image.channels.size(),
                                    image.values.size()));
  }
  return {NumberType::float32, image.height, [&](int, int) { return image.values.data(); }};
}

}  // namespace

void writeExr(const std::filesystem::path& path, const ExrDescription& description,
              const ImageRows& rows) {
  writeAtomically(path, [&](int file) {
    try {
      imageModule().writeExr(file, description, rows);
    } catch (const ImageError& error) {
      throw InputError(fmt::format("{}: cannot be written: {}", path.string(), error.what()));
    }
  });
}

void writeExr(const std::filesystem::path& path, const ChannelImage& image,
              const ImageAttributes& attributes) {
  const ImageRows rows = rowsOf(image, path.string());
  writeExr(path, describe(image, attributes), rows);
}

std::string exrBytes(const ChannelImage& image) {
  try {
    return imageModule().writeExr({}, describe(image, {}), rowsOf(image, "an EXR"));
  } catch (const ImageError& error) {
    throw InternalError(fmt::format("an EXR cannot be encoded: {}", error.what()));
  }
}

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

namespace {

void require(bool succeeded, const WebPPicture& picture) {
  if (succeeded) return;
  throw InternalError(fmt::format("a WebP of {} x {} pixels cannot be written: error {} of libwebp",
                                  picture.width, picture.height,
                                  static_cast<int>(picture.error_code)));
}

void shrink(WebPPicture& picture, int longestSide) {
  const int longest = std::max(picture.width, picture.height);
  if (longest <= longestSide) return;
  const auto shrunk = [&](int side) {
    const auto length = static_cast<long>(side) * longestSide;
    return std::max(1, static_cast<int>((length + longest / 2) / longest));
  };
  const int width = shrunk(picture.width);
  require(WebPPictureRescale(&picture, width, shrunk(picture.height)) != 0, picture);
}

}  // namespace

std::string dataAddress(std::string_view type, const std::string& bytes) {
  return fmt::format("data:{};base64,{}", type, base64(bytes));
}

std::string webPicture(const Image& image, int quality, int longestSide) {
  WebPConfig config;
  WebPPicture picture;
  if (WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(quality)) == 0 ||
      WebPPictureInit(&picture) == 0) {
    throw InternalError("libwebp is of another version than the one this was built for");
  }
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> cleared(
      &writer, WebPMemoryWriterClear);
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> freed(&picture, WebPPictureFree);
  constexpr int littleEffort = 2;
  config.method = littleEffort;
  // What is shrunk first keeps its colours' places until it is encoded.
  picture.use_argb = std::max(image.width, image.height) > longestSide ? 1 : 0;
  picture.width = image.width;
  picture.height = image.height;
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  require(!image.rgb.empty(), picture);
  require(WebPPictureImportRGB(&picture, image.rgb.data(), 3 * image.width) != 0, picture);
  shrink(picture, longestSide);
  require(WebPEncode(&config, &picture) != 0, picture);
  return {reinterpret_cast<const char*>(writer.mem), writer.size};
}

}  // namespace gnomon::image
