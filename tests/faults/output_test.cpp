#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>

#include "faults/shell_run.h"
#include "support/lines.h"
#include "support/test_length.h"

// Output that is lost is a failure: no command ends with exit status 0 or dies of a signal while
// its output does not arrive, and it says so in one line, where that can be written; but not where
// the reader has closed the pipe.

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class LostOutput : public EndToEnd {
 protected:
  LostOutput() {
    write("small.toml", smallStudy() + "\n[[threshold]]\nmax = 0.9\n");
    write("mask.pgm", "P5\n2 1\n255\n" + std::string("\xff\0", 2));
  }
  [[nodiscard]] Outcome shell(const std::string& script) const {
    return runShell(folder(), script, {"sh", 600, true});
  }
};

constexpr const char* commands[] = {"list",
                                    "--help",
                                    "run --help",
                                    "--version",
                                    "cache",
                                    "compare mask.pgm mask.pgm",
                                    "compare mask.pgm mask.pgm --json -",
                                    "bake small.toml",
                                    "truth small.toml",
                                    "check small.toml",
                                    "check small.toml --github",
                                    "run small.toml"};

TEST_F(LostOutput, IsAFailureOfEveryCommand) {
  int tried = 0;
  for (const char* command : commands) {
    const std::string whole = std::string("\"$gnomon\" ") + command;
    EXPECT_EQ(shell(whole + " >/dev/null").status, 0) << command;
    // The reader goes before anything can be written: as `| head` does, who knows that it did.
    const std::string closed = "mkfifo pipe; exec 3<>pipe; exec 4>pipe; exec 3<&-; " + whole +
                               " >&4; status=$?; rm pipe; exit $status";
    const Outcome unread = shell(closed);
    EXPECT_EQ(unread.status, 3) << closed;
    EXPECT_EQ(unread.err, "") << closed;
    for (const std::string& script : {whole + " >/dev/full", whole + " >&-"}) {
      const Outcome outcome = shell(script);
      EXPECT_EQ(outcome.status, 3) << script << "\n" << outcome.err;
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
      EXPECT_THAT(outcome.err, StartsWith("gnomon: standard output: cannot be written: "))
          << script;
      ++tried;
    }
  }
  std::printf("faults: %d lost outputs noticed\n", tried);
}

TEST_F(LostOutput, OnStandardErrorChangesNoStatusButAPass) {
  for (const char* error : {"2>/dev/full", "2>&-"}) {
    const auto status = [&](const std::string& command) {
      return shell("\"$gnomon\" " + command + " >/dev/null " + error).status;
    };
    EXPECT_EQ(status("list"), 0) << "nothing was lost";
    EXPECT_EQ(status("check small.toml"), 0) << "nothing was lost";
    EXPECT_EQ(status("nonsense"), 2);
    EXPECT_EQ(status("check missing.toml"), 3);
    EXPECT_EQ(status("run missing.toml"), 3);
    EXPECT_EQ(status("compare mask.pgm missing.pgm"), 3);
    EXPECT_EQ(status("check small.toml --set threshold.0.max=1e-9"), 1);
    // A cache that cannot be written is one line of warning, which is lost here.
    const std::string cache = "GNOMON_CACHE=/dev/null/nowhere \"$gnomon\" check small.toml ";
    EXPECT_EQ(shell(cache + ">/dev/null").status, 0);
    EXPECT_EQ(shell(cache + ">/dev/null " + error).status, 3) << error;
  }
}

TEST_F(LostOutput, OnBothIsAFailureStill) {
  EXPECT_EQ(shell("\"$gnomon\" check small.toml >/dev/full 2>&1").status, 3);
  EXPECT_EQ(shell("\"$gnomon\" check small.toml >&- 2>&- <&-").status, 3);
  EXPECT_EQ(shell("\"$gnomon\" nonsense >&- 2>&- <&-").status, 2);
}

/// A closed stream's number must not become that of a file that the program writes.
TEST_F(LostOutput, GoesIntoNoFileOfTheRun) {
  ASSERT_EQ(shell("\"$gnomon\" run small.toml --out right >/dev/null").status, 0);
  ASSERT_EQ(shell("\"$gnomon\" run small.toml --out closed >&- 2>&- <&-").status, 3);
  for (const char* name : {"small/summary.json", "small/metrics.csv", "small/report.html"}) {
    const std::string text = read(std::string("closed/") + name);
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << name;
    EXPECT_EQ(text.find("Report: "), std::string::npos) << name;
  }
  EXPECT_EQ(read("closed/small/metrics.csv"), read("right/small/metrics.csv"));
}

