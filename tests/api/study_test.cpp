#include "gnomon/study.h"

#include <epoxy/egl.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "api/failure_of.h"
#include "render/gl_context.h"
#include "support/columns_study.h"
#include "support/temporary_folder.h"

namespace gnomon::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class ApiStudy : public TemporaryFolder {
 protected:
  /// A small study, with a threshold that fails and a method that comes from a file.
  std::filesystem::path study() {
    std::filesystem::path path = file("small.toml");
    std::ofstream(path) << smallestStudy("small") + R"(
[[light]]
azimuth = 20
elevation = 30
[[method]]
name = "unshadowed"
[[method]]
file = ")" GNOMON_OWN_METHODS R"(/biased-horizon.glsl"
[[threshold]]
method = "biased-horizon"
metric = "error_rate"
max = 0.5
[[threshold]]
method = "unshadowed"
metric = "error_rate"
max = 0.0001
)";
    return path;
  }

  RunOptions options(const std::string& out) {
    RunOptions asked;
    asked.out = file(out);
    asked.cache = false;
    return asked;
  }
};

TEST_F(ApiStudy, GivesTheFiguresOfTheProgram) {
  const RunResult result = runStudy(study(), options("library"));
  EXPECT_EQ(result.summary, file("library/small/summary.json"));
  EXPECT_TRUE(std::filesystem::exists(result.summary));
  const std::string command = GNOMON_PROGRAM " run " + file("small.toml").string() +
                              " --no-cache --out " + file("program").string() + " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string figures = contentOf(file("library/small/metrics.csv"));
  EXPECT_THAT(figures, HasSubstr("biased-horizon"));
  EXPECT_EQ(figures, contentOf(file("program/small/metrics.csv")));
}

TEST_F(ApiStudy, SaysWhichThresholdsFail) {
  const RunResult failing = runStudy(study(), options("out"));
  EXPECT_FALSE(failing.passed);
  ASSERT_THAT(failing.failures, SizeIs(1));
  EXPECT_THAT(failing.failures.front(), AllOf(HasSubstr("unshadowed"), HasSubstr("error_rate")));
  RunOptions lenient = options("out");
  lenient.settings = {"threshold.1.max=0.99"};
  const RunResult passing = runStudy(study(), lenient);
  EXPECT_TRUE(passing.passed);
  EXPECT_TRUE(passing.failures.empty());
}

TEST_F(ApiStudy, TellsHowFarItIsAndCanBeCancelled) {
  struct Cancelled {};
  double furthest = 0;
  RunOptions asked = options("out");
  asked.progress = [&](std::string_view, double share) { furthest = std::max(furthest, share); };
  (void)runStudy(study(), asked);
  EXPECT_EQ(furthest, 1);
  asked.progress = [](std::string_view, double) { throw Cancelled(); };
  EXPECT_THROW((void)runStudy(study(), asked), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(file("out/small/summary.json")));
}

TEST_F(ApiStudy, LeavesTheCallersOpenGlContextCurrent) {
  const render::GlContext gl;
  const EGLContext before = eglGetCurrentContext();
  (void)runStudy(study(), options("out"));
  EXPECT_EQ(eglGetCurrentContext(), before);
}

// The driver is chosen once in a process, so this takes a process of its own.
TEST_F(ApiStudy, SaysThatThereIsNoOpenGl) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto kindWithoutDrivers = [&] {
    ::setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
    ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "", 1);
    try {
      (void)runStudy(study(), options("out"));
    } catch (const Exception& failure) {
      return static_cast<int>(failure.kind());
    }
    return 0;
  };
  EXPECT_EXIT(std::_Exit(kindWithoutDrivers()),
              ::testing::ExitedWithCode(static_cast<int>(FailureKind::noOpenGl)), "");
}

TEST_F(ApiStudy, ReportsFaultsAsItsOwnException) {
  EXPECT_THAT(failureOf([&] { (void)runStudy(file("none.toml"), options("out")); }),
              HasSubstr("none.toml"));
  RunOptions asked = options("out");
  asked.settings = {"relief.hight=3"};
  EXPECT_THAT(failureOf([&] { (void)runStudy(study(), asked); }), HasSubstr("hight"));
}

}  // namespace
}  // namespace gnomon::test
