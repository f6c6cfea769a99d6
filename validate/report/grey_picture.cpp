#include "report/grey_picture.h"

#include <OpenImageIO/imageio.h>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <system_error>

#include "common/error.h"
#include "common/memory.h"
#include "common/one_line.h"
#include "relief/exr_limit.h"

namespace gnomon {
namespace {
namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw InputError(fmt::format("{}: {}", path.string(), oneLine(why)));
}

std::unique_ptr<OIIO::ImageInput> openPicture(const fs::path& path) {
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) refuse(path, "no such file, an image was expected");
  limitExrSize();
  // What was written unmultiplied stays so: the library would round the product to a file's bits.
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  auto image = OIIO::ImageInput::open(path.string(), &wishes);
  if (!image) refuse(path, "not an image that can be read: " + OIIO::geterror());
  return image;
}

/// What is read of a file: neighbouring channels of one of its parts.
struct Choice {
  OIIO::ImageSpec spec;
  int part = 0;
  std::vector<int> colours;  ///< one, or three that must agree
  int alpha = -1;            ///< none
  int first = 0;             ///< of all channels read
  int count = 1;             ///< of all channels read
};

Choice chosen(OIIO::ImageSpec spec, int part, std::vector<int> colours, int alpha) {
  std::vector<int> all = colours;
  if (alpha >= 0) all.push_back(alpha);
  const auto [least, most] = std::minmax_element(all.begin(), all.end());
  const int first = *least;
  const int count = *most - first + 1;
  return {std::move(spec), part, std::move(colours), alpha, first, count};
}

Choice namedChannel(const fs::path& path, OIIO::ImageInput& image, const std::string& channel) {
  std::vector<std::string> found;
  for (int part = 0; image.seek_subimage(part, 0); ++part) {
    const OIIO::ImageSpec spec = image.spec();
    const int index = spec.channelindex(channel);
    if (index >= 0) return chosen(spec, part, {index}, -1);
    found.insert(found.end(), spec.channelnames.begin(), spec.channelnames.end());
  }
  refuse(path, fmt::format("no channel \"{}\", it has {}", channel, fmt::join(found, ", ")));
}

Choice onlyChannel(const fs::path& path, const OIIO::ImageSpec& spec) {
  std::vector<int> colours;
  for (int c = 0; c < spec.nchannels; ++c) {
    if (c != spec.alpha_channel && c != spec.z_channel) colours.push_back(c);
  }
  if (colours.size() == 1 || colours.size() == 3) {
    return chosen(spec, 0, colours, spec.alpha_channel);
  }
  refuse(path,
         fmt::format("channels {} found, one or three beside alpha expected: name one of them",
                     fmt::join(spec.channelnames, ", ")));
}

void requireFlat(const fs::path& path, const OIIO::ImageSpec& spec) {
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.deep) {
    refuse(path, fmt::format("{} × {} × {} {}pixels found, a flat image expected", spec.width,
                             spec.height, spec.depth, spec.deep ? "deep " : ""));
  }
  const int orientation = spec.get_int_attribute("Orientation", 1);
  if (orientation != 1) {
    refuse(path, fmt::format("its Orientation is {}, upright pixels (1) expected: turn the picture",
                             orientation));
  }
}

/// Integers of 32 bits are counts or flags, not shares of their largest value.
bool isPlainInteger(const Choice& choice) {
  const auto type = choice.spec.channelformat(choice.colours.front());
  return type.basetype == OIIO::TypeDesc::UINT32 || type.basetype == OIIO::TypeDesc::INT32;
}

/// The channels chosen, beside each other, of every pixel of the data window.
std::vector<float> readChannels(const fs::path& path, OIIO::ImageInput& image,
                                const Choice& choice) {
  const OIIO::ImageSpec& spec = choice.spec;
  const double pixels = static_cast<double>(spec.width) * spec.height;
  requireMemory(
      pixels * (sizeof(float) * (choice.count + 2.0) + static_cast<double>(spec.pixel_bytes(true))),
      fmt::format("{}: an image of {} × {} pixels", path.string(), spec.width, spec.height));
  const auto count = spec.image_pixels() * static_cast<std::size_t>(choice.count);
  std::vector<float> values(count);
  const auto read = [&](OIIO::TypeDesc type, void* out) {
    // The TIFF reader answers true for a file that is cut off, but keeps its error.
    if (!image.read_image(choice.part, 0, choice.first, choice.first + choice.count, type, out) ||
        image.has_error()) {
      refuse(path, "its pixels cannot be read: " + image.geterror());
    }
  };
  if (isPlainInteger(choice)) {
    std::vector<std::uint32_t> integers(count);
    read(OIIO::TypeDesc::UINT32, integers.data());
    std::transform(integers.begin(), integers.end(), values.begin(),
                   [](std::uint32_t v) { return static_cast<float>(v); });
  } else {
    read(OIIO::TypeDesc::FLOAT, values.data());
  }
  return values;
}

