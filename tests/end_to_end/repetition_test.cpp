#include "end_to_end/support/lasting_files.h"
#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

class Repetition : public EndToEnd {
 protected:
  /// On a sphere, where most axes have several bins and so a plot; two views, so that both kinds
  /// are compared, and both lights of a sweep.
  [[nodiscard]] static std::string study() {
    std::string text = replaced(onSphere(smallStudy()), "elevation = 30", "elevation = [50, 20]");
    return replaced(text, "name = \"evening\"\n", "") +
           "\n[[method]]\nname = \"onoue-2004\"\n\n[[view]]\ntype = \"atlas\"\nsamples = 17\n";
  }
  /// The files that must not depend on the run: all but those that tell times.
  [[nodiscard]] std::vector<std::string> lastingFiles(const std::string& out) const {
    std::vector<std::string> files = filesBelow(out);
    std::erase_if(files, [](const std::string& name) {
      return name == "small/summary.json" || name == "small/report.html" ||
             name == "small/table.csv" || name == "small/table.md";
    });
    return files;
  }
  void expectSameBytes(const std::string& a, const std::string& b) const {
    const auto files = lastingFiles(a);
    ASSERT_EQ(files, lastingFiles(b));
    // Two lights: 4 masks, 3 of tests alone and the truth's regions each in 2 views; 4 pictures, 3
    // differences, 1 displaced in one view. Two tables, a paper's table and numbers, the study, the
    // list of files, an atlas's weights; plots of all axes but the stretch, which is below 1.1
    // everywhere, in both views, as SVG and PDF.
    EXPECT_EQ(files.size(), 7U + 2 * 4 * 2 + 2 * (2 * (4 + 3 + 1 + 4 + 3) + 1));
    for (const std::string& name : files) {
      const std::string file = "/" + name;
      const bool same = read(a + file) == read(b + file);
      EXPECT_TRUE(same) << name;
    }
  }
};

TEST_F(Repetition, SameInputSameBytes) {
  runStudy("small", study(), {"--out", "first"});
  runStudy("small", study(), {"--out", "second"});
  expectSameBytes("first", "second");
}

TEST_F(Repetition, ThreadsDoNotMatter) {
  runStudy("small", study(), {"--out", "one", "--threads", "1"});
  runStudy("small", study(), {"--out", "two", "--threads", "2"});
  runStudy("small", study(), {"--out", "many", "--threads", "7"});
  expectSameBytes("one", "two");
  expectSameBytes("one", "many");
  EXPECT_EQ(summary("small", "one").at("environment").at("threads"), 1);
  EXPECT_EQ(summary("small", "two").at("environment").at("threads"), 2);
}

/// The list of docs/summary.md, "What may differ between two runs": all else is the same.
TEST_F(Repetition, TheWholeFolderIsTheSameButForWhatTheManualLists) {
  write("small.toml", study() + "\n[[threshold]]\nmax = 0.9\n");
  const auto run = [&](const std::string& out, std::vector<std::string> options, const char* zone) {
    options.insert(options.begin(), {"run", "small.toml", "--figures", "page", "--out", out});
    const Outcome outcome =
        gnomon(options, {"GNOMON_CACHE=" + file("kept").string(), std::string("TZ=") + zone});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  };
  run("none", {"--no-cache"}, "UTC");
  run("empty", {"--threads", "1"}, "Asia/Kolkata");
  run("filled", {"--threads", "3"}, "America/St_Johns");
  const std::vector<std::string> files = filesBelow("none");
  EXPECT_GT(files.size(), 40U);
  for (const char* other : {"empty", "filled"}) {
    EXPECT_EQ(files, filesBelow(other));
    for (const std::string& name : files) {
      const bool same = lasting(name, read("none/" + name)) ==
                        lasting(name, read(std::string(other) + "/" + name));
      EXPECT_TRUE(same) << other << ": " << name;
    }
  }
}

TEST_F(Repetition, BesideOtherStudiesAStudyIsTheSame) {
  runStudy("small", study(), {"--out", "alone"});
  write("other.toml",
        replaced(replaced(study(), "\"small\"", "\"other\""), "radius = 4", "radius = 6"));
  const Outcome outcome = gnomon({"run", "other.toml", "small.toml", "--out", "both"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const std::string& name : lastingFiles("alone")) {
    const bool same = read("alone/" + name) == read("both/" + name);
    EXPECT_TRUE(same) << name;
  }
  EXPECT_NE(read("both/other/metrics.csv"), read("both/small/metrics.csv"));
}

TEST_F(Repetition, BakedTablesAreTheSame) {
  write("small.toml", study());
  ASSERT_EQ(gnomon({"bake", "small.toml", "--out", "one", "--threads", "1"}).status, 0);
  ASSERT_EQ(gnomon({"bake", "small.toml", "--out", "two", "--threads", "3"}).status, 0);
  const std::string tables = read("one/small/tables.exr");
  EXPECT_GT(tables.size(), 1000U);
  EXPECT_TRUE(tables == read("two/small/tables.exr"));
}

}  // namespace
}  // namespace gnomon::test
