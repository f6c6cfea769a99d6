#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "study/record/record.h"
#include "study/run/scene/base_case.h"
#include "study/run/stages/picture_output.h"

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

}  // namespace gnomon::study
