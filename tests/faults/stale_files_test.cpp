#include <fmt/core.h>
#include <gmock/gmock.h>

#include "faults/run_folders.h"

// What earlier runs and other people left in a folder of results.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class StaleFiles : public EndToEnd {
 protected:
  [[nodiscard]] Outcome run(const std::string& command, const std::string& name,
                            const std::string& text, const std::string& out = "out") const {
    write(name + ".toml", text);
    return gnomon({command, name + ".toml", "--out", out}, environment());
  }
  void expectRun(const std::string& name, const std::string& text,
                 const std::string& out = "out") const {
    const Outcome outcome = run("run", name, text, out);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  [[nodiscard]] std::vector<std::string> environment() const {
    return {"GNOMON_CACHE=" + file("kept").string()};
  }
  static std::string swept(const std::string& values) {
    return smallStudy() + "\n[sweep]\nkey = \"relief.height\"\nvalues = " + values +
           "\naxis = \"height\"\n";
  }
  static std::string named(const std::string& name) {
    return replaced(smallStudy(), "\"small\"", "\"" + name + "\"");
  }
};

TEST_F(StaleFiles, AfterAnotherRunTheFolderIsThatRunsAlone) {
  const std::vector<std::pair<std::string, std::string>> studies = {
      {"first", smallStudy()},
      {"other", otherStudy()},
      {"sweep", swept("[1, 2]")},
      {"another sweep", swept("[2, 3]")},
      {"with an atlas", smallStudy() + "\n[[view]]\ntype = \"atlas\"\nsamples = 9\n"},
  };
  for (const auto& [what, text] : studies) expectRun("small", text, "fresh " + what);
  for (const std::size_t i : {0U, 1U, 2U, 3U, 1U, 4U, 2U, 0U}) {
    expectRun("small", studies.at(i).second);
    EXPECT_EQ(contentOf(file("out")), contentOf(file("fresh " + studies.at(i).first)))
        << studies.at(i).first;
  }
}

TEST_F(StaleFiles, TruthsAndExportsKeepNoOlderOnes) {
  for (const std::string command : {"truth", "export"}) {
    ASSERT_EQ(run(command, "small", otherStudy(), "fresh").status, 0);
    ASSERT_EQ(
        run(command, "small",
            replaced(smallStudy(), "type = \"camera\"", "name = \"from-above\"\ntype = \"camera\""))
            .status,
        0);
    ASSERT_EQ(run(command, "small", otherStudy()).status, 0);
    FolderContent fresh = contentOf(file("fresh"));
    FolderContent found = contentOf(file("out"));
    for (FolderContent* content : {&fresh, &found}) {
      for (auto& [name, bytes] : *content) {
        if (name.ends_with(".json")) bytes.clear();  // holds the command
      }
    }
    EXPECT_EQ(differences(found, fresh), nothing) << command;
  }
}

TEST_F(StaleFiles, FilesOfOthersStay) {
  expectRun("small", smallStudy());
  const std::vector<std::string> foreign = {"images/mine.png", "masks/mine.png",  "plots/mine.svg",
                                            "plots/mine.pdf",  "notes.txt",       "sweep.csv",
                                            "bins.txt",        "regions/mine.png"};
  for (const std::string& name : foreign) write("out/small/" + name, "mine");
  expectRun("small", otherStudy());
  for (const std::string& name : foreign) EXPECT_EQ(read("out/small/" + name), "mine") << name;
}

TEST_F(StaleFiles, AFolderWithASummaryOfOthersIsRefused) {
  for (const char* name : {"summary.json", "report.html"}) {
    const std::string path = std::string("theirs/small/") + name;
    fs::create_directories(file("theirs/small"));
    write(path, "mine");
    const Outcome outcome = run("run", "small", smallStudy(), "theirs");
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, HasSubstr("gnomon: " + path + ": is in the way"));
    EXPECT_THAT(filesBelow("theirs"), ElementsAre(std::string("small/") + name));
    EXPECT_EQ(read(path), "mine");
    fs::remove_all(file("theirs"));
  }
  // Where it would be written last it is found before anything is run.
  write("b.toml", named("b"));
  write("a.toml", named("a"));
  fs::create_directories(file("ranked"));
  write("ranked/ranking.html", "mine");
  const Outcome outcome = gnomon({"run", "a.toml", "b.toml", "--out", "ranked"}, environment());
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("ranked/ranking.html: is in the way"));
  EXPECT_THAT(filesBelow("ranked"), Not(Contains(HasSubstr("report.html"))));
}

TEST_F(StaleFiles, NoSummaryIsLeftOfAStudyThatFails) {
  write("a.toml", named("a"));
  write("b.toml", named("b"));
  write("c.toml", replaced(named("c"), "name = \"unshadowed\"", "name = \"unshadowed\"\n"));
  const std::vector<std::string> all = {"run", "c.toml", "a.toml", "b.toml"};
  ASSERT_EQ(gnomon(all, environment()).status, 0);
  // A view that shows nothing is found when the study runs.
  write("c.toml",
        replaced(named("c"), "eye = [0, 0, 80]", "eye = [0, 0, 80]\ntarget = [0, 0, 160]"));
  EXPECT_EQ(gnomon(all, environment()).status, 3);
  EXPECT_FALSE(fs::exists(file("out/c/summary.json")));
  // The others are run all the same, and ranked without it.
  for (const char* name : {"a", "b"}) {
    EXPECT_TRUE(fs::exists(file("out") / name / "summary.json")) << name;
  }
  EXPECT_THAT(read("out/ranking.csv"), AllOf(HasSubstr("\na,"), Not(HasSubstr("\nc,"))));
}

TEST_F(StaleFiles, ARankingGoesWithAStudyOfItAndWithNoOther) {
  for (const char* name : {"a", "b", "c"}) write(std::string(name) + ".toml", named(name));
  const std::vector<std::string> ranking = {"ranking.csv", "ranking.md", "ranking.html",
                                            "ranking.json"};
  ASSERT_EQ(gnomon({"run", "a.toml", "b.toml"}, environment()).status, 0);
  ASSERT_EQ(gnomon({"run", "c.toml"}, environment()).status, 0);
  for (const std::string& name : ranking) EXPECT_TRUE(fs::exists(file("out") / name)) << name;
  ASSERT_EQ(gnomon({"run", "b.toml"}, environment()).status, 0);
  for (const std::string& name : ranking) EXPECT_FALSE(fs::exists(file("out") / name)) << name;
  EXPECT_TRUE(fs::exists(file("out/a/summary.json")));
}

TEST_F(StaleFiles, AStudyCanBeRunFromItsOwnCopy) {
  expectRun("small", swept("[1, 2]"));
  const FolderContent before = contentOf(file("out"));
  for (const std::string copy : {"out/small/small.toml", "out/small/1/small-1.toml"}) {
    const Outcome outcome = gnomon({"run", copy}, environment());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(file(copy)));
  }
  FolderContent after = contentOf(file("out/small"));
  for (const auto& [name, bytes] : before) {
    EXPECT_TRUE(after.contains(name.substr(std::string("small/").size()))) << name;
  }
}

}  // namespace
}  // namespace gnomon::test
