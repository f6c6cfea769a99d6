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

TEST_F(RunFolders, TheNextRunRemovesWhatTheEarlierWroteAndNothingElse) {
  whole({"report.html", "images/a.png", "plots/b.svg", "masks/test/c.png"});
  put(run() / "notes.txt");
  put(run() / "images/mine.png");
  put(run() / "masks/mine/d.png");
  RunFolder next(run(), kind);
  next.clear();
  EXPECT_EQ(content(), (Names{"files.txt", "notes.txt", "images/", "images/mine.png", "masks/",
                              "masks/mine/", "masks/mine/d.png"}));
}

TEST_F(RunFolders, TheListNamesAFileBeforeItIsThere) {
  RunFolder folder(run(), kind);
  folder.clear();
  const fs::path path = folder.newFile("images/a.png");
  EXPECT_FALSE(fs::exists(path));
  EXPECT_TRUE(RunFolder(run(), kind).names("images/a.png"));
}

TEST_F(RunFolders, ARunThatWasKilledIsClearedTheSameWay) {
  {
    RunFolder killed(run(), kind);
    killed.clear();
    killed.write("images/a.png", "whole");
    // Its list ends within a name, whose file it had not made.
    std::ofstream(killed.listFile(), std::ios::app) << "images/b.p";
  }
  put(run() / "images/b.p");
  RunFolder(run(), kind).clear();
  EXPECT_EQ(content(), (Names{"files.txt", "images/", "images/b.p"}));
  for (const char* begun : {"", "# Written by"}) {
    put(run() / "files.txt", begun);
    EXPECT_NO_THROW(RunFolder(run(), kind).clear()) << begun;
  }
}

TEST_F(RunFolders, FoldersOfValuesGoWithTheirSweep) {
  {
    RunFolder sweep(run(), kind);
    sweep.clear();
    sweep.add("0.5/");
    RunFolder value(run() / "0.5", kind);
    value.clear();
    value.write("images/a.png", "x");
    value.finish("{}");
    put(run() / "7/images/a.png");
  }
  RunFolder(run(), kind).clear();
  EXPECT_EQ(content(), (Names{"files.txt", "7/", "7/images/", "7/images/a.png"}));
}

TEST_F(RunFolders, WhatIsReadFromStays) {
  whole({"a.toml", "b.csv"});
  const std::vector<fs::path> kept = {run() / "../run/a.toml"};
  RunFolder folder(run(), kind);
  folder.clear(kept);
  EXPECT_EQ(content(), (Names{"files.txt", "a.toml"}));
  EXPECT_TRUE(RunFolder(run(), kind).names("a.toml"));
  EXPECT_NO_THROW(folder.write("a.toml", "new"));
}

TEST_F(RunFolders, FilesOfOthersAreNotReplaced) {
  put(run() / "table.csv");
  put(run() / "link");
  RunFolder folder(run(), kind);
  folder.clear();
  EXPECT_THAT(messageOf<InputError>([&] { folder.write("table.csv", "x"); }),
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
  RunFolder(run(), kind).clear();
  EXPECT_EQ(readFile(file("elsewhere/a.png")), "mine");
  EXPECT_EQ(readFile(file("victim")), "mine");
  EXPECT_FALSE(fs::exists(fs::symlink_status(run() / "b.csv")));
}

TEST_F(RunFolders, TheIndexGoesFirst) {
  whole({"images/a.png"});
  RunFolder folder(run(), kind);
  folder.removeIndex();
  EXPECT_EQ(content(), (Names{"files.txt", "images/", "images/a.png"}));
}

}  // namespace
}  // namespace gnomon::report
