#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/run_writer.h"

namespace gnomon {

/// Writes the pictures of a run into its folder, as PNG files.
class FolderWriter : public RunWriter {
 public:
  explicit FolderWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void mask(const std::string& path, const Mask& mask) override;
  void shaded(const std::string& path, int width, int height,
              const std::vector<std::uint8_t>& rgb) override;
  void difference(const std::string& path, const Mask& candidate, const Mask& truth) override;
  void displaced(const std::string& path, int width, int height,
                 const std::vector<float>& light) override;

 private:
  std::filesystem::path folder_;
};

}  // namespace gnomon
