#include "common/atomic_file.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>

#include "common/error.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class AtomicFile : public TemporaryFolder {
 protected:
  /// Names of all that lies in the folder.
  [[nodiscard]] std::set<std::string> content() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder())) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
};

void writeText(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

TEST_F(AtomicFile, WritesWhatItIsGivenAndNothingElse) {
  writeTextAtomically(file("a.csv"), "x,y\n1,2\n");
  EXPECT_EQ(readFile(file("a.csv")), "x,y\n1,2\n");
  EXPECT_EQ(content(), std::set<std::string>{"a.csv"});
}

TEST_F(AtomicFile, KeepsEveryByte) {
  std::string bytes;
  for (int i = 0; i < 70'000; ++i) bytes += static_cast<char>(i % 256);
  writeTextAtomically(file("bytes"), bytes);
  EXPECT_EQ(readFile(file("bytes")), bytes);
  writeTextAtomically(file("bytes"), "");
  EXPECT_EQ(readFile(file("bytes")), "");
}

TEST_F(AtomicFile, MakesTheFoldersAboveIt) {
  writeTextAtomically(file("out/study/summary.json"), "{}");
  EXPECT_EQ(readFile(file("out/study/summary.json")), "{}");
}

TEST_F(AtomicFile, ShowsTheOldContentUntilTheNewOneIsWhole) {
  writeTextAtomically(file("a.png"), "old");
  fs::path temporary;
  writeAtomically(file("a.png"), [&](const fs::path& path) {
    temporary = path;
    writeText(path, "half of the ne");
    EXPECT_EQ(readFile(file("a.png")), "old");
    writeText(path, "new");
  });
  EXPECT_EQ(readFile(file("a.png")), "new");
  EXPECT_EQ(content(), std::set<std::string>{"a.png"});
  // In the same folder, or the renaming could be a copy; with the same extension, since image
  // writers choose their format by it.
  EXPECT_EQ(temporary.parent_path(), folder());
  EXPECT_EQ(temporary.extension(), ".png");
}

TEST_F(AtomicFile, LeavesTheOldFileWhereTheWriterThrows) {
  writeTextAtomically(file("a.txt"), "old");
  const auto write = [](const fs::path& path) {
    writeText(path, "half");
    throw std::runtime_error("the writer gave up");
  };
  try {
    writeAtomically(file("a.txt"), write);
    ADD_FAILURE() << "the writer's error was swallowed";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the writer gave up");
  }
  EXPECT_EQ(readFile(file("a.txt")), "old");
  EXPECT_EQ(content(), std::set<std::string>{"a.txt"});
}

TEST_F(AtomicFile, LeavesNothingWhereTheWriterThrowsAndNothingWas) {
  const auto write = [](const fs::path& path) {
    writeText(path, "half");
    throw InputError("no");
  };
  EXPECT_THROW(writeAtomically(file("a.txt"), write), InputError);
  EXPECT_TRUE(content().empty());
}

TEST_F(AtomicFile, RefusesAWriterThatWritesNothing) {
  const std::string message =
      messageOf<InputError>([&] { writeAtomically(file("a.txt"), [](const fs::path&) {}); });
  EXPECT_THAT(message, StartsWith(file("a.txt").string() + ": cannot be written"));
}

TEST_F(AtomicFile, RefusesAFolderAsItsFile) {
  fs::create_directories(file("a.txt/inside"));
  EXPECT_THAT(messageOf<InputError>([&] { writeTextAtomically(file("a.txt"), "x"); }),
              HasSubstr("a.txt: cannot be written"));
  EXPECT_EQ(content(), std::set<std::string>{"a.txt"});
  EXPECT_TRUE(fs::is_directory(file("a.txt/inside")));
}

TEST_F(AtomicFile, RefusesAFileAsItsFolder) {
  writeText(file("out"), "a file");
  EXPECT_THAT(messageOf<InputError>([&] { writeTextAtomically(file("out/a.txt"), "x"); }),
              StartsWith(file("out").string() + ": cannot create the folder"));
  EXPECT_EQ(readFile(file("out")), "a file");
}

TEST_F(AtomicFile, RefusesANameThatTheSystemDoesNotTake) {
  const std::string name(400, 'n');
  EXPECT_THAT(messageOf<InputError>([&] { writeTextAtomically(file(name), "x"); }),
              HasSubstr("cannot be written"));
  EXPECT_TRUE(content().empty());
}

TEST_F(AtomicFile, ReadingNamesWhatIsMissing) {
  EXPECT_THAT(messageOf<InputError>([&] { readFile(file("none.toml")); }),
              StartsWith(file("none.toml").string() + ": no such file"));
  EXPECT_THAT(messageOf<InputError>([&] { readFile(folder()); }),
              StartsWith(folder().string() + ": is a folder"));
  EXPECT_THAT(messageOf<InputError>([] { readFile("/dev/zero"); }),
              StartsWith("/dev/zero: is a device"));
}

TEST_F(AtomicFile, ReadingRefusesMoreThanFits) {
  writeText(file("large"), "x");
  std::error_code failure;
  fs::resize_file(file("large"), std::uintmax_t{1} << 43, failure);
  if (failure) GTEST_SKIP() << "no file of 8 TiB, even an empty one: " << failure.message();
  EXPECT_THAT(messageOf<MemoryError>([&] { readFile(file("large")); }), HasSubstr("8.80 TB"));
}

}  // namespace
}  // namespace gnomon
