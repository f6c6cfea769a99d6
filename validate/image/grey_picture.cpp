#include "image/grey_picture.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

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

/// Goes to the first part with a channel of this name.
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

Choice numberedChannel(const ImageFile& image, int index) {
  const ImageFacts facts = image.facts();
  if (index >= 0 && index < facts.channelCount()) return chosen(facts, {index}, -1);
  image.refuse(
      fmt::format("no channel {}, the image has 0 to {}", index, facts.channelCount() - 1));
}

Choice onlyChannel(const ImageFile& image) {
  const ImageFacts facts = image.facts();
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

int integerBits(const Choice& choice) {
  const std::string& type =
      choice.facts.channelNumbers[static_cast<std::size_t>(choice.colours.front())];
  if (type == "uint8" || type == "int8") return 8;
  return type == "uint16" || type == "int16" ? 16 : 0;
}

/// Fills a picture's display window with one value of each pixel.
class Placed {
 public:
  Placed(const ImageFile& image, const Choice& choice, PictureUse use)
      : image_(image),
        choice_(choice),
        isMask_(use == PictureUse::mask),
        isNoDataRefused_(isRefused(Meaning::noData, use)),
        picture_{
            choice.facts.display.width, choice.facts.display.height, {}, {}, integerBits(choice)} {
    const ImageFacts& facts = choice.facts;
    const auto count =
        static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height);
    const ImageWindow &from = facts.data, &to = facts.display;
    const bool covered = to.x >= from.x && to.y >= from.y && to.right() <= from.right() &&
                         to.below() <= from.below();
    picture_.values.resize(count, 0.0F);
    if (isMask_ && (choice.alpha >= 0 || facts.noData || !covered))
      picture_.alphas.resize(count, 0.0F);
  }

  /// Neighbouring pixels of the picture.
  void add(const float* pixel, int column, int row, int count) {
    std::size_t target = static_cast<std::size_t>(row) * static_cast<std::size_t>(picture_.width) +
                         static_cast<std::size_t>(column);
    for (int x = column; x < column + count; ++x, ++target, pixel += choice_.count) {
      const float value = valueOf(pixel, x, row);
      picture_.values[target] = value;
      const bool isNoData = holdsNoData(choice_.facts, choice_.colours.front(), value);
      if (isNoData && isNoDataRefused_) image_.refuse(noDataSentence(choice_.facts, x, row));
      if (!picture_.alphas.empty()) picture_.alphas[target] = isNoData ? 0 : alphaOf(pixel);
    }
  }

  [[nodiscard]] GreyPicture take() { return std::move(picture_); }

 private:
  [[nodiscard]] float alphaOf(const float* pixel) const {
    return choice_.alpha < 0 ? 1.0F : pixel[choice_.alpha - choice_.first];
  }

  /// @param column, row  of the picture, for the message
  [[nodiscard]] float valueOf(const float* pixel, int column, int row) const {
    const float found = pixel[choice_.colours.front() - choice_.first];
    for (const int colour : choice_.colours) {
      const float other = pixel[colour - choice_.first];
      if (other == found || (std::isnan(found) && std::isnan(other))) continue;
      image_.refuse(
          fmt::format("its channels differ, {} and {} at column {}, row {}: a grey "
                      "picture expected, or {}",
                      found, other, column, row,
                      isMask_ ? "the name of one channel"
                              : "`channel`, the number of the one that holds the heights"));
    }
    const float cover = alphaOf(pixel);
    return !choice_.facts.hasPlainAlpha && cover > 0 && cover < 1 ? found / cover : found;
  }

  const ImageFile& image_;
  const Choice& choice_;
  bool isMask_, isNoDataRefused_;
  GreyPicture picture_;
};

}  // namespace

GreyPicture readGreyPicture(const fs::path& path, const PictureChannel& channel, PictureUse use) {
  ImageFile image(path);
  std::optional<Choice> choice;
  if (!channel.name.empty()) choice = namedChannel(image, channel.name);
  const bool isMask = use == PictureUse::mask;
  requireMeaning(image, use, (isMask ? 2 : 1) * sizeof(float));
  if (!choice) choice = channel.index ? numberedChannel(image, *channel.index) : onlyChannel(image);
  Placed placed(image, *choice, use);
  image.readPlaced(choice->first, choice->first + choice->count,
                   [&](const float* pixels, int column, int row, int count) {
                     placed.add(pixels, column, row, count);
                   });
  return placed.take();
}

}  // namespace gnomon::image
