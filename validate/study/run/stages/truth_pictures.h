#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/mask.h"
#include "compare/worst_windows.h"
#include "study/record/record.h"
#include "study/run/scene/base_case.h"
#include "study/run/scene/truth_stage.h"
#include "study/run/stages/run_writer.h"

namespace gnomon::study {

/// What tells the truth at the samples of a mesh, as files: its mask, its regions as
/// `regions/VIEW_LIGHT_truth.png`, where the path to the light crosses a seam, and the weights of
/// an atlas's samples as `regions/VIEW_weights.exr`. For a method whose mesh has other samples than
/// the standard base, `truth` becomes `truth_displaced-9`, after the mesh's pieces a side.
class TruthPictures {
 public:
  /// @param output  outlives this
  explicit TruthPictures(PictureOutput& output) : output_(output) {}

  /// How file names call the truth at a mesh's samples: `truth` where they are the standard base's.
  [[nodiscard]] std::string nameOf(const BaseCase& base, std::size_t view, std::size_t light) const;

  /// Puts the files into the queue, but for the mask of the standard base's truth: that is written
  /// with its shading.
  /// @returns their paths
  TruthFilesRecord queue(std::size_t view, std::size_t light, const BaseCase& base);

 private:
  /// Writes the weights of an atlas's samples, once: they are the same under all lights and on all
  /// meshes.
  /// @returns the file; empty for a camera
  std::string writeWeights(std::size_t view);

  PictureOutput& output_;
  std::set<std::size_t> viewsWithWeights_;  ///< whose file is written
};

/// The displaced surface by its own rays, in every camera view under every light:
/// `images/VIEW_LIGHT_displaced.png`.
class DisplacedPictures {
 public:
  /// @param output  outlives this
  explicit DisplacedPictures(PictureOutput& output) : output_(output) {}

  /// Traces them, where the cache does not have them, and puts them into the queue.
  void queue(SurfaceOnDemand& surface);

  /// As a page embeds one, once the queue is finished; null where there is none.
  [[nodiscard]] const std::string* embedded(std::size_t view, std::size_t light) const;

 private:
  /// Diffuse light per pixel, 0 to 1, -1 for background.
  std::vector<float> trace(std::size_t view, std::size_t light, const Camera& camera,
                           const TracedSurface& traced);
  void queue(std::size_t view, std::size_t light, const Camera& camera, SurfaceOnDemand& surface);

  PictureOutput& output_;
  std::map<std::pair<std::size_t, std::size_t>, std::string> embedded_;  ///< by view and light
};

/// Of the squares: their sides, in samples, and their number at most.
constexpr int worstPlaceSide = 64;
constexpr std::size_t mostWorstPlaces = 3;

/// The colour of a sample in a picture, RGB, by its place in the map.
using SampleColour = std::function<std::array<std::uint8_t, 3>(std::size_t)>;

/// How far an answer is off the truth at each sample: 0 or 1, and 0 where there is no sample.
std::vector<std::uint8_t> sampleErrors(const Mask& answer, const Mask& truth);
/// The same under a light with a disc: |ΔV|.
std::vector<float> sampleErrors(const Visibility& answer, const Visibility& truth);

/// The squares where an answer errs most, none that overlap: see compare::worstWindows.
template <typename Map>
std::vector<compare::Window> worstSquares(const Map& answer, const Map& truth) {
  const auto errors = sampleErrors(answer, truth);
  return compare::worstWindows(std::span(errors), answer.width, answer.height, worstPlaceSide,
                               mostWorstPlaces);
}

/// The same squares as a page shows them.
/// @param width       of the view
/// @param own, right  what pictures of the answer and of the truth show there
std::vector<WorstPlace> worstPlaces(std::span<const compare::Window> squares, int width,
                                    const SampleColour& own, const SampleColour& right,
                                    const RunWriter& writer);

}  // namespace gnomon::study
