#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/mask.h"
#include "common/visibility.h"
#include "study/run/stages/run_writer.h"
#include "truth/shadow_tracer.h"

namespace gnomon::study {

/// Pixels of 8 bits: red, green and blue, row by row, row 0 at the top.
using RgbPixels = std::vector<std::uint8_t>;

/// An answer as its pictures show it: a mask, and under a light with a disc the shares in its
/// place.
struct ShownAnswer {
  const Mask& mask;
  const Visibility& shares;

  [[nodiscard]] bool isSoft() const { return shares.size() > 0; }
};
ShownAnswer shownOf(const truth::Truth& truth);

/// A mesh as shade.frag draws it: with all its samples lit, and with all of them shadowed.
struct MeshColours {
  RgbPixels lit;
  std::shared_ptr<const RgbPixels> dark;
};

/// An answer's shading: `dark` where the sample is shadowed, else `lit`; by a share V of light the
/// colour in linear light, (dark^2.2 + V (lit^2.2 - dark^2.2))^(1 / 2.2).
RgbPixels shadingOf(const MeshColours& colours, const ShownAnswer& shown);
/// The same of one sample.
std::array<std::uint8_t, 3> shadingAt(const MeshColours& colours, const ShownAnswer& shown,
                                      std::size_t sample);

/// The grey of a sample in the picture of an answer's mask: white is lit.
std::array<std::uint8_t, 3> maskGrey(const ShownAnswer& shown, std::size_t sample);

/// The bytes of an answer's mask, or of its map of visibility.
std::string maskFile(const RunWriter& writer, const ShownAnswer& shown);
/// The bytes of its signed difference from the truth.
std::string differenceFile(const RunWriter& writer, const ShownAnswer& shown,
                           const ShownAnswer& truth);

}  // namespace gnomon::study
