#include "common/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <optional>
#include <system_error>

#include "common/error.h"
#include "common/files/input_file.h"
#include "common/files/part_file.h"

namespace gnomon {

namespace fs = std::filesystem;
namespace {

InputError cannotBeWritten(const fs::path& path, const std::string& reason) {
  return InputError(fmt::format("{}: cannot be written: {}", path.string(), reason));
}

/// What a path that is to be written stands for.
struct Target {
  fs::path path;                  ///< behind all links
  bool isReplaceable = true;      ///< a file, or nothing yet
  std::optional<int> descriptor;  ///< an open stream of this process
};

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// N of /proc/self/fd/N.
std::optional<int> descriptorOf(const fs::path& folder, const fs::path& path) {
  std::error_code failure;
  if (folder != fs::canonical("/proc/self/fd", failure) || failure) return std::nullopt;
  const std::string name = path.filename().string();
  int number = 0;
  const auto parsed = std::from_chars(name.data(), name.data() + name.size(), number);
  if (parsed.ec != std::errc() || parsed.ptr != name.data() + name.size()) return std::nullopt;
  return number;
}

Target targetOf(const fs::path& path) {
  std::error_code failure;
  Target target{path, true, std::nullopt};
  constexpr int mostLinks = 40;  // as the system has it
  for (int links = 0; links < mostLinks; ++links) {
    const fs::path folder = fs::canonical(folderOf(target.path), failure);
    if (failure) return target;  // it has to be made, or writing says why it cannot be
    target.descriptor = descriptorOf(folder, target.path);
    const fs::file_status status = fs::symlink_status(target.path, failure);
    target.isReplaceable =
        !target.descriptor && (!fs::exists(status) || fs::is_regular_file(status));
    // The links of /proc are no names of what they lead to.
    const bool isInProc = folder.string().starts_with("/proc/");
    if (target.descriptor || isInProc || !fs::is_symlink(status)) return target;
    target.path = folder / fs::read_symlink(target.path, failure);
  }
  throw cannotBeWritten(path, "a link that leads to itself");
}

/// Writes to what is there: a device, a pipe, a stream.
void writeDirectly(const Target& target, const std::function<void(int file)>& write) {
  std::fflush(nullptr);
  const int file = target.descriptor ? ::dup(*target.descriptor)
                                     : ::open(target.path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  if (file < 0) throw fs::filesystem_error("open", {errno, std::generic_category()});
  try {
    write(file);
  } catch (...) {
    ::close(file);
    throw;
  }
  if (::close(file) != 0) throw fs::filesystem_error("close", {errno, std::generic_category()});
}

void createFolders(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (!failure) return;
  throw InputError(
      fmt::format("{}: cannot create the folder: {}", folder.string(), failure.message()));
}

void finish(PartFile& part, const fs::path& path, Sync sync) {
  if (sync == Sync::now) syncFile(part.descriptor(), path);
  part.nameIt(path);
  if (sync == Sync::now) syncFolder(folderOf(path));
}

/// Says of what the system refuses which file could not be written.
template <typename Work>
void writing(const fs::path& path, const Work& work) {
  try {
    work();
  } catch (const fs::filesystem_error& error) {
    throw cannotBeWritten(path, error.code().message());
  }
}

}  // namespace

void writeAll(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw fs::filesystem_error("write", {errno, std::generic_category()});
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void writeAtomically(const fs::path& path, const std::function<void(int file)>& write, Sync sync) {
  const Target target = targetOf(path);
  if (!target.isReplaceable) return writing(path, [&] { writeDirectly(target, write); });
  createFolders(folderOf(target.path));
  writing(path, [&] {
    PartFile part(folderOf(target.path), target.path.extension().string());
    write(part.descriptor());
    if (::lseek(part.descriptor(), 0, SEEK_END) == 0) throw cannotBeWritten(path, "nothing was");
    finish(part, target.path, sync);
  });
}

void writeTextAtomically(const fs::path& path, std::string_view text) {
  const Target target = targetOf(path);
  if (!target.isReplaceable)
    return writing(path, [&] { writeDirectly(target, [&](int file) { writeAll(file, text); }); });
  createFolders(folderOf(target.path));
  removeLeftovers(folderOf(target.path));
  writing(path, [&] { replaceFile(target.path, text, Sync::now, folderOf(target.path)); });
}

void replaceFile(const fs::path& path, std::string_view text, Sync sync,
                 const fs::path& workplace) {
  createFolders(folderOf(path));
  writing(path, [&] {
    PartFile part(workplace, path.extension().string());
    writeAll(part.descriptor(), text);
    finish(part, path, sync);
  });
}

std::string readFile(const fs::path& path) {
  requireFile(path);
  return readBytes(path);
}

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
