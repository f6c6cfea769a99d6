// Studies that come from a pipe, a redirection or a shell's process substitution.

#include <gmock/gmock.h>

#include <fstream>

#include "common/text/sha256.h"
#include "faults/shell_run.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class StreamedStudy : public EndToEnd {
 protected:
  void SetUp() override {
    fs::create_directories(file("meshes"));
    std::ofstream(file("meshes/square.obj"))
        << "v -16 -16 0\nv 16 -16 0\nv 16 16 0\nv -16 16 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
           "f 1/1 2/2 3/3 4/4\n";
    write("small.toml", studyText());
  }
  static std::string studyText() {
    return replaced(smallStudy(), "shape = \"plane\"\nquads = [4, 4]\nsize = [32, 32]",
                    "mesh = \"meshes/square.obj\"") +
           "\n[[threshold]]\nmethod = \"unshadowed\"\nmax = 0.9\n";
  }
  /// The figures of a run, without what names the study's file and how long it took.
  [[nodiscard]] nlohmann::json figures(const std::string& out) const {
    const nlohmann::json json = summary("small", out);
    return {json.at("results"), json.at("study").at("settings"), json.at("status")};
  }
};

TEST_F(StreamedStudy, IsTheSameStudyAsItsFile) {
  ASSERT_EQ(runShell(folder(), "gnomon run small.toml --out file").status, 0);
  const nlohmann::json expected = figures("file");
  int tried = 0;
  for (const char* command : {
           "gnomon run /dev/stdin --out streamed < small.toml",
           "cat small.toml | gnomon run /dev/stdin --out streamed",
           "gnomon run <(cat small.toml) --out streamed",
           "cat small.toml | gnomon run /proc/self/fd/0 --out streamed",
           "mkfifo fifo; cat small.toml > fifo & gnomon run /dev/stdin --out streamed < fifo",
           "cat small.toml | gnomon check /dev/stdin --out streamed --junit streamed/j.xml",
       }) {
    const Outcome outcome = runShell(folder(), command);
    EXPECT_EQ(outcome.status, 0) << command << outcome.err;
    EXPECT_EQ(outcome.err, "") << command;
    EXPECT_EQ(figures("streamed"), expected) << command;
    const nlohmann::json study = summary("small", "streamed").at("study");
    const auto& input = study.at("inputs").at(0);
    EXPECT_EQ(input.at("file"), study.at("file")) << command;
    EXPECT_EQ(input.at("sha256"), sha256(studyText())) << command;
    // The copy in its folder is a file, which gives the same again.
    if (tried++ == 0) {
      EXPECT_EQ(runShell(folder(), "gnomon run streamed/small/small.toml --out again").status, 0);
      EXPECT_EQ(figures("again").at(0), expected.at(0)) << command;
    }
    for (const char* made : {"streamed", "fifo"}) fs::remove_all(file(made));
  }
  std::printf("faults: %d ways to stream a study, each the same as its file\n", tried);
}

TEST_F(StreamedStudy, MayBeASweep) {
  write("sweep.toml", studyText() + "\n[sweep]\nkey = \"relief.height\"\nvalues = [2, 4]\n");
  const Outcome outcome = runShell(folder(), "cat sweep.toml | gnomon run /dev/stdin");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(file("out/small/2/summary.json")));
  EXPECT_TRUE(fs::exists(file("out/small/4/summary.json")));
}

TEST_F(StreamedStudy, OtherCommandsTakeItToo) {
  for (const char* command : {"bake", "truth", "export"}) {
    const Outcome outcome =
        runShell(folder(), std::string("cat small.toml | gnomon ") + command + " /dev/stdin");
    EXPECT_EQ(outcome.status, 0) << command << outcome.err;
  }
}

TEST_F(StreamedStudy, RefusalsNameTheStream) {
  for (const auto& [command, says] : {
           std::pair("gnomon run /dev/stdin < /dev/null", "/dev/stdin: is a device"),
           std::pair("gnomon run /dev/stdin < /dev/zero", "/dev/stdin: is a device"),
           std::pair("gnomon run /dev/stdin < .", "/dev/stdin: is a folder"),
           // The program opens /dev/null in the place of a closed stream.
           std::pair("gnomon run /dev/stdin <&-", "/dev/stdin: is a device"),
           std::pair("true | gnomon run /dev/stdin", "/dev/stdin:1: study: missing"),
           std::pair("yes | gnomon run /dev/stdin", "/dev/stdin: more than 67.1 MB found"),
           std::pair("echo '[study' | gnomon run /dev/stdin", "/dev/stdin:1:"),
           std::pair("sed s/square/none/ small.toml | gnomon run /dev/stdin",
                     "meshes/none.obj: no such file"),
           // What is read more than once cannot come from a pipe.
           std::pair("cat small.toml | gnomon run small.toml --replace unshadowed=/dev/fd/0.glsl",
                     "/dev/fd/0.glsl: no such file"),
           std::pair("cat small.toml | gnomon view /dev/stdin --screenshot x.png",
                     "/dev/stdin: is a FIFO, a file was expected"),
       }) {
    const Outcome outcome = runShell(folder(), command);
    expectRefused(outcome, command);
    EXPECT_THAT(outcome.err, HasSubstr(says)) << command;
  }
}

}  // namespace
}  // namespace gnomon::test
