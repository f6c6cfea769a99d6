#include "image/grey_picture.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "common/system/memory.h"
#include "image/image_file.h"

namespace gnomon::image {
namespace {
namespace fs = std::filesystem;

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

Choice namedChannel(ImageFile& image, const std::string& channel) {
  std::vector<std::string> found;
  for (int part = 0; image.goTo(part); ++part) {
    const ImageFacts facts = image.facts();
    const int index = facts.channel(channel);
    if (index >= 0) return chosen(facts, {index}, -1);
    found.insert(found.end(), facts.channels.begin(), facts.channels.end());
  }
  image.refuse(fmt::format("no channel \"{}\", it has {}", channel, fmt::join(found, ", ")));
}

Choice onlyChannel(const ImageFile& image, const ImageFacts& facts) {
  std::vector<int> colours;
  for (int c = 0; c < facts.channelCount(); ++c) {
    if (c != facts.alpha && c != facts.z) colours.push_back(c);
  }
  if (colours.size() == 1 || colours.size() == 3) {
    return chosen(facts, colours, facts.alpha);
  }
  image.refuse(
      fmt::format("channels {} found, one or three beside alpha expected: name one of them",
                  fmt::join(facts.channels, ", ")));
}

void requireUpright(const ImageFile& image, const ImageFacts& facts) {
  if (facts.orientation != 1) {
    image.refuse(fmt::format("its Orientation is {}, upright pixels (1) expected: turn the picture",
                             facts.orientation));
  }
}

/// Integers of 32 bits are counts or flags, not shares of their largest value.
bool isPlainInteger(const Choice& choice) {
  const std::string& type =
      choice.facts.channelNumbers[static_cast<std::size_t>(choice.colours.front())];
  return type == "uint" || type == "int";
}

int integerBits(const Choice& choice) {
  const std::string& type =
      choice.facts.channelNumbers[static_cast<std::size_t>(choice.colours.front())];
  if (type == "uint8" || type == "int8") return 8;
  return type == "uint16" || type == "int16" ? 16 : 0;
}

/// The data's, where the file has none.
const ImageWindow& displayWindow(const ImageFacts& facts) {
  const bool has = facts.display.width >= 1 && facts.display.height >= 1;
  return has ? facts.display : facts.data;
}

/// One pixel of the channels chosen.
class PixelReader {
 public:
  PixelReader(const ImageFile& image, const Choice& choice)
      : image_(image), choice_(choice), associated_(!choice.facts.hasPlainAlpha) {}

  [[nodiscard]] float alpha(const float* pixel) const {
    return choice_.alpha < 0 ? 1.0F : pixel[choice_.alpha - choice_.first];
  }

  /// @param column, row  of the picture, for the message
  [[nodiscard]] float value(const float* pixel, std::int64_t column, std::int64_t row) const {
    const float found = pixel[choice_.colours.front() - choice_.first];
    for (const int colour : choice_.colours) {
      const float other = pixel[colour - choice_.first];
      if (other == found || (std::isnan(found) && std::isnan(other))) continue;
      image_.refuse(
          fmt::format("its channels differ, {} and {} at column {}, row {}: a grey "
                      "picture expected, or the name of one channel",
                      found, other, column, row));
    }
    const float cover = alpha(pixel);
    return associated_ && cover > 0 && cover < 1 ? found / cover : found;
  }

 private:
  const ImageFile& image_;
  const Choice& choice_;
  bool associated_;
};

/// A picture's display window, filled by what its data window has of it.
class Placed {
 public:
  Placed(const ImageFile& image, const Choice& choice)
      : choice_(choice),
        pixels_(image, choice),
        from_(choice.facts.data),
        to_(displayWindow(choice.facts)),
        picture_{to_.width, to_.height, {}, {}, integerBits(choice)} {
    const auto count = static_cast<std::size_t>(to_.width) * static_cast<std::size_t>(to_.height);
    const bool covered = to_.x >= from_.x && to_.y >= from_.y && to_.right() <= from_.right() &&
                         to_.below() <= from_.below();
    picture_.values.resize(count, 0.0F);
    if (choice.alpha >= 0 || !covered) picture_.alphas.resize(count, 0.0F);
  }

  /// Rows of the data window, counted from its top.
  template <typename Number>
  void add(const Number* numbers, int top, int rows) {
    std::vector<float> pixel(static_cast<std::size_t>(choice_.count));
    for (int row = top; row < top + rows; ++row) {
      for (int column = 0; column < choice_.facts.data.width; ++column) {
        for (float& value : pixel) value = static_cast<float>(*numbers++);
        place(pixel.data(), std::int64_t{from_.x} + column - to_.x,
              std::int64_t{from_.y} + row - to_.y);
      }
    }
  }

  [[nodiscard]] GreyPicture take() { return std::move(picture_); }

 private:
  void place(const float* pixel, std::int64_t x, std::int64_t y) {
    if (x < 0 || y < 0 || x >= to_.width || y >= to_.height) return;
    const auto target = static_cast<std::size_t>(y * to_.width + x);
    picture_.values[target] = pixels_.value(pixel, x, y);
    if (!picture_.alphas.empty()) picture_.alphas[target] = pixels_.alpha(pixel);
  }

  const Choice& choice_;
  PixelReader pixels_;
  ImageWindow from_, to_;
  GreyPicture picture_;
};

/// The display window is the user's word: it may be larger than the data that the file holds.
void requireWindow(const fs::path& path, const ImageFacts& facts) {
  const ImageWindow to = displayWindow(facts);
  const double pixels = static_cast<double>(to.width) * static_cast<double>(to.height);
  requireMemory(2 * sizeof(float) * pixels, fmt::format("{}: a display window of {} × {} pixels",
                                                        path.string(), to.width, to.height));
}

}  // namespace

GreyPicture readGreyPicture(const fs::path& path, const std::string& channel) {
  ImageFile image(path);
  const ImageFacts facts = image.facts();
  image.requireReadable(0);
  const Choice choice = channel.empty() ? onlyChannel(image, facts) : namedChannel(image, channel);
  image.requireReadable(0);
  requireUpright(image, choice.facts);
  requireWindow(path, choice.facts);
  Placed placed(image, choice);
  const int end = choice.first + choice.count;
  const auto add = [&](const auto* numbers, int top, int rows) { placed.add(numbers, top, rows); };
  if (isPlainInteger(choice)) {
    image.readBands<std::uint32_t>(choice.first, end, NumberType::uint32, add);
  } else {
    image.readBands<float>(choice.first, end, NumberType::float32, add);
  }
  return placed.take();
}

}  // namespace gnomon::image
