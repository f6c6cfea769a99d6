#include "common/system/interruption.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "support/temporary_folder.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

class Interruption : public TemporaryFolder {
 protected:
  /// Runs `work` in a process of its own, then sends that process a signal.
  /// @return what waitpid tells of its end
  static int endOf(int signal, const std::function<void()>& work) {
    int ready[2];
    if (::pipe(ready) != 0) return -1;
    const pid_t process = ::fork();
    if (process == 0) {
      ::close(STDERR_FILENO);
      work();
      (void)!::write(ready[1], "x", 1);
      ::sleep(20);
      ::_exit(0);
    }
    ::close(ready[1]);
    char byte = 0;
    (void)!::read(ready[0], &byte, 1);  // or its end
    ::kill(process, signal);
    int state = 0;
    ::waitpid(process, &state, 0);
    ::close(ready[0]);
    return state;
  }
};

TEST_F(Interruption, RemovesWhatIsUnfinishedAndExitsWithTheSignal) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::ofstream(file("half")) << "half";
    std::ofstream(file("whole")) << "whole";
    const int state = endOf(signal, [&] {
      ::signal(signal, SIG_DFL);
      cleanUpOnSignals();
      changeUnfinished([&](Unfinished& unfinished) {
        unfinished.files = {file("half"), file("whole")};
        unfinished.files.erase(file("whole"));
      });
    });
    ASSERT_TRUE(WIFEXITED(state)) << signal;
    EXPECT_EQ(WEXITSTATUS(state), 128 + signal);
    EXPECT_FALSE(fs::exists(file("half")));
    EXPECT_TRUE(fs::exists(file("whole")));
  }
}

TEST_F(Interruption, KillsTheHelpers) {
  int alive[2];
  ASSERT_EQ(::pipe(alive), 0);
  (void)endOf(SIGTERM, [&] {
    cleanUpOnSignals();
    changeUnfinished([&](Unfinished& unfinished) {
      const pid_t helper = ::fork();
      if (helper == 0) {
        ::pause();
        ::_exit(0);
      }
      unfinished.helpers.insert(helper);
    });
  });
  ::close(alive[1]);
  // Ends when the last process that has the other end is gone.
  char byte = 0;
  EXPECT_EQ(::read(alive[0], &byte, 1), 0);
  ::close(alive[0]);
}

TEST_F(Interruption, LeavesASignalIgnoredThatIs) {
  const int state = endOf(SIGINT, [] {
    ::signal(SIGINT, SIG_IGN);
    cleanUpOnSignals();
    ::kill(::getpid(), SIGINT);
    ::usleep(50'000);
    ::_exit(7);
  });
  ASSERT_TRUE(WIFEXITED(state));
  EXPECT_EQ(WEXITSTATUS(state), 7);
}

}  // namespace
}  // namespace gnomon
