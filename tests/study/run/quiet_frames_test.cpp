#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <vector>

#include "cache/cache.h"
#include "render/gl_context.h"
#include "study/run/no_files.h"
#include "study/run/run_study.h"
#include "study/spec/study_file.h"
#include "support/columns_study.h"
#include "support/temporary_folder.h"

namespace gnomon::study {
namespace {

/// What a run asks of its writer, in order.
class Asked : public NoFiles {
 public:
  void write(const std::string&, const std::string&) override { all.emplace_back("write"); }
  void beQuiet() override { all.emplace_back("quiet"); }

  std::vector<std::string> all;
};

class QuietFrames : public TemporaryFolder {
 protected:
  std::vector<std::string> askedWith(const char* frames) {
    std::ofstream(file("s.toml")) << test::smallestStudy("s")
                                  << "\n[[light]]\nelevation = 30\n"
                                     "\n[[method]]\nname = \"max-forsyth\"\n";
    StudyOptions options;
    options.overrides = {std::string("study.frames=") + frames};
    const render::GlContext gl;
    cache::Cache none;
    SceneStore store;
    Asked writer;
    (void)runStudy(readStudy(file("s.toml"), options), gl, writer, none, store);
    return writer.all;
  }
};

/// The frame that draws the answers may be among those timed: what goes on beside the run has ended
/// before, not only before further frames.
TEST_F(QuietFrames, AreThoseThatDrawTheAnswersToo) {
  const std::vector<std::string> asked = askedWith("1");
  ASSERT_GT(asked.size(), 3U);
  EXPECT_EQ(asked.front(), "quiet");
  EXPECT_THAT(asked, testing::Contains("write"));
  EXPECT_THAT(askedWith("0"), testing::Each("write"));
}

}  // namespace
}  // namespace gnomon::study
