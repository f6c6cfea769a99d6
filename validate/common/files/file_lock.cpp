#include "common/files/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace gnomon {

FileLock::FileLock(const std::filesystem::path& file, Wait wait)
    : file_(::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666)) {
  if (file_ < 0) return;
  const int operation = wait == Wait::yes ? LOCK_EX : LOCK_EX | LOCK_NB;
  int result = ::flock(file_, operation);
  while (result != 0 && errno == EINTR) result = ::flock(file_, operation);
  state_ = result == 0 ? State::held : errno == EWOULDBLOCK ? State::elsewhere : State::noLocks;
}

FileLock::FileLock(FileLock&& other) noexcept
    : file_(std::exchange(other.file_, -1)), state_(other.state_) {}

FileLock::~FileLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace gnomon
