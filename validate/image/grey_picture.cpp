#include "image/grey_picture.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "common/system/memory.h"

namespace gnomon::image {
namespace {

constexpr MeaningCell asStored{Decision::asStored};
constexpr MeaningCell refusal{Decision::refused};

constexpr MeaningCell honoured(std::string_view how) {
  return {Decision::honoured, how};
}

constexpr std::array<MeaningCell, 3> forAll(MeaningCell cell) {
  return {cell, cell, cell};
}

constexpr MeaningCell refusalWithPlace{Decision::refused, "the message names the first"};
constexpr MeaningCell withoutSample = honoured("no sample");

constexpr std::array<MeaningRow, 21> table = {{
    {Meaning::orientation, "an orientation that is not upright (TIFF, Exif in PNG and JPEG, HDR)",
     forAll(refusal)},
    {Meaning::rowOrder, "rows from the bottom, columns from the right (BMP, PFM, TGA)",
     forAll(honoured("turned"))},
    {Meaning::colourModel, "CMYK, CIELAB, LogLuv; in a TIFF without JPEG also YCbCr",
     forAll(refusal)},
    {Meaning::whiteZeroInteger, "white is 0 (TIFF), unsigned integers of 1 to 16 bits",
     forAll(honoured("inverted"))},
    {Meaning::whiteZeroOther, "white is 0 (TIFF), all other numbers: black has no number",
     forAll(refusal)},
    {Meaning::palette, "a palette (PNG, TIFF, BMP)", forAll(honoured("its colours"))},
    {Meaning::fewBits, "integers of 1 to 16 bits, signed or not",
     forAll(honoured("shares of the largest"))},
    {Meaning::wideIntegers, "integers of 32 bits (EXR, TIFF): counts", forAll(asStored)},
    {Meaning::scale, "a scale in the header (PFM)", forAll(honoured("multiplied"))},
    {Meaning::wideFloats, "floats of 64 bits (TIFF)", forAll(honoured("rounded to 32 bits"))},
    {Meaning::otherNumbers, "other numbers: integers of 17 to 31 or over 32 bits, complex ones",
     forAll(refusal)},
    {Meaning::colourSpace,
     "colour space, gamma, exposure, ICC profile, response curve, GDAL's scale and offset",
     forAll(asStored)},
    {Meaning::largerWindow, "pixels outside the display window (EXR, TIFF)",
     forAll(honoured("left out"))},
    {Meaning::smallerWindow,
     "a display window with places that no pixel covers",
     {refusalWithPlace, withoutSample, refusalWithPlace}},
    {Meaning::noData,
     "pixels of no data: GDAL's value (TIFF); without one, -32768 in signed 16 bits",
     {refusalWithPlace, withoutSample, refusalWithPlace}},
    {Meaning::multipliedAlpha,
     "colours multiplied by alpha (EXR, TIFF, TGA)",
     {honoured("divided by it"), honoured("divided by it"), asStored}},
    {Meaning::alpha, "alpha 0, a transparent colour", {asStored, withoutSample, asStored}},
    {Meaning::differentChannels,
     "three channels that differ, none of them named",
     {refusalWithPlace, refusalWithPlace, asStored}},
    {Meaning::parts,
     "pages, parts, levels: several pictures in a file",
     {honoured("the first"), honoured("the first, or the first with the channel named"),
      honoured("the first")}},
    {Meaning::otherPage, "a page that is a reduced copy, or that another page masks (TIFF)",
     forAll(refusal)},
    {Meaning::density, "pixels that are not square, density, place on a page", forAll(asStored)},
}};

static_assert([] {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.at(i).meaning != static_cast<Meaning>(i)) return false;
  }
  return true;
}());

std::string wordsOf(const MeaningCell& cell) {
  const std::string_view decision = cell.decision == Decision::asStored   ? "as stored"
                                    : cell.decision == Decision::honoured ? "honoured"
                                                                          : "refused";
  if (cell.how.empty()) return std::string(decision);
  return fmt::format("{}: {}", decision, cell.how);
}

