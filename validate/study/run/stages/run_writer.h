#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/mask.h"
#include "study/run/scene/environment.h"
#include "study/run/scene/run_scene.h"
#include "study/spec/sections/study_files.h"
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
  /// Called before times are measured: what goes on during the run, earlier reports being written,
  /// has ended when it returns.
  virtual void beQuiet() {}
};

/// Pictures that wait to be encoded, so that all of a panel are at the same time: one alone leaves
/// threads idle.
class EncodingQueue {
 public:
  using Work = std::function<void()>;

  /// @param clock  of the stage "writing"; outlives the queue
  explicit EncodingQueue(StageClock& clock) : clock_(clock) {}

  /// @param encodings  called at any time until `finish` returns, each on any thread: what they
  ///                   refer to stays till then
  /// @param then       called after them on the thread that owns the queue, in the order of `add`
  /// @param waitingBytes  that they hold while they wait: those of too many do not
  void add(std::vector<Work> encodings, Work then, std::size_t waitingBytes = 0);
  /// Does all that waits.
  void finish();

 private:
  StageClock& clock_;
  std::vector<Work> encodings_, after_;
  std::size_t waitingBytes_ = 0;
};

/// What all pictures of a run share: what they show, and where they go.
struct PictureOutput {
  PictureOutput(RunScene& of, RunWriter& to)
      : scene(of), writer(to), queue(of.clock), names(caseNames(of.study)) {}

  RunScene& scene;
  RunWriter& writer;
  EncodingQueue queue;
  CaseNames names;

  /// `FOLDER/VIEW_LIGHT_NAME.png`.
  [[nodiscard]] std::string path(const char* folder, std::size_t view, std::size_t light,
                                 const std::string& name) const {
    return fmt::format("{}/{}_{}_{}.png", folder, names.views[view], names.lights[light], name);
  }
};

}  // namespace gnomon::study
