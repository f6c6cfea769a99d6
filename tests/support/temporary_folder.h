#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

namespace gnomon {

/// A folder of a test's own that goes when the test ends.
class TemporaryFolder : public ::testing::Test {
 protected:
  TemporaryFolder() : folder_(made()), isOwn_(true) {}
  /// A test in a folder that others made, which stays.
  explicit TemporaryFolder(std::filesystem::path shared) : folder_(std::move(shared)) {}
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() override {
    if (isOwn_) std::filesystem::remove_all(folder_);
  }
  static std::filesystem::path made() {
    std::string name = (std::filesystem::temp_directory_path() / "gnomon-XXXXXX").string();
    return ::mkdtemp(name.data());
  }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// A message with its files named as they are in the folder, since that is another each time.
  [[nodiscard]] std::string withoutFolder(std::string message) const {
    const std::string prefix = folder_.string() + "/";
    for (std::size_t at = 0; (at = message.find(prefix)) != std::string::npos;) {
      message.erase(at, prefix.size());
    }
    return message;
  }

 private:
  std::filesystem::path folder_;
  bool isOwn_ = false;
};

}  // namespace gnomon
