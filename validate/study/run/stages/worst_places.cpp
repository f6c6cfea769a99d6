#include "study/run/stages/worst_places.h"

#include <cmath>
#include <string>

#include "compare/worst_windows.h"

namespace gnomon::study {
namespace {

std::vector<float> errorsOf(const Visibility& answer, const Visibility& truth) {
  std::vector<float> errors(answer.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const float error = std::abs(answer.shares[i] - truth.shares.at(i));
    errors[i] = std::isnan(error) ? 0 : error;
  }
  return errors;
}

/// A square of a picture as a page embeds it.
std::string embeddedSquare(const compare::Window& window, int width, const SampleColour& colour,
                           const RunWriter& writer) {
  std::vector<std::uint8_t> rgb;
  for (int y = window.top; y < window.top + window.side; ++y) {
    for (int x = window.left; x < window.left + window.side; ++x) {
      const auto found = colour(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x));
      rgb.insert(rgb.end(), found.begin(), found.end());
    }
  }
  return writer.embedded(window.side, window.side, rgb, EmbeddedSize::full);
}

}  // namespace

std::vector<WorstPlace> worstPlaces(const Visibility& answer, const Visibility& truth,
                                    const SampleColour& own, const SampleColour& right,
                                    const RunWriter& writer) {
  std::vector<WorstPlace> places;
  for (const compare::Window& window : compare::worstWindows(
           errorsOf(answer, truth), truth.width, truth.height, worstPlaceSide, mostWorstPlaces)) {
    places.push_back({window.left, window.top, window.side, window.error,
                      embeddedSquare(window, truth.width, own, writer),
                      embeddedSquare(window, truth.width, right, writer)});
  }
  return places;
}

}  // namespace gnomon::study
