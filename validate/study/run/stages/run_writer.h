#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/mask.h"
#include "common/visibility.h"
#include "truth/shadow_tracer.h"

namespace gnomon::study {

/// In which size a page embeds a picture: as it is, or as one among many.
enum class EmbeddedSize { full, small };

/// Encodes the pictures of a run and writes their files, each as it is made, so that none has to
/// stay in memory; a cache may hold the encoded bytes. The functions that encode may be called from
/// several threads at once.
class RunWriter {
 public:
  RunWriter() = default;
  RunWriter(const RunWriter&) = delete;
  RunWriter& operator=(const RunWriter&) = delete;
  virtual ~RunWriter() = default;

  /// A mask as data, for other programs.
  [[nodiscard]] virtual std::string mask(const Mask& mask) const = 0;
  /// A map of visibility as data, for other programs.
  [[nodiscard]] virtual std::string shares(const Visibility& map) const = 0;
  /// In which region each sample of a truth lies, in colours that can be read back.
  [[nodiscard]] virtual std::string regions(const truth::Truth& truth) const = 0;
  /// The weight of each sample of an atlas, as sampleWeights gives it: floats hold it exactly.
  [[nodiscard]] virtual std::string weights(int width, int height,
                                            const std::vector<double>& weights) const = 0;
  /// A picture: RGB, 8 bits, row 0 at the top.
  [[nodiscard]] virtual std::string picture(int width, int height,
                                            std::vector<std::uint8_t> rgb) const = 0;
  /// The signed difference: where a candidate is wrong, by false shadow or by false light.
  [[nodiscard]] virtual std::string difference(const Mask& candidate, const Mask& truth) const = 0;
  /// The same of two maps, by how much.
  [[nodiscard]] virtual std::string difference(const Visibility& candidate,
                                               const Visibility& truth) const = 0;
  /// A picture as a page embeds it.
  [[nodiscard]] virtual std::string embedded(int width, int height, std::vector<std::uint8_t> rgb,
                                             EmbeddedSize size) const = 0;
  /// The colours of the displaced surface by its own rays.
  /// @param light  diffuse light per pixel, 0 to 1, -1 for background
  [[nodiscard]] virtual std::vector<std::uint8_t> displaced(
      int width, int height, const std::vector<float>& light) const = 0;
  /// @param path   relative to the run's folder
  /// @param bytes  of one of the above but `embedded`
  virtual void write(const std::string& path, const std::string& bytes) = 0;
  /// Called before times are measured: what goes on beside the run, earlier reports being written,
  /// has ended when it returns.
  virtual void beQuiet() {}
};

}  // namespace gnomon::study
