#include "viewer/session/first_view.h"

#include <gtest/gtest.h>

#include "app/viewer/viewed_study.h"
#include "common/error.h"
#include "common/files/atomic_file.h"
#include "support/replaced.h"

namespace gnomon::app {
namespace {

using Contents = std::vector<std::string>;

class FirstView : public ViewedStudy {
 protected:
  [[nodiscard]] cli::ViewRequest request() const {
    cli::ViewRequest asked;
    asked.study = study();
    return asked;
  }
  void addMethod(const std::string& keys) const {
    std::ofstream(study(), std::ios::app) << "[[method]]\n" << keys << "\n";
  }
  /// The study with other methods in place of its own.
  void writeMethods(const std::string& methods) const {
    const std::string text = readFile(study());
    std::ofstream(study()) << text.substr(0, text.find("[[method]]")) << methods;
  }
  static Contents shown(const ViewState& state) {
    Contents contents;
    for (int i = 0; i < state.paneCount; ++i) {
      contents.push_back(contentText(state.panes.at(static_cast<std::size_t>(i))));
    }
    return contents;
  }
};

TEST_F(FirstView, IsTheStudysFirstMethodBesideTheTruth) {
  EXPECT_EQ(shown(firstView(openStudy(request()))), (Contents{"max-forsyth", "truth"}));
  cli::ViewRequest asked = request();
  asked.show = {"ellipse"};
  EXPECT_EQ(shown(firstView(openStudy(asked))), Contents{"ellipse"}) << "options say otherwise";
}

TEST_F(FirstView, AScreenshotReplacesNothingThatTheStudyReads) {
  const std::string before = readFile(study());
  cli::ViewRequest asked = request();
  asked.screenshot = study();
  EXPECT_THROW((void)openStudy(asked), UsageError);
  EXPECT_EQ(readFile(study()), before);
}

TEST_F(FirstView, PassesOverTheControlWhereThereIsAnotherMethod) {
  const std::string control = "[[method]]\nname = \"unshadowed\"\nlabel = \"none at all\"\n";
  writeMethods(control + "[[method]]\nname = \"ellipse\"\n[[method]]\nname = \"max-forsyth\"\n");
  EXPECT_EQ(firstMethod(openStudy(request())), "ellipse");
  // Alone it is looked at: the methods that the program adds are not the study's own.
  writeMethods(control);
  const OpenedStudy alone = openStudy(request());
  EXPECT_EQ(firstMethod(alone), "none at all");
  EXPECT_EQ(alone.ownCount, 1U);
  EXPECT_GT(alone.labels.size(), 10U);
}

TEST_F(FirstView, TakesTheRectangleFromTheOptions) {
  cli::ViewRequest asked = request();
  asked.rectangle = {25, 20, 75, 70};
  EXPECT_EQ(firstView(openStudy(asked)).part, (ViewPart{0.25, 0.2, 0.75, 0.7}));
  for (const std::vector<double>& wrong :
       {std::vector<double>{75, 20, 25, 70}, {0, 0, 101, 50}, {-1, 0, 50, 50}, {0, 0, 0, 50}}) {
    asked.rectangle = wrong;
    EXPECT_THROW((void)firstView(openStudy(asked)), UsageError);
  }
}

}  // namespace
}  // namespace gnomon::app
