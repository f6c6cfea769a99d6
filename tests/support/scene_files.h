#pragma once

#include <filesystem>
#include <vector>

namespace gnomon::test {

/// The study files that come with the program.
/// @param scenes  their folder
inline std::vector<std::filesystem::path> sceneFiles(const std::filesystem::path& scenes) {
  std::vector<std::filesystem::path> files;
  for (const auto& folder : {scenes, scenes / "bodies"}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
    }
  }
  return files;
}

}  // namespace gnomon::test
