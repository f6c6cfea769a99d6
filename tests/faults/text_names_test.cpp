// Names of files and folders that are no UTF-8: a study, its mesh, picture and method, and the
// folders of results. Everything runs, is kept, is read again, and is UTF-8.

#include <gmock/gmock.h>

#include <fstream>

#include "faults/shell_run.h"
#include "model/saved_study.h"
#include "study/spec/study_file.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

/// "café" in Latin 1.
const std::string cafe = "caf\xE9";

class NamesThatAreNoText : public EndToEnd {
 protected:
  void SetUp() override {
    fs::create_directories(file(cafe));
    std::ofstream(file(cafe) / (cafe + ".toml"))
        << replaced(smallStudy(), "name = \"unshadowed\"",
                    "file = \"file:caf%E9.glsl\"\nlabel = \"own\"")
        << "\n[[threshold]]\nmethod = \"own\"\nmax = 0.9\n";
    fs::copy(fs::path(GNOMON_SCENES) / "../shaders/methods/unshadowed.glsl",
             file(cafe) / (cafe + ".glsl"));
    write("small.toml", smallStudy());
  }
};

TEST_F(NamesThatAreNoText, AreRunKeptAndRunAgain) {
  const std::string study = "$'caf\\xe9/caf\\xe9.toml'";
  for (const std::string& command : {
           "gnomon run " + study + " --out $'out\\xe9'",
           "gnomon run " + study + " --out out",
           std::string("gnomon run small.toml --replace unshadowed=$'caf\\xe9/caf\\xe9.glsl' "
                       "--out out"),
           "gnomon check " + study +
               " --out out --baseline $'refs\\xe9' --update-baseline "
               "--reason x --junit out/j.xml",
           "gnomon export " + study + " --out out",
           "gnomon view " + study + " --out out --screenshot $'out/\\xe9.png'",
       }) {
    const Outcome outcome = runShell(folder(), command);
    EXPECT_EQ(outcome.status, 0) << command << outcome.err;
    const fs::path copy = file("out/small/small.toml");
    if (fs::exists(copy)) {
      const nlohmann::json first = summary("small").at("results");
      const Outcome again = runShell(folder(), "gnomon run out/small/small.toml --out again");
      EXPECT_EQ(again.status, 0) << command << again.err;
      EXPECT_EQ(summary("small", "again").at("results"), first) << command;
    }
    fs::remove_all(file("again"));
    fs::remove_all(file("out"));
  }
}

TEST_F(NamesThatAreNoText, AreSavedFromTheViewer) {
  const fs::path study = file(cafe) / (cafe + ".toml");
  app::StudyState state;
  state.file = study;
  const study::StudySpec opened = study::readStudy(study);
  for (const fs::path& target :
       {file("saved.toml"), file(cafe) / "saved.toml", file("b\xFF/" + cafe + ".toml")}) {
    app::saveStudy(state, target);
    const study::StudySpec saved = study::readStudy(target);
    ASSERT_EQ(saved.methods.size(), opened.methods.size());
    EXPECT_TRUE(fs::equivalent(saved.methods[0].file, opened.methods[0].file));
    EXPECT_EQ(saved.methods[0].label, "own");
  }
}

TEST_F(NamesThatAreNoText, AMethodIsLabelledByWhatCanBeWritten) {
  study::StudyOptions options;
  write("own.toml",
        replaced(smallStudy(), "name = \"unshadowed\"", "file = \"file:caf%E9/caf%E9.glsl\""));
  const study::StudySpec study = study::readStudy(file("own.toml"));
  EXPECT_EQ(study.methods.at(0).label, "caf%E9");
  EXPECT_TRUE(fs::equivalent(study.methods.at(0).file, file(cafe) / (cafe + ".glsl")));
}

}  // namespace
}  // namespace gnomon::test
