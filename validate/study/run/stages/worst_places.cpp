#include "study/run/stages/worst_places.h"

#include <cmath>
#include <string>
#include <utility>

#include "compare/worst_windows.h"

namespace gnomon::study {
namespace {

/// A square of a picture as a page embeds it.
std::string embeddedSquare(const compare::Window& window, int width, const SampleColour& colour,
                           const RunWriter& writer) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * static_cast<std::size_t>(window.side) * static_cast<std::size_t>(window.side));
  for (int y = window.top; y < window.top + window.side; ++y) {
    for (int x = window.left; x < window.left + window.side; ++x) {
      const auto found = colour(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x));
      rgb.insert(rgb.end(), found.begin(), found.end());
    }
  }
  return writer.embedded(window.side, window.side, std::move(rgb), EmbeddedSize::full);
}

}  // namespace

std::vector<float> sampleErrors(const Mask& answer, const Mask& truth) {
  std::vector<float> errors(answer.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const Shade ours = answer.samples[i];
    const Shade theirs = truth.samples.at(i);
    const bool isWrong = ours != theirs && ours != Shade::none && theirs != Shade::none;
    errors[i] = isWrong ? 1 : 0;
  }
  return errors;
}

std::vector<float> sampleErrors(const Visibility& answer, const Visibility& truth) {
  std::vector<float> errors(answer.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const float error = std::abs(answer.shares[i] - truth.shares.at(i));
    errors[i] = std::isnan(error) ? 0 : error;
  }
  return errors;
}

std::vector<WorstPlace> worstPlaces(const std::vector<float>& errors, int width, int height,
                                    const SampleColour& own, const SampleColour& right,
                                    const RunWriter& writer) {
  std::vector<WorstPlace> places;
  for (const compare::Window& window :
       compare::worstWindows(errors, width, height, worstPlaceSide, mostWorstPlaces)) {
    places.push_back({window.left, window.top, window.side, window.error,
                      embeddedSquare(window, width, own, writer),
                      embeddedSquare(window, width, right, writer)});
  }
  return places;
}

}  // namespace gnomon::study
