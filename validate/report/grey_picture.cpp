#include "report/grey_picture.h"

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
#include "image_files/image_error.h"
#include "image_files/image_library.h"

namespace gnomon {
namespace {
namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw InputError(fmt::format("{}: {}", path.string(), oneLine(why)));
}

std::unique_ptr<ImageReader> openPicture(const fs::path& path) {
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) refuse(path, "no such file, an image was expected");
  try {
    return imageLibrary().open(path);
  } catch (const ImageError& error) {
    refuse(path, std::string("not an image that can be read: ") + error.what());
  }
}

/// What is read of a file: neighbouring channels of the part gone to.
struct Choice {
  ImageFacts facts;
  std::vector<int> colours;  ///< one, or three that must agree
  int alpha = -1;            ///< none
  int first = 0;             ///< of all channels read
  int count = 1;             ///< of all channels read
};

Choice chosen(ImageFacts facts, std::vector<int> colours, int alpha) {
  std::vector<int> all = colours;
  if (alpha >= 0) all.push_back(alpha);
  const auto [least, most] = std::minmax_element(all.begin(), all.end());
  const int first = *least;
  const int count = *most - first + 1;
  return {std::move(facts), std::move(colours), alpha, first, count};
}

Choice namedChannel(const fs::path& path, ImageReader& image, const std::string& channel) {
  std::vector<std::string> found;
  for (int part = 0; image.goTo(part); ++part) {
    const ImageFacts facts = image.facts();
    const int index = facts.channel(channel);
    if (index >= 0) return chosen(facts, {index}, -1);
    found.insert(found.end(), facts.channels.begin(), facts.channels.end());
  }
  refuse(path, fmt::format("no channel \"{}\", it has {}", channel, fmt::join(found, ", ")));
}

Choice onlyChannel(const fs::path& path, const ImageFacts& facts) {
  std::vector<int> colours;
  for (int c = 0; c < facts.channelCount(); ++c) {
    if (c != facts.alpha && c != facts.z) colours.push_back(c);
  }
  if (colours.size() == 1 || colours.size() == 3) {
    return chosen(facts, colours, facts.alpha);
  }
  refuse(path,
         fmt::format("channels {} found, one or three beside alpha expected: name one of them",
                     fmt::join(facts.channels, ", ")));
}

void requireFlat(const fs::path& path, const ImageFacts& facts) {
  if (facts.data.width < 1 || facts.data.height < 1 || facts.depth > 1 || facts.isDeep) {
    refuse(path, fmt::format("{} × {} × {} {}pixels found, a flat image expected", facts.data.width,
                             facts.data.height, facts.depth, facts.isDeep ? "deep " : ""));
  }
  if (facts.orientation != 1) {
    refuse(path, fmt::format("its Orientation is {}, upright pixels (1) expected: turn the picture",
                             facts.orientation));
  }
}

/// Integers of 32 bits are counts or flags, not shares of their largest value.
bool isPlainInteger(const Choice& choice) {
  const std::string& type =
      choice.facts.channelNumbers[static_cast<std::size_t>(choice.colours.front())];
  return type == "uint" || type == "int";
}

/// The channels chosen, beside each other, of every pixel of the data window.
std::vector<float> readChannels(const fs::path& path, ImageReader& image, const Choice& choice) {
  const ImageFacts& facts = choice.facts;
  const auto [width, height] = std::pair(facts.data.width, facts.data.height);
  const double pixels = static_cast<double>(width) * height;
  requireMemory(
      pixels * (sizeof(float) * (choice.count + 2.0) + static_cast<double>(facts.bytesAPixel)),
      fmt::format("{}: an image of {} × {} pixels", path.string(), width, height));
  const auto count = facts.pixelCount * static_cast<std::size_t>(choice.count);
  std::vector<float> values(count);
  const auto read = [&](NumberType type, void* out) {
    try {
      image.read(choice.first, choice.first + choice.count, type, out);
    } catch (const ImageError& error) {
      refuse(path, std::string("its pixels cannot be read: ") + error.what());
    }
  };
  if (isPlainInteger(choice)) {
    std::vector<std::uint32_t> integers(count);
    read(NumberType::uint32, integers.data());
    std::transform(integers.begin(), integers.end(), values.begin(),
                   [](std::uint32_t v) { return static_cast<float>(v); });
  } else {
    read(NumberType::float32, values.data());
  }
  return values;
}

/// A rectangle of pixels, in coordinates in which no sum overflows.
struct Window {
  std::int64_t x, y, width, height;

  [[nodiscard]] std::int64_t right() const { return x + width; }
  [[nodiscard]] std::int64_t below() const { return y + height; }
};

Window windowOf(const ImageWindow& window) {
  return {window.x, window.y, window.width, window.height};
}

/// The data's, where the file has none.
Window displayWindow(const ImageFacts& facts) {
  const bool has = facts.display.width >= 1 && facts.display.height >= 1;
  return windowOf(has ? facts.display : facts.data);
}

/// One pixel of the channels chosen.
class PixelReader {
 public:
  PixelReader(const fs::path& path, const Choice& choice)
      : path_(path), choice_(choice), associated_(!choice.facts.hasPlainAlpha) {}

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
  const Window from = windowOf(choice.facts.data);
  const Window to = displayWindow(choice.facts);
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
  const ImageFacts facts = image->facts();
  requireFlat(path, facts);
  const Choice choice =
      channel.empty() ? onlyChannel(path, facts) : namedChannel(path, *image, channel);
  requireFlat(path, choice.facts);
  return placeInWindow(path, choice, readChannels(path, *image, choice));
}

}  // namespace gnomon
