#include "viewer/session/shader_watch.h"

#include <algorithm>

#include "render/shader_files.h"

namespace gnomon::app {
namespace fs = std::filesystem;

ShaderWatch::ShaderWatch(fs::path shaders)
    : shaders_(std::move(shaders)), last_(times()), looked_(Clock::now()) {}

ShaderWatch::Times ShaderWatch::times() const {
  Times times;
  const auto add = [&](const fs::path& file) {
    std::error_code error;
    const auto time = fs::last_write_time(file, error);
    if (!error) times.emplace_back(file, time);
  };
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(shaders_, ignored)) {
    if (render::isShader(entry)) add(entry.path());
  }
  for (const fs::path& file : files_) add(file);
  std::sort(times.begin(), times.end());
  return times;
}

void ShaderWatch::watch(std::vector<fs::path> files) {
  if (files == files_) return;
  files_ = std::move(files);
  last_ = times();
}

bool ShaderWatch::changed() {
  constexpr auto pause = std::chrono::milliseconds(500);
  if (Clock::now() - looked_ < pause) return false;
  looked_ = Clock::now();
  Times now = times();
  const bool differ = now != last_;
  last_ = std::move(now);
  return differ;
}

}  // namespace gnomon::app
