#include "study/run/stages/worst_places.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

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

std::vector<std::uint8_t> sampleErrors(const Mask& answer, const Mask& truth) {
  std::vector<std::uint8_t> errors(answer.size());
  std::transform(answer.samples.begin(), answer.samples.end(), truth.samples.begin(),
                 errors.begin(), [](Shade ours, Shade theirs) {
                   const bool bothThere = (ours != Shade::none) & (theirs != Shade::none);
                   return static_cast<std::uint8_t>((ours != theirs) & bothThere);
                 });
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

std::vector<WorstPlace> worstPlaces(std::span<const compare::Window> squares, int width,
                                    const SampleColour& own, const SampleColour& right,
                                    const RunWriter& writer) {
  std::vector<WorstPlace> places;
  for (const compare::Window& window : squares) {
    places.push_back({window.left, window.top, window.side, window.error,
                      embeddedSquare(window, width, own, writer),
                      embeddedSquare(window, width, right, writer)});
  }
  return places;
}

}  // namespace gnomon::study
