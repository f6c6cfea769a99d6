#include "image/picture_meaning.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
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

}  // namespace gnomon::image
