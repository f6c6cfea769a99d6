#include "common/files/disk_sync.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace gnomon {
namespace fs = std::filesystem;
namespace {

void require(bool isDone, const fs::path& path) {
  const int error = errno;
  if (isDone || error == EINVAL || error == ENOTSUP || error == ENOSYS) return;
  throw fs::filesystem_error("sync", path, std::error_code(error, std::generic_category()));
}

template <typename Sync>
void inFolder(const fs::path& folder, const Sync& sync) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  require(descriptor >= 0, folder);
  const bool isDone = sync(descriptor) == 0;
  const int error = errno;
  ::close(descriptor);
  errno = error;
  require(isDone, folder);
}

}  // namespace

void syncFile(int descriptor, const fs::path& path) {
  require(::fsync(descriptor) == 0, path);
}

void syncFolder(const fs::path& folder) {
  inFolder(folder, ::fsync);
}

void syncFileSystem(const fs::path& folder) {
  inFolder(folder, ::syncfs);
}

}  // namespace gnomon
