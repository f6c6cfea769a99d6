#include "report/ci/mosaic.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "common/error.h"
#include "image/grey_picture.h"
#include "image/images.h"

namespace gnomon::report {
namespace {

enum Kind : std::size_t { falseShadow, falseLight, bothLit, bothShadowed, none };
using Colours = image::DifferenceColours;
/// Red tells the colours apart.
constexpr std::array<std::pair<std::uint8_t, const char*>, 5> kinds = {{
    {Colours::falseShadow[0], "🟧"},
    {Colours::falseLight[0], "🟦"},
    {Colours::bothLit[0], "⬜"},
    {Colours::bothShadowed[0], "⬛"},
    {Colours::none[0], "🟫"},
}};

std::size_t kindOf(float red, const std::filesystem::path& path) {
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    if (std::lround(255 * red) == kinds[kind].first) return kind;
  }
  throw InputError(fmt::format("{}: a colour found that no signed difference has", path.string()));
}

using Counts = std::array<int, kinds.size()>;

const char* squareOf(const Counts& counts) {
  const int samples =
      counts[falseShadow] + counts[falseLight] + counts[bothLit] + counts[bothShadowed];
  const std::size_t error = counts[falseShadow] >= counts[falseLight] ? falseShadow : falseLight;
  if (samples > 0 && 8 * (counts[falseShadow] + counts[falseLight]) >= samples) {
    return kinds[error].second;
  }
  const auto most = std::max_element(counts.begin(), counts.end());
  return kinds[static_cast<std::size_t>(most - counts.begin())].second;
}

}  // namespace

std::string mosaicOf(const std::filesystem::path& difference, int columns) {
  const image::GreyPicture picture = image::readGreyPicture(difference, "R");
  columns = std::clamp(columns, 1, picture.width);
  const int rows = std::max(1, picture.height * columns / picture.width);
  std::string text;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      Counts counts{};
      for (int y = picture.height * row / rows; y < picture.height * (row + 1) / rows; ++y) {
        for (int x = picture.width * column / columns; x < picture.width * (column + 1) / columns;
             ++x) {
          const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x);
          ++counts.at(kindOf(picture.values[pixel], difference));
        }
      }
      text += squareOf(counts);
    }
    text += '\n';
  }
  return text;
}

}  // namespace gnomon::report
