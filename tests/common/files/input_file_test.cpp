#include "common/files/input_file.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <string_view>
#include <thread>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

class InputFile : public TemporaryFolder {
 protected:
  [[nodiscard]] std::string refusal(const std::string& name) const {
    return withoutFolder(messageOf<InputError>([&] { readFile(file(name)); }));
  }
};

/// A pipe into which a thread writes, as a shell gives one to a program.
class Pipe {
 public:
  explicit Pipe(std::string text) {
    if (::pipe(ends_) != 0) ADD_FAILURE() << std::strerror(errno);
    writer_ = std::thread([this, text = std::move(text)] {
      std::string_view rest = text;
      while (!rest.empty()) {
        const ssize_t taken = ::write(ends_[1], rest.data(), rest.size());
        if (taken <= 0) break;  // the reader has seen enough
        rest.remove_prefix(static_cast<std::size_t>(taken));
      }
      ::close(ends_[1]);
    });
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    ::close(ends_[0]);
    writer_.join();
  }
  [[nodiscard]] fs::path path() const { return "/dev/fd/" + std::to_string(ends_[0]); }

 private:
  int ends_[2] = {-1, -1};
  std::thread writer_;
};

TEST_F(InputFile, RefusesAFifoWithoutWaitingForAWriter) {
  ASSERT_EQ(::mkfifo(file("study.toml").c_str(), 0600), 0);
  EXPECT_EQ(refusal("study.toml"), "study.toml: is a FIFO, a file was expected");
  fs::create_symlink(file("study.toml"), file("link.toml"));
  EXPECT_EQ(refusal("link.toml"), "link.toml: is a FIFO, a file was expected");
}

TEST_F(InputFile, RefusesWhatIsNoFileByItsKind) {
  fs::create_directory(file("folder"));
  EXPECT_EQ(refusal("folder"), "folder: is a folder, a file was expected");
  fs::create_symlink("/dev/null", file("null"));
  EXPECT_EQ(refusal("null"), "null: is a device, a file was expected");
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, file("socket").c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(refusal("socket"), "socket: is a socket, a file was expected");
  ::close(socket);
}

TEST_F(InputFile, RefusalsSayWhy) {
  EXPECT_EQ(refusal("none"), "none: no such file");
  fs::create_symlink("nowhere", file("link"));
  EXPECT_EQ(refusal("link"), "link: no such file");
  EXPECT_THAT(refusal(std::string(300, 'n')), EndsWith("n: cannot be read: File name too long"));
  fs::create_symlink("loop", file("loop"));
  EXPECT_EQ(refusal("loop"), "loop: cannot be read: Too many levels of symbolic links");
  std::ofstream(file("plain")) << "text";
  EXPECT_EQ(refusal("plain/below"), "plain/below: no such file");
}

TEST_F(InputFile, RefusesOneThatMayNotBeRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read everything";
  std::ofstream(file("secret")) << "text";
  fs::permissions(file("secret"), fs::perms::none);
  EXPECT_EQ(refusal("secret"), "secret: cannot be read: Permission denied");
}

// Pages that are not mapped read as an error, as a damaged disk does.
TEST_F(InputFile, NoticesThatReadingFails) {
  EXPECT_EQ(messageOf<InputError>([] { readFile("/proc/self/mem"); }),
            "/proc/self/mem: cannot be read: Input/output error");
  EXPECT_EQ(messageOf<InputError>([&] { readBytes(folder()); }),
            folder().string() + ": cannot be read: Is a directory");
}

TEST_F(InputFile, ReadsFilesThatDoNotTellTheirSize) {
  EXPECT_THAT(readFile("/proc/self/status"), AllOf(HasSubstr("Name:"), HasSubstr("Threads:")));
  EXPECT_GT(readFile("/proc/self/exe").size(), 10'000U);
}

TEST_F(InputFile, ReadsEverySizeAroundItsSteps) {
  for (const std::size_t size : {0UL, 1UL, 65'535UL, 65'536UL, 65'537UL, 200'000UL}) {
    const std::string bytes(size, '\0');
    std::ofstream(file("bytes"), std::ios::binary) << bytes;
    EXPECT_EQ(readFile(file("bytes")), bytes);
    EXPECT_EQ(readFileOrStream(file("bytes")), bytes);
    EXPECT_EQ(readFileOrStream(Pipe(bytes).path()), bytes);
  }
}

TEST_F(InputFile, TellsWhetherSomethingIsThere) {
  EXPECT_TRUE(isThere(folder()));
  EXPECT_FALSE(isThere(file("none")));
  EXPECT_FALSE(isThere(file("none/below")));
  std::ofstream(file("plain")) << "text";
  EXPECT_FALSE(isThere(file("plain/below")));
  EXPECT_THAT(messageOf<InputError>([&] { (void)isThere(file(std::string(300, 'n'))); }),
              EndsWith("cannot be read: File name too long"));
}

TEST_F(InputFile, KnowsTheStreamsThatAProcessIsGiven) {
  for (const char* name :
       {"/dev/stdin", "/dev/fd/0", "/dev/fd/63", "/proc/self/fd/3", "/dev/../dev/stdin"}) {
    EXPECT_TRUE(isGivenStream(name)) << name;
  }
  for (const char* name : {"stdin", "/dev/null", "/dev/fd", "dev/stdin", "/tmp/dev/stdin", ""}) {
    EXPECT_FALSE(isGivenStream(name)) << name;
  }
}

TEST_F(InputFile, APipeIsReadWhereItIsGivenAlone) {
  const Pipe pipe("text");
  EXPECT_THAT(messageOf<InputError>([&] { readFile(pipe.path()); }),
              EndsWith("is a FIFO, a file was expected"));
  EXPECT_EQ(readFileOrStream(pipe.path()), "text");
  ASSERT_EQ(::mkfifo(file("study.toml").c_str(), 0600), 0);
  EXPECT_THAT(messageOf<InputError>([&] { readFileOrStream(file("study.toml")); }),
              EndsWith("is a FIFO, a file was expected"));
}

TEST_F(InputFile, APipeIsBounded) {
  ::signal(SIGPIPE, SIG_IGN);
  EXPECT_THAT(messageOf<InputError>([] {
                readFileOrStream(Pipe(std::string((std::size_t{1} << 26U) + 1, 'x')).path());
              }),
              EndsWith("more than 67.1 MB found"));
}

}  // namespace
}  // namespace gnomon
