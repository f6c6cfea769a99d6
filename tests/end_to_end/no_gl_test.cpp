#include <gmock/gmock.h>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class NoGl : public EndToEnd {
 protected:
  /// Expects status 77 and one line that tells what is missing.
  void expectNoGl(const std::vector<std::string>& environment, const std::string& reason) {
    write("small.toml", smallStudy());
    const Outcome outcome = gnomon({"run", "small.toml"}, environment);
    EXPECT_EQ(outcome.status, 77);
    EXPECT_THAT(outcome.err, StartsWith("gnomon: no OpenGL"));
    EXPECT_THAT(outcome.err, HasSubstr(reason));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(filesBelow("out").empty());
  }
  void requireMesa() {
    runStudy("probe", replaced(smallStudy(), "\"small\"", "\"probe\""), {"--out", "probe"});
    const std::string version = summary("probe", "probe").at("environment").at("gl_version");
    if (version.find("Mesa") == std::string::npos) GTEST_SKIP() << "not Mesa: " << version;
  }
};

TEST_F(NoGl, WithoutAVendorsDriver) {
  expectNoGl({"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent", "__EGL_VENDOR_LIBRARY_FILENAMES="},
             "surfaceless platform: not offered");
}

TEST_F(NoGl, WithoutTheEglLibrary) {
  write("libEGL.so.1", "not a library");
  expectNoGl({"LD_LIBRARY_PATH=" + folder().string()}, "libEGL.so.1 cannot be loaded");
}

TEST_F(NoGl, WithoutTheGlLibrary) {
  write("libGL.so.1", "not a library");
  write("libOpenGL.so.0", "not a library");
  expectNoGl({"LD_LIBRARY_PATH=" + folder().string()}, "neither libGL.so.1 nor libOpenGL.so.0");
}

TEST_F(NoGl, WithADriverThatCannotBeLoaded) {
  requireMesa();
  if (IsSkipped()) return;
  expectNoGl({"GALLIUM_DRIVER=nosuch"}, "cannot be initialised");
}

TEST_F(NoGl, WithADriverThatIsTooOld) {
  requireMesa();
  if (IsSkipped()) return;
  expectNoGl({"MESA_GL_VERSION_OVERRIDE=4.3"}, "has no OpenGL 4.5 core");
}

TEST_F(NoGl, IsNotNeededForWhatDrawsNothing) {
  write("small.toml", smallStudy());
  const std::vector<std::string> none = {"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent"};
  EXPECT_EQ(gnomon({"list"}, none).status, 0);
  EXPECT_EQ(gnomon({"bake", "small.toml"}, none).status, 0);
  EXPECT_EQ(gnomon({"run", "missing.toml"}, none).status, 3) << "input is checked first";
}

}  // namespace
}  // namespace gnomon::test
