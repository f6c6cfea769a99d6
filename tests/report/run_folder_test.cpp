#include "report/run_folder.h"

#include <gmock/gmock.h>

#include <fstream>
#include <set>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const FolderKind kind{"summary.json", {"report.html"}};

class RunFolders : public TemporaryFolder {
 protected:
  [[nodiscard]] fs::path run() const { return file("run"); }
  void put(const fs::path& path, const std::string& text = "mine") const {
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  /// A whole run with these files beside its index.
  void whole(const std::vector<std::string>& names) const {
    RunFolder folder(run(), kind);
    folder.clear();
    for (const std::string& name : names) folder.write(name, "of the run");
    folder.finish("{}");
  }
  [[nodiscard]] std::set<std::string> content() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(run())) {
      const std::string name = entry.path().lexically_relative(run()).string();
      names.insert(entry.is_directory() ? name + "/" : name);
    }
    return names;
  }
  using Names = std::set<std::string>;
};

TEST_F(RunFolders, NothingIsInItsPlaceUntilAllIsWritten) {
  RunFolder folder(run(), kind);
  folder.clear();
  folder.write("images/a.png", "of the run");
  EXPECT_FALSE(fs::exists(run()));
  EXPECT_TRUE(fs::exists(folder.path() / "images/a.png"));
  folder.finish("{}");
  EXPECT_EQ(folder.path(), run());
  EXPECT_EQ(content(), (Names{"files.txt", "summary.json", "images/", "images/a.png"}));
  folder.write("b.csv", "later");
  folder.finish("{1}");
  EXPECT_TRUE(RunFolder(run(), kind).names("b.csv"));
  EXPECT_EQ(readFile(run() / "summary.json"), "{1}");
}

TEST_F(RunFolders, TheNextRunReplacesWhatTheEarlierWroteAndNothingElse) {
  whole({"report.html", "images/a.png", "plots/b.svg", "masks/test/c.png"});
  const Names mine = {"notes.txt", "images/mine.png", "masks/mine/d.png", "export/files.txt"};
  for (const std::string& name : mine) put(run() / name);
  RunFolder next(run(), kind);
  next.clear();
  EXPECT_FALSE(fs::exists(run() / "summary.json"));
  EXPECT_TRUE(fs::exists(run() / "plots/b.svg"));
  next.finish("{}");
  EXPECT_EQ(content(),
            (Names{"files.txt", "summary.json", "notes.txt", "images/", "images/mine.png", "masks/",
                   "masks/mine/", "masks/mine/d.png", "export/", "export/files.txt"}));
  for (const std::string& name : mine) EXPECT_EQ(readFile(run() / name), "mine");
}

TEST_F(RunFolders, ARunThatEndsEarlyLeavesNothing) {
  {
    RunFolder folder(run(), kind);
    folder.clear();
    folder.write("images/a.png", "whole");
  }
  EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(RunFolders, FoldersOfValuesGoWithTheirSweep) {
  {
    RunFolder sweep(run(), kind);
    sweep.clear();
    RunFolder value(sweep, "0.5");
    value.write("images/a.png", "x");
    value.finish("{}");
    EXPECT_FALSE(fs::exists(run()));
    sweep.finish("{}");
    EXPECT_EQ(value.path(), run() / "0.5");
  }
  EXPECT_TRUE(fs::exists(run() / "0.5/summary.json"));
  put(run() / "0.5/mine.txt");
  put(run() / "7/images/a.png");
  RunFolder next(run(), kind);
  next.clear();
  next.finish("{}");
  EXPECT_EQ(content(), (Names{"files.txt", "summary.json", "0.5/", "0.5/mine.txt", "7/",
                              "7/images/", "7/images/a.png"}));
}

TEST_F(RunFolders, OfASharedKindItsFilesLieAmongOthers) {
  const FolderKind ranking{"ranking.json", {"ranking.csv"}, "ranking.txt", true};
  put(run() / "mine/summary.json");
  for (const char* name : {"plots/a.svg", "b.csv"}) {
    RunFolder folder(run(), ranking);
    folder.clear();
    folder.write(name, "x");
    folder.finish("{}");
  }
  EXPECT_EQ(content(), (Names{"ranking.txt", "ranking.json", "plots/", "b.csv", "mine/",
                              "mine/summary.json"}));
}

TEST_F(RunFolders, FilesOfOthersAreNotReplaced) {
  put(run() / "table.csv");
  RunFolder folder(run(), kind);
  folder.clear();
  folder.write("table.csv", "x");
  EXPECT_THAT(messageOf<InputError>([&] { folder.finish("{}"); }),
              HasSubstr("table.csv: is in the way"));
  EXPECT_EQ(readFile(run() / "table.csv"), "mine");
  for (const char* name : {"summary.json", "report.html"}) {
    put(run() / name);
    EXPECT_THAT(messageOf<InputError>([&] { RunFolder(run(), kind); }),
                HasSubstr(std::string(name) + ": is in the way: no run's list of its files"));
    fs::remove(run() / name);
  }
}

TEST_F(RunFolders, AListOfSomebodyElseIsRefused) {
  const std::string first =
      "# Written by a run of gnomon: its files in this folder, which the next "
      "run removes.\n";
  put(file("victim"));
  for (const std::string& text :
       {std::string("shopping\n"), std::string("milk\nbread\n"), first + "../victim\n",
        first + file("victim").string() + "\n", first + "images/../../victim\n", first + "\n",
        first + "a.png\n./a.png\n"}) {
    put(run() / "files.txt", text);
    EXPECT_THAT(messageOf<InputError>([&] { RunFolder(run(), kind).clear(); }),
                HasSubstr("a run's list of its files expected"))
        << text;
    EXPECT_EQ(readFile(run() / "files.txt"), text);
  }
  EXPECT_EQ(readFile(file("victim")), "mine");
}

TEST_F(RunFolders, NothingBehindALinkIsRemoved) {
  whole({"images/a.png", "b.csv"});
  fs::remove_all(run() / "images");
  put(file("elsewhere/a.png"));
  fs::create_directory_symlink(file("elsewhere"), run() / "images");
  put(file("victim"));
  fs::remove(run() / "b.csv");
  fs::create_symlink(file("victim"), run() / "b.csv");
  RunFolder next(run(), kind);
  next.clear();
  next.finish("{}");
  EXPECT_EQ(readFile(file("elsewhere/a.png")), "mine");
  EXPECT_EQ(readFile(file("victim")), "mine");
  EXPECT_FALSE(fs::exists(fs::symlink_status(run() / "b.csv")));
}

}  // namespace
}  // namespace gnomon::report
