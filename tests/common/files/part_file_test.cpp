#include "common/files/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <regex>
#include <set>
#include <thread>

#include "support/temporary_folder.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using ::testing::MatchesRegex;

class PartFiles : public TemporaryFolder {
 protected:
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder()), fs::directory_iterator()));
  }
  /// What a process leaves that is killed while it writes.
  [[nodiscard]] fs::path leftover() const {
    const pid_t writer = ::fork();
    if (writer == 0) {
      const PartFile part(folder(), ".png");
      ::raise(SIGKILL);
    }
    ::waitpid(writer, nullptr, 0);
    return fs::directory_iterator(folder())->path();
  }
};

TEST_F(PartFiles, TellMachineProcessAndChance) {
  const PartFile one(folder(), ".png");
  const PartFile other(folder(), ".png");
  EXPECT_THAT(one.path().filename().string(),
              MatchesRegex("\\.gnomon-[0-9a-f]+-" + std::to_string(::getpid()) +
                           "-[0-9a-f]+\\.part\\.png"));
  EXPECT_NE(one.path(), other.path());
  EXPECT_EQ(count(), 2U);
}

TEST_F(PartFiles, GoUnlessTheyGetAName) {
  { const PartFile part(folder(), ""); }
  EXPECT_EQ(count(), 0U);
  {
    PartFile part(folder(), "");
    part.nameIt(file("whole"));
  }
  EXPECT_EQ(count(), 1U);
  EXPECT_TRUE(fs::exists(file("whole")));
}

TEST_F(PartFiles, OfTheDeadAreRemovedAndThoseOfTheLivingAreNot) {
  const fs::path dead = leftover();
  const PartFile mine(folder(), ".png");
  // Of another process, alive, whose number is a dead one's: as in another container.
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t writer = ::fork();
  if (writer == 0) {
    const PartFile part(folder(), ".csv");
    fs::rename(part.path(), file(".gnomon-" + dead.filename().string().substr(8, 8) +
                                 "-1-0123456789abcdef.part.csv"));
    (void)!::write(ready[1], "x", 1);
    ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  removeLeftovers(folder());
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(mine.path()));
  EXPECT_EQ(count(), 2U);
  ::kill(writer, SIGKILL);
  ::waitpid(writer, nullptr, 0);
  removeLeftovers(folder());
  EXPECT_EQ(count(), 1U);
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_F(PartFiles, OfAnotherMachineStayForAnHour) {
  // Its locks may not show here.
  const fs::path now = file(".gnomon-00000000-7-0123456789abcdef.part.png");
  const fs::path once = file(".gnomon-00000000-8-0123456789abcdef.part");
  for (const fs::path& path : {now, once}) std::ofstream(path) << "half";
  fs::last_write_time(once, fs::file_time_type::clock::now() - std::chrono::hours(2));
  removeLeftovers(folder());
  EXPECT_TRUE(fs::exists(now));
  EXPECT_FALSE(fs::exists(once));
}

TEST_F(PartFiles, NothingElseIsTaken) {
  const fs::path dead = leftover();
  const std::string own = dead.filename().string();
  std::set<std::string> others = {"part.png", ".part",    ".gnomon-1-2-3.part",
                                  "x" + own,  own + "/x", own.substr(0, own.find(".part"))};
  others.erase(own + "/x");
  for (const std::string& name : others) std::ofstream(file(name)) << "mine";
  const std::string machine = own.substr(8, 8);
  const fs::path pipe = file(".gnomon-" + machine + "-3-0123456789abcdef.part");
  const fs::path below = file(".gnomon-" + machine + "-4-0123456789abcdef.part");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  fs::create_directory(below);
  removeLeftovers(folder());
  EXPECT_FALSE(fs::exists(dead));
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(file(name))) << name;
  EXPECT_TRUE(fs::exists(pipe));
  EXPECT_FALSE(fs::exists(below));
  removeLeftovers(file("no folder"));
}

TEST_F(PartFiles, FoldersGoUnlessTheyGetAName) {
  { const PartFolder part(file("whole")); }
  EXPECT_EQ(count(), 0U);
  for (const char* text : {"first", "second"}) {
    PartFolder part(file("whole"));
    std::ofstream(part.path() / text) << text;
    const PartFolder other(file("other"));
    EXPECT_TRUE(fs::exists(part.path() / text)) << "removed by a living process";
    part.nameIt(file("whole"));
    EXPECT_EQ(part.path(), "");
  }
  EXPECT_EQ(count(), 1U);
  EXPECT_FALSE(fs::exists(file("whole/first")));
  EXPECT_TRUE(fs::exists(file("whole/second")));
}

TEST_F(PartFiles, AreNotLostBetweenCreationAndLock) {
  // A cleaner that never rests; a writer whose file it takes makes another.
  std::atomic<bool> ends = false;
  std::thread cleaner([&] {
    while (!ends) removeLeftovers(folder());
  });
  constexpr int rounds = 2000;
  for (int i = 0; i < rounds; ++i) {
    PartFile part(folder(), "");
    part.nameIt(file("a"));
  }
  ends = true;
  cleaner.join();
  EXPECT_EQ(count(), 1U);
}

}  // namespace
}  // namespace gnomon
