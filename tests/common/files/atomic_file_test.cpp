#include "common/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <future>
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
  writeAtomically(file("a.png"), [&](int open) {
    writeAll(open, "half of ");
    EXPECT_EQ(readFile(file("a.png")), "old");
    // In the same folder, or the renaming could be a copy.
    EXPECT_EQ(content().size(), 2U);
    writeAll(open, "the new");
  });
  EXPECT_EQ(readFile(file("a.png")), "half of the new");
  EXPECT_EQ(content(), std::set<std::string>{"a.png"});
}

TEST_F(AtomicFile, OfWhichTheNameWasRemovedIsNotMadeAnew) {
  // As a signal does it, while the writer goes on until the process ends.
  EXPECT_THROW(writeAtomically(file("a.txt"),
                               [&](int open) {
                                 for (const std::string& name : content()) fs::remove(file(name));
                                 writeAll(open, "what nobody will see");
                                 EXPECT_TRUE(content().empty());
                               }),
               InputError);
  EXPECT_TRUE(content().empty());
}

TEST_F(AtomicFile, LeavesTheOldFileWhereTheWriterThrows) {
  writeTextAtomically(file("a.txt"), "old");
  const auto write = [](int open) {
    writeAll(open, "half");
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
  const auto write = [](int open) {
    writeAll(open, "half");
    throw InputError("no");
  };
  EXPECT_THROW(writeAtomically(file("a.txt"), write), InputError);
  EXPECT_TRUE(content().empty());
}

TEST_F(AtomicFile, RefusesAWriterThatWritesNothing) {
  const std::string message =
      messageOf<InputError>([&] { writeAtomically(file("a.txt"), [](int) {}); });
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

TEST_F(AtomicFile, FollowsLinksToWhatTheyLeadTo) {
  fs::create_directories(file("there"));
  writeText(file("there/a.txt"), "old");
  fs::create_symlink("there/a.txt", file("second"));
  fs::create_symlink(file("second"), file("first"));
  writeTextAtomically(file("first"), "new");
  EXPECT_EQ(readFile(file("there/a.txt")), "new");
  EXPECT_TRUE(fs::is_symlink(file("first")) && fs::is_symlink(file("second")));
  // Of a file that is not there yet.
  fs::create_symlink("there/b.txt", file("third"));
  writeAtomically(file("third"), [](int open) { writeAll(open, "b"); });
  EXPECT_EQ(readFile(file("there/b.txt")), "b");
  EXPECT_TRUE(fs::is_symlink(file("third")));
  fs::create_symlink("loop", file("loop"));
  EXPECT_THAT(messageOf<InputError>([&] { writeTextAtomically(file("loop"), "x"); }),
              StartsWith(file("loop").string() + ": cannot be written: a link that leads to"));
}

TEST_F(AtomicFile, WritesIntoAPipeAndLeavesItOne) {
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", file("link"));
  for (const char* name : {"pipe", "link"}) {
    const std::string text(200'000, 'p');  // more than a pipe holds
    auto reader = std::async(std::launch::async, [&] {
      std::ifstream stream(file("pipe"), std::ios::binary);
      return std::string(std::istreambuf_iterator<char>(stream), {});
    });
    writeTextAtomically(file(name), text);
    EXPECT_EQ(reader.get(), text) << name;
    EXPECT_TRUE(fs::is_fifo(file("pipe")));
  }
  EXPECT_EQ(content(), (std::set<std::string>{"pipe", "link"}));
}

TEST_F(AtomicFile, WritesToADeviceAndLeavesItOne) {
  if (::mknod(file("null").c_str(), S_IFCHR | 0666, 0x103) != 0 ||
      ::mknod(file("full").c_str(), S_IFCHR | 0666, 0x107) != 0) {
    GTEST_SKIP() << "no device can be made here";
  }
  fs::create_symlink("null", file("link"));
  for (const char* name : {"null", "link"}) writeTextAtomically(file(name), "gone");
  EXPECT_TRUE(fs::is_character_file(file("null")));
  EXPECT_TRUE(fs::is_symlink(file("link")));
  EXPECT_EQ(messageOf<InputError>([&] { writeTextAtomically(file("full"), "x"); }),
            file("full").string() + ": cannot be written: No space left on device");
  EXPECT_TRUE(fs::is_character_file(file("full")));
}

TEST_F(AtomicFile, WritesToAnOpenStreamWhereItStands) {
  const int stream = ::open(file("log").c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_EQ(::write(stream, "before\n", 7), 7);
  for (const char* form : {"/dev/fd/{}", "/proc/self/fd/{}"}) {
    writeTextAtomically(fmt::format(fmt::runtime(form), stream), "between\n");
  }
  ASSERT_EQ(::write(stream, "behind\n", 7), 7);
  ::close(stream);
  EXPECT_EQ(readFile(file("log")), "before\nbetween\nbetween\nbehind\n");
  EXPECT_EQ(content(), std::set<std::string>{"log"});
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
