#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/mask.h"

namespace gnomon {

/// Takes the pictures of a run as they are made, so that none has to be kept. Paths are relative to
/// the run's folder.
class RunWriter {
 public:
  RunWriter() = default;
  RunWriter(const RunWriter&) = delete;
  RunWriter& operator=(const RunWriter&) = delete;
  virtual ~RunWriter() = default;

  /// A mask as data, for other programs.
  virtual void mask(const std::string& path, const Mask& mask) = 0;
  /// A shaded picture: RGB, 8 bits, row 0 at the top.
  virtual void shaded(const std::string& path, int width, int height,
                      const std::vector<std::uint8_t>& rgb) = 0;
  /// Where a candidate errs, and which way.
  virtual void difference(const std::string& path, const Mask& candidate, const Mask& truth) = 0;
  /// The displaced surface by its own rays: diffuse light per pixel, 0 to 1, -1 for background.
  virtual void displaced(const std::string& path, int width, int height,
                         const std::vector<float>& light) = 0;
};

}  // namespace gnomon