/// The first place of the display window that the data window does not cover, as column and row.
std::optional<std::pair<std::int64_t, std::int64_t>> uncoveredPlace(const ImageFacts& facts) {
  const auto& [data, display] = std::pair(facts.data, facts.display);
  if (data.y > display.y || data.x > display.x) return std::pair(std::int64_t{0}, std::int64_t{0});
  const auto covered = [](std::int64_t end, int from) {
    return std::max(end - from, std::int64_t{0});
  };
  if (data.right() < display.right())
    return std::pair(covered(data.right(), display.x), std::int64_t{0});
  if (data.below() < display.below())
    return std::pair(std::int64_t{0}, covered(data.below(), display.y));
  return std::nullopt;
}

}  // namespace

const std::array<MeaningRow, 21>& meaningTable() {
  return table;
}

bool isRefused(Meaning meaning, PictureUse use) {
  const MeaningRow& row = table.at(static_cast<std::size_t>(meaning));
  return row.uses.at(static_cast<std::size_t>(use)).decision == Decision::refused;
}

std::string meaningTableText() {
  std::string text =
      "| a picture with | height map | mask | picture of a method |\n|---|---|---|---|\n";
  for (const MeaningRow& row : table) {
    text += fmt::format("| {} | {} | {} | {} |\n", row.name, wordsOf(row.uses[0]),
                        wordsOf(row.uses[1]), wordsOf(row.uses[2]));
  }
  return text;
}

bool holdsNoData(const ImageFacts& facts, int channel, float value) {
  if (!facts.noData) return false;
  const std::string& type = facts.channelNumbers[static_cast<std::size_t>(channel)];
  const float noData = numberOf(*facts.noData, largestOf(type));
  return value == noData || (std::isnan(value) && std::isnan(noData));
}

std::string noDataSentence(const ImageFacts& facts, int column, int row) {
  return fmt::format("pixel ({}, {}) holds {}, which is no data: a number expected in every pixel",
                     column, row, facts.noData.value_or(0));
}

void requireMeaning(const ImageFile& image, PictureUse use, double bytesKept) {
  const ImageFacts facts = image.facts();
  const auto refuse = [&](Meaning meaning, bool isFound, const std::string& sentence) {
    if (isFound && isRefused(meaning, use)) image.refuse(sentence);
  };
  refuse(Meaning::orientation, facts.orientation != 1,
         fmt::format("its Orientation is {}, upright pixels (1) expected: turn the picture",
                     facts.orientation));
  refuse(Meaning::colourModel, !facts.colourModel.empty(),
         fmt::format("colours as {} found, greys or RGB expected", facts.colourModel));
  refuse(Meaning::otherNumbers, !facts.unreadNumbers.empty(),
         fmt::format("{} found; integers of 1 to 16 or of 32 bits, or floats expected",
                     facts.unreadNumbers));
  refuse(Meaning::whiteZeroOther, facts.isWhiteZero,
         "white is 0 in it (PhotometricInterpretation 0), but only unsigned integers of up to 16 "
         "bits have a number for black: black as 0 (1) expected");
  refuse(Meaning::otherPage, !facts.otherPage.empty(),
         fmt::format("{}: one whole picture expected", facts.otherPage));
  const auto uncovered = uncoveredPlace(facts);
  const auto [column, row] = uncovered.value_or(std::pair(0, 0));
  refuse(
      Meaning::smallerWindow, uncovered.has_value(),
      fmt::format("no pixel at column {}, row {} of its display window: its data window, {} × {} "
                  "at ({}, {}), does not cover {} × {} at ({}, {})",
                  column, row, facts.data.width, facts.data.height, facts.data.x, facts.data.y,
                  facts.display.width, facts.display.height, facts.display.x, facts.display.y));
  image.requireReadable(0);
  // The display window is the user's word: it may be larger than the data that the file holds.
  requireMemory(bytesKept * facts.display.width * facts.display.height,
                fmt::format("{}: an image of {} × {} pixels", image.path().string(),
                            facts.display.width, facts.display.height));
}

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
