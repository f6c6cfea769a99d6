#include "common/system/child_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <memory>

#include "support/temporary_folder.h"

namespace gnomon {
namespace {

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

class ChildProcess : public TemporaryFolder {
 protected:
  /// Runs a line of the shell to its end.
  int stateOf(const std::string& line, ChildProgram program = {}) {
    program.words = {"sh", "-c", line};
    program.out = out.get();
    program.err = err.get();
    const ChildStart started = startChild(program);
    EXPECT_EQ(started.failure, 0);
    return endOfChild(started.process, true).value_or(-1);
  }
  File out{std::tmpfile()};
  File err{std::tmpfile()};
};

TEST_F(ChildProcess, HasItsStreamsItsFolderAndItsVariables) {
  File in(std::tmpfile());
  std::fputs("given", in.get());
  std::rewind(in.get());
  ChildProgram program;
  program.in = in.get();
  program.folder = file("");
  program.variables = {{"ONE=1", "PATH=/usr/bin:/bin"}};
  const int state =
      stateOf("cat; echo \" $ONE$HOME\"; touch made; echo wrong >&2; exit 7", program);
  EXPECT_EQ(WEXITSTATUS(state), 7);
  EXPECT_EQ(contentOf(out.get()), "given 1\n");
  EXPECT_EQ(contentOf(err.get()), "wrong\n");
  EXPECT_TRUE(std::filesystem::exists(file("made")));
}

TEST_F(ChildProcess, WithoutAnInputReadsNothing) {
  EXPECT_EQ(stateOf("cat"), 0);
  EXPECT_EQ(contentOf(out.get()), "");
}

TEST_F(ChildProcess, DiesOfASignalThatThisProcessIgnores) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  const int state = stateOf("kill -PIPE $$");
  std::signal(SIGPIPE, before);
  ASSERT_TRUE(WIFSIGNALED(state));
  EXPECT_EQ(WTERMSIG(state), SIGPIPE);
}

TEST_F(ChildProcess, IsAskedWithoutWaiting) {
  const ChildStart started = startChild({{"sleep", "60"}, {}, {}, nullptr, out.get(), err.get()});
  ASSERT_EQ(started.failure, 0);
  EXPECT_EQ(endOfChild(started.process, false), std::nullopt);
  ::kill(started.process, SIGKILL);
  EXPECT_EQ(WTERMSIG(endOfChild(started.process, true).value_or(0)), SIGKILL);
}

TEST_F(ChildProcess, ThatIsNoneHasFailed) {
  EXPECT_EQ(WEXITSTATUS(endOfChild(::getpid(), true).value_or(0)), 127);
}

TEST_F(ChildProcess, ThatIsNotThereHasAReason) {
  EXPECT_EQ(startChild({{"no-such-program"}, {}, {}, nullptr, out.get(), err.get()}).failure,
            ENOENT);
}

}  // namespace
}  // namespace gnomon
