#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/mask.h"
#include "report/image.h"

namespace gnomon {

/// One mesh under one light, shaded with all its samples lit and with all of them shadowed.
struct PictureLayers {
  Image lit;
  Image dark;
};

/// Takes shaded pictures apart. A method decides only whether a pixel is lit: all pictures of one
/// mesh hold, at each pixel, one of two colours. Those two layers and the masks are the pictures,
/// in a fraction of their bytes.
class LayerBuilder {
 public:
  /// Adds a picture to the first mesh that it agrees with at every pixel, or to a new one.
  /// @return the mesh's index
  /// @throws InternalError if picture and mask differ in size
  std::size_t add(const Image& shaded, const Mask& mask);

  /// The layers of all meshes. A colour that no picture shows is that of the pixel to its left:
  /// composing never asks for it.
  [[nodiscard]] std::vector<PictureLayers> layers() const;

 private:
  struct Mesh {
    PictureLayers layers;
    std::vector<std::uint8_t> known;  ///< bit 0: lit is, bit 1: dark is, bit 2: no sample there
  };

  std::vector<Mesh> meshes_;
};

/// A picture of its layers again: dark where the mask is shadowed, lit elsewhere.
Image composed(const PictureLayers& layers, const Mask& mask);

}  // namespace gnomon