/// At every limit of file sizes a run is whole or says in one line what could not be written.
TEST_F(LostOutput, ByALimitOfFileSizesIsOneLine) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "ThreadSanitizer writes a file of 512 KiB before the program begins";
#endif
  const int steps = repetitions(4, 40);
  int refused = 0;
  for (int i = 0; i < steps; ++i) {
    const int level = 40 * i / steps;
    const int blocks = 4 * level * level;  // of 512 bytes: up to 3 MB
    // Through a pipe: a file for the message would be under the limit too.
    const Outcome checked = shell("rm -rf out .cache; (ulimit -f " + std::to_string(blocks) +
                                  "; \"$gnomon\" check small.toml 2>&1 >/dev/null; echo $?) | cat");
    const std::vector<std::string> lines = linesOf(checked.out);
    ASSERT_FALSE(lines.empty());
    const std::string& status = lines.back();
    if (status == "0") {
      EXPECT_EQ(summary("small").at("status"), "pass");
      continue;
    }
    ++refused;
    EXPECT_TRUE(status == "3" || status == "4") << blocks << " blocks:\n" << checked.out;
    const auto isWarning = [](const std::string& line) {
      return line.starts_with("gnomon: warning: ");
    };
    const auto warnings = std::count_if(lines.begin(), lines.end(), isWarning);
    EXPECT_EQ(lines.size(), static_cast<std::size_t>(2 + warnings)) << checked.out;
    EXPECT_LE(warnings, 1) << checked.out;
    EXPECT_THAT(lines.front(), StartsWith("gnomon: "));
    EXPECT_FALSE(std::filesystem::exists(file("out/small/summary.json")));
  }
  EXPECT_GT(refused, 0);
  std::printf("faults: %d limits of file sizes, %d of them too small, 0 signals\n", steps, refused);
}

// What a terminal gets.

TEST_F(LostOutput, ADumbTerminalGetsNoColours) {
  if (std::system("command -v script >/dev/null") != 0) GTEST_SKIP() << "no script(1) here";
  const auto table = [&](const std::string& variables) {
    (void)shell("export gnomon; " + variables +
                " script -qec '\"$gnomon\" check small.toml' typescript </dev/null");
    return read("typescript");
  };
  EXPECT_THAT(table("TERM=xterm"), HasSubstr("\x1b[32mpass"));
  EXPECT_EQ(table("TERM=dumb").find("\x1b["), std::string::npos);
  EXPECT_EQ(table("TERM=xterm NO_COLOR=1").find("\x1b[32m"), std::string::npos);
}

// One study that fails.

class OneOfSeveral : public LostOutput {
 protected:
  /// A method that no driver compiles.
  void writeBroken() const {
    write("broken.glsl",
          "/* gnomon-method\ntitle = \"b\"\ncitation = \"c\"\ntables = []\n*/\n"
          "bool isShadowed(Pixel pixel, LocalLight light) { return nonsense; }\n");
    write("a.toml", named("a", ""));
    write("b.toml", named("b", "\n[[method]]\nfile = \"broken.glsl\"\n"));
    write("c.toml", named("c", ""));
  }
  static std::string named(const std::string& name, const std::string& more) {
    return replaced(smallStudy(), "\"small\"", "\"" + name + "\"") + more +
           "\n[[threshold]]\nmax = 0.9\n";
  }
};

TEST_F(OneOfSeveral, LeavesTheOthersTheirTablesAndTheirRanking) {
  writeBroken();
  for (const char* order : {"a.toml b.toml c.toml", "b.toml a.toml c.toml"}) {
    const Outcome outcome = shell(std::string("rm -rf out; \"$gnomon\" run ") + order);
    EXPECT_EQ(outcome.status, 3) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("b.toml"));
    for (const char* report : {"Report: out/a/report.html\n", "Report: out/c/report.html\n",
                               "Report: out/ranking.html\n"}) {
      EXPECT_THAT(outcome.out, HasSubstr(report)) << order;
    }
    const auto ranking = nlohmann::json::parse(read("out/ranking.json"));
    ASSERT_EQ(ranking.at("studies").size(), 2U);
    EXPECT_EQ(ranking.at("studies").at(0).at("name"), "a");
    EXPECT_EQ(ranking.at("studies").at(1).at("name"), "c");
    EXPECT_FALSE(std::filesystem::exists(file("out/b/summary.json")));
  }
}

TEST_F(OneOfSeveral, LeavesNoRankingOfASingleStudy) {
  writeBroken();
  ASSERT_EQ(shell("\"$gnomon\" run a.toml c.toml").status, 0);
  EXPECT_EQ(shell("\"$gnomon\" run a.toml b.toml").status, 3);
  EXPECT_FALSE(std::filesystem::exists(file("out/ranking.json")));
}

TEST_F(OneOfSeveral, OfACheckLeavesTheOthersTheirVerdicts) {
  writeBroken();
  const Outcome outcome = shell("\"$gnomon\" check b.toml a.toml c.toml --junit junit.xml");
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Not passed: b\n"));
  EXPECT_EQ(summary("a").at("status"), "pass");
  EXPECT_EQ(nlohmann::json::parse(read("out/ranking.json")).at("studies").size(), 2U);
}

TEST_F(OneOfSeveral, OfASweepLeavesTheOthersTheirTables) {
  write("a.toml", named("a", ""));
  write("s.toml", named("s", "\n[sweep]\nkey = \"truth.step\"\nvalues = [0.25, 1e-7]\n"));
  write("c.toml", named("c", ""));
  const Outcome outcome = shell("\"$gnomon\" run s.toml a.toml c.toml");
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Report: out/a/report.html\n"));
  EXPECT_THAT(outcome.out, HasSubstr("Report: out/ranking.html\n"));
}

TEST_F(OneOfSeveral, OfTruthsAndTablesLeavesTheOthersTheirs) {
  write("a.toml", named("a", ""));
  write("b.toml", replaced(named("b", ""), "step = 0.25", "step = 1e-7"));
  write("c.toml", named("c", ""));
  const Outcome outcome = shell("\"$gnomon\" truth a.toml b.toml c.toml");
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("out/c/truth/truth.json: "));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

}  // namespace
}  // namespace gnomon::test