/// A rectangle of pixels, in coordinates in which no sum overflows.
struct Window {
  std::int64_t x, y, width, height;

  [[nodiscard]] std::int64_t right() const { return x + width; }
  [[nodiscard]] std::int64_t below() const { return y + height; }
};

Window dataWindow(const OIIO::ImageSpec& spec) {
  return {spec.x, spec.y, spec.width, spec.height};
}

/// The data's, where the file has none.
Window displayWindow(const OIIO::ImageSpec& spec) {
  if (spec.full_width < 1 || spec.full_height < 1) return dataWindow(spec);
  return {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
}

/// One pixel of the channels chosen.
class PixelReader {
 public:
  PixelReader(const fs::path& path, const Choice& choice)
      : path_(path),
        choice_(choice),
        associated_(choice.spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0) {}

  [[nodiscard]] float alpha(const float* pixel) const {
    return choice_.alpha < 0 ? 1.0F : pixel[choice_.alpha - choice_.first];
  }

  /// @param column, row  of the picture, for the message
  [[nodiscard]] float value(const float* pixel, std::int64_t column, std::int64_t row) const {
    const float found = pixel[choice_.colours.front() - choice_.first];
    for (const int colour : choice_.colours) {
      const float other = pixel[colour - choice_.first];
      if (other == found || (std::isnan(found) && std::isnan(other))) continue;
      refuse(path_, fmt::format("its channels differ, {} and {} at column {}, row {}: a grey "
                                "picture expected, or the name of one channel",
                                found, other, column, row));
    }
    const float cover = alpha(pixel);
    return associated_ && cover > 0 && cover < 1 ? found / cover : found;
  }

 private:
  const fs::path& path_;
  const Choice& choice_;
  bool associated_;
};

GreyPicture placeInWindow(const fs::path& path, const Choice& choice,
                          const std::vector<float>& data) {
  const Window from = dataWindow(choice.spec);
  const Window to = displayWindow(choice.spec);
  const double pixels = static_cast<double>(to.width) * static_cast<double>(to.height);
  requireMemory(2 * sizeof(float) * pixels, fmt::format("{}: a display window of {} × {} pixels",
                                                        path.string(), to.width, to.height));
  const PixelReader reader(path, choice);
  GreyPicture picture{static_cast<int>(to.width), static_cast<int>(to.height), {}, {}};
  picture.values.resize(static_cast<std::size_t>(pixels), 0.0F);
  const bool covered =
      to.x >= from.x && to.y >= from.y && to.right() <= from.right() && to.below() <= from.below();
  if (choice.alpha >= 0 || !covered) picture.alphas.resize(picture.values.size(), 0.0F);
  for (auto y = std::max(to.y, from.y); y < std::min(to.below(), from.below()); ++y) {
    for (auto x = std::max(to.x, from.x); x < std::min(to.right(), from.right()); ++x) {
      const auto source = static_cast<std::size_t>((y - from.y) * from.width + x - from.x);
      const auto target = static_cast<std::size_t>((y - to.y) * to.width + x - to.x);
      const float* pixel = data.data() + source * static_cast<std::size_t>(choice.count);
      picture.values[target] = reader.value(pixel, x - to.x, y - to.y);
      if (!picture.alphas.empty()) picture.alphas[target] = reader.alpha(pixel);
    }
  }
  return picture;
}

}  // namespace

GreyPicture readGreyPicture(const fs::path& path, const std::string& channel) {
  const auto image = openPicture(path);
  requireFlat(path, image->spec());
  const Choice choice =
      channel.empty() ? onlyChannel(path, image->spec()) : namedChannel(path, *image, channel);
  requireFlat(path, choice.spec);
  return placeInWindow(path, choice, readChannels(path, *image, choice));
}

}  // namespace gnomon
