#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

namespace gnomon::app {

/// Notices that a shader's file has changed, by its time, twice a second at most.
class ShaderWatch {
 public:
  explicit ShaderWatch(std::filesystem::path shaders);

  /// Also these files, wherever they are: methods of the person's own.
  void watch(std::vector<std::filesystem::path> files);
  /// Whether a file has changed, come or gone since the last call.
  bool changed();

 private:
  using Clock = std::chrono::steady_clock;
  using Times = std::vector<std::pair<std::filesystem::path, std::filesystem::file_time_type>>;
  [[nodiscard]] Times times() const;

  std::filesystem::path shaders_;
  std::vector<std::filesystem::path> files_;
  Times last_;
  Clock::time_point looked_;
};

}  // namespace gnomon::app
