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

TEST(OwnFiles, ThePrefixIsTheFolderAboveTheProgramsOwn) {
  EXPECT_EQ(installPrefix(), fs::canonical("/proc/self/exe").parent_path().parent_path());
}

}  // namespace
}  // namespace gnomon
