#include "common/system/own_files.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

// The library's own answers are tested where it is installed (tests/install).
TEST(OwnFiles, AProgramIsItsOwnFile) {
  EXPECT_TRUE(fs::equivalent(ownFile(), "/proc/self/exe"));
  EXPECT_TRUE(fs::equivalent(ownProgram(), "/proc/self/exe"));
}

TEST(OwnFiles, TheFolderIsTheProgramsOwn) {
  EXPECT_EQ(ownFolder(), fs::canonical("/proc/self/exe").parent_path());
}

/// A folder beside the test program, removed at the end.
class InstalledPath : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(near / "share/what"); }
  void TearDown() override {
    fs::remove_all(near / "share/what");
    fs::remove_all(far / "share/what");
  }
  const fs::path near = ownFolder();
  const fs::path far = ownFolder().parent_path();
};

TEST_F(InstalledPath, IsTheNearestAboveThisCode) {
  fs::create_directories(far / "share/what");
  EXPECT_EQ(installedPath("share/what"), near / "share/what");
  fs::remove_all(near / "share/what");
  EXPECT_EQ(installedPath("share/what"), far / "share/what");
  fs::remove_all(far / "share/what");
  EXPECT_EQ(installedPath("share/what"), std::nullopt);
}

TEST_F(InstalledPath, HasItsLinksResolved) {
  fs::create_directories(far / "share/what/target");
  fs::create_directory_symlink(far / "share/what/target", near / "share/what/link");
  EXPECT_EQ(installedPath("share/what/link"), far / "share/what/target");
}

}  // namespace
}  // namespace gnomon
