#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "report/run_folder.h"
#include "study/run/stages/run_writer.h"

namespace gnomon::report {

/// Writes the pictures of a run into its folder, as PNG files; what a page embeds is WebP.
class FolderWriter : public study::RunWriter {
 public:
  /// @param folder  outlives the writer
  /// @param quiet   waits for what goes on beside the run
  explicit FolderWriter(RunFolder& folder, std::function<void()> quiet = {})
      : folder_(folder), quiet_(std::move(quiet)) {}

  [[nodiscard]] std::string mask(const Mask& mask) const override;
  [[nodiscard]] std::string shares(const Visibility& map) const override;
  [[nodiscard]] std::string regions(const truth::Truth& truth) const override;
  [[nodiscard]] std::string weights(int width, int height,
                                    const std::vector<double>& weights) const override;
  [[nodiscard]] std::string picture(int width, int height,
                                    std::vector<std::uint8_t> rgb) const override;
  [[nodiscard]] std::string difference(const Mask& candidate, const Mask& truth) const override;
  [[nodiscard]] std::string difference(const Visibility& candidate,
                                       const Visibility& truth) const override;
  [[nodiscard]] std::string embedded(int width, int height, std::vector<std::uint8_t> rgb,
                                     study::EmbeddedSize size) const override;
  [[nodiscard]] std::vector<std::uint8_t> displaced(int width, int height,
                                                    const std::vector<float>& light) const override;
  void write(const std::string& path, const std::string& bytes) override;
  void beQuiet() override;

 private:
  RunFolder& folder_;
  std::function<void()> quiet_;
};

}  // namespace gnomon::report
