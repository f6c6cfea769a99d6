#include <gmock/gmock.h>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class ImageModule : public EndToEnd {
 protected:
  /// Expects status 4 and one line that tells what is missing.
  void expectNoImages(const std::string& module, const std::string& reason) {
    write("small.toml", smallStudy());
    const Outcome outcome =
        gnomon({"bake", "small.toml"}, {"GNOMON_IMAGE_MODULE=" + (folder() / module).string()});
    EXPECT_EQ(outcome.status, 4);
    EXPECT_THAT(outcome.err, AllOf(StartsWith("gnomon: no image can be read or written"),
                                   HasSubstr(module), HasSubstr(reason)));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(filesBelow("out").empty());
  }
};

TEST_F(ImageModule, ThatCannotBeLoadedIsAnErrorOfOneLine) {
  write("text.so", "not a library");
  expectNoImages("missing.so", "cannot open");
  expectNoImages("text.so", "cannot be loaded");
}

TEST_F(ImageModule, OfAnotherBuildIsRefusedInOneLine) {
  expectNoImages(GNOMON_OTHER_IMAGE_MODULE, "version of another day found");
  expectNoImages(GNOMON_OLDER_IMAGE_MODULE, "version none found");
}

TEST_F(ImageModule, IsNotNeededForWhatReadsNoImage) {
  const std::vector<std::string> none = {"GNOMON_IMAGE_MODULE=/nonexistent"};
  EXPECT_EQ(gnomon({"--help"}, none).status, 0);
  EXPECT_EQ(gnomon({"list"}, none).status, 0);
  EXPECT_EQ(gnomon({"cache"}, none).status, 0);
  EXPECT_EQ(gnomon({"run", "missing.toml"}, none).status, 3);
}

TEST_F(ImageModule, IsNotNeededForARunThatReadsNoImage) {
  write("small.toml", smallStudy());
  const Outcome outcome = gnomon({"run", "small.toml"}, {"GNOMON_IMAGE_MODULE=/nonexistent"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(file("out/small/report.html")));
}

// The loader lists what it would load in place of running the program.
TEST_F(ImageModule, AloneLinksOpenImageIO) {
  EXPECT_THAT(gnomon({}, {"LD_TRACE_LOADED_OBJECTS=1"}).out,
              AllOf(HasSubstr("libstdc++"), Not(HasSubstr("libOpenImageIO"))));
}

}  // namespace
}  // namespace gnomon::test
