#include "viewer/session/study_opener.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "app/viewer/viewed_study.h"

namespace gnomon::app {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::StartsWith;

class StudyOpenerTest : public ViewedStudy {
 protected:
  [[nodiscard]] cli::ViewRequest request() const {
    cli::ViewRequest asked;
    asked.study = study();
    return asked;
  }
  static StudyOpener::Answer answerOf(StudyOpener& opener) {
    for (int i = 0; i < 15000; ++i) {
      if (auto answer = opener.take()) return std::move(*answer);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return {std::nullopt, "no answer"};
  }
};

TEST_F(StudyOpenerTest, ListsThoseOfTheCommandLineAndOfTheFolderOnce) {
  for (const char* name : {"b.toml", "a.toml", "notes.txt"}) std::ofstream(file(name)) << "x";
  cli::ViewRequest asked = request();
  asked.others = {"elsewhere/far.toml", file("b.toml"), asked.study};
  EXPECT_THAT(studiesBeside(asked),
              ElementsAre(study(), "elsewhere/far.toml", file("b.toml"), file("a.toml")));
}

TEST_F(StudyOpenerTest, ReadsAStudyWithTheOptionsOfTheOneBefore) {
  fs::copy(study(), file("other.toml"));
  cli::ViewRequest asked = request();
  asked.options.overrides = {"light.0.elevation=12"};
  asked.show = {"ellipse"};
  const OpenedStudy first = openStudy(asked);
  std::atomic<int> woken = 0;
  StudyOpener opener([&] { ++woken; });
  EXPECT_FALSE(opener.take());
  opener.open(file("other.toml"), first.request);
  opener.open(file("nothing.toml"), first.request);  // too early: the first is being read
  EXPECT_EQ(opener.opening(), "other.toml");
  const StudyOpener::Answer answer = answerOf(opener);
  ASSERT_TRUE(answer.study) << answer.error;
  EXPECT_EQ(woken, 1);
  EXPECT_EQ(opener.opening(), "");
  EXPECT_EQ(answer.study->request.study, file("other.toml"));
  EXPECT_TRUE(answer.study->request.show.empty());
  EXPECT_THAT(answer.study->request.others, ElementsAre(study()));
  EXPECT_EQ(answer.study->labels, first.labels) << "the built-in methods are there once";
  EXPECT_NEAR(answer.study->study->lights.front().elevation * 180 / pi, 12, 1e-9);
}

TEST_F(StudyOpenerTest, TellsInOneLineWhyAStudyIsNone) {
  std::ofstream(file("bad.toml")) << "[study]\nname = \n";
  StudyOpener opener([] {});
  for (const char* name : {"bad.toml", "missing.toml", "."}) {
    opener.open(file(name), request());
    const StudyOpener::Answer answer = answerOf(opener);
    EXPECT_FALSE(answer.study) << name;
    EXPECT_THAT(answer.error, StartsWith(file(name).string()));
    EXPECT_EQ(std::count(answer.error.begin(), answer.error.end(), '\n'), 0) << answer.error;
  }
}

}  // namespace
}  // namespace gnomon::app
