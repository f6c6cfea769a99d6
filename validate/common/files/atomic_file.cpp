#include "common/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <random>
#include <regex>
#include <system_error>
#include <vector>

#include "common/error.h"
#include "common/files/input_file.h"
#include "common/system/process.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void failWith(int error, const char* what, const fs::path& path) {
  throw fs::filesystem_error(what, path, std::error_code(error, std::generic_category()));
}

/// Of the kernel that runs, the same in all its containers; of the host's name where it is not
/// told.
std::string readMachine() {
  std::string id;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> id;
  constexpr std::size_t digits = 8;
  if (id.find_first_not_of("0123456789abcdef") == digits) return id.substr(0, digits);
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  return fmt::format("{:08x}", std::hash<std::string>{}(host)&0xffffffffU);
}

const std::string& machine() {
  static const std::string id = readMachine();
  return id;
}

std::string newName(const std::string& extension) {
  std::random_device random;
  constexpr std::size_t longest = 16;  // of those by which image writers choose a format
  return fmt::format(".gnomon-{}-{}-{:08x}{:08x}.part{}", machine(), ::getpid(), random(), random(),
                     extension.size() <= longest ? extension : "");
}

bool isSameFile(int descriptor, const fs::path& path) {
  struct stat open {};
  struct stat named {};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

bool lockNow(int descriptor) {
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

/// The machine that a part file's name tells; empty for any other file.
std::string machineOf(const std::string& name) {
  if (!name.starts_with(".gnomon-")) return "";
  static const std::regex pattern(R"(\.gnomon-([0-9a-f]{8})-[0-9]+-[0-9a-f]{16}\.part(\..*)?)");
  std::smatch match;
  return std::regex_match(name, match, pattern) ? match[1].str() : "";
}

bool isOld(const struct stat& file) {
  constexpr auto hour = std::chrono::hours(1);
  const auto written = std::chrono::system_clock::from_time_t(file.st_mtime);
  return std::chrono::system_clock::now() - written > hour;
}

void removeLeftover(const fs::path& path, bool isOfHere) {
  constexpr int flags = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  int file = ::open(path.c_str(), O_RDWR | flags);
  if (file < 0 && errno == EISDIR) file = ::open(path.c_str(), O_RDONLY | flags);
  if (file < 0) return;
  struct stat state {};
  const bool isOurs =
      ::fstat(file, &state) == 0 && (S_ISREG(state.st_mode) || S_ISDIR(state.st_mode));
  std::error_code ignored;
  if (isOurs && lockNow(file) && (isOfHere || isOld(state))) fs::remove_all(path, ignored);
  ::close(file);
}

}  // namespace

PartFile::PartFile(const fs::path& folder, const std::string& extension) {
  // Another process may take a file for a leftover between its creation and its lock: then it is
  // gone or locked, and the next one is tried.
  for (int attempt = 0; attempt < 100; ++attempt) {
    const fs::path path = folder / newName(extension);
    int error = 0;
    changeUnfinished([&](Unfinished& unfinished) {
      file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      error = errno;
      if (file_ >= 0) unfinished.files.insert(path);
    });
    if (file_ < 0 && error == EEXIST) continue;
    if (file_ < 0) failWith(error, "cannot be created", path);
    path_ = path;
    const bool isLocked = lockNow(file_);
    const bool canLock = isLocked || errno == EWOULDBLOCK;
    if (!canLock || (isLocked && isSameFile(file_, path))) return;
    ::close(file_);
    changeUnfinished([&](Unfinished& unfinished) { unfinished.files.erase(path); });
    path_.clear();
  }
  failWith(EBUSY, "cannot be created", folder);
}

PartFile::~PartFile() {
  if (!path_.empty()) {
    changeUnfinished([&](Unfinished& unfinished) {
      ::unlink(path_.c_str());
      unfinished.files.erase(path_);
    });
  }
  ::close(file_);
}

void PartFile::nameIt(const fs::path& name) {
  changeUnfinished([&](Unfinished& unfinished) {
    fs::rename(path_, name);
    unfinished.files.erase(path_);
  });
  path_.clear();
}

PartFolder::PartFolder(const fs::path& beside) {
  const fs::path above = beside.has_parent_path() ? beside.parent_path() : fs::path(".");
  try {
    fs::create_directories(above);
    removeLeftovers(above);
    // As of a file, another process may take it for a leftover before it is locked.
    while (true) {
      const fs::path path = above / newName("");
      changeUnfinished([&](Unfinished& unfinished) {
        fs::create_directory(path);
        unfinished.files.insert(path);
      });
      folder_ = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      const bool isLocked = folder_ >= 0 && lockNow(folder_);
      const bool canLock = isLocked || errno == EWOULDBLOCK || errno == ENOENT;
      if (!canLock || (isLocked && isSameFile(folder_, path))) {
        path_ = path;
        return;
      }
      if (folder_ >= 0) ::close(folder_);
      changeUnfinished([&](Unfinished& unfinished) { unfinished.files.erase(path); });
    }
  } catch (const fs::filesystem_error& error) {
    throw InputError(
        fmt::format("{}: cannot create the folder: {}", beside.string(), error.code().message()));
  }
}

PartFolder::~PartFolder() {
  if (!path_.empty()) {
    changeUnfinished([&](Unfinished& unfinished) {
      std::error_code ignored;
      fs::remove_all(path_, ignored);
      unfinished.files.erase(path_);
    });
  }
  if (folder_ >= 0) ::close(folder_);
}

void PartFolder::nameIt(const fs::path& name) {
  const fs::path old = path_.parent_path() / newName("");
  changeUnfinished([&](Unfinished& unfinished) {
    // Another process may give a folder of its own that name in between.
    while (true) {
      std::error_code failure;
      fs::rename(name, old, failure);
      fs::rename(path_, name, failure);
      std::error_code ignored;
      fs::remove_all(old, ignored);
      if (!failure) break;
      if (failure != std::errc::directory_not_empty && failure != std::errc::file_exists) {
        throw fs::filesystem_error("rename", name, failure);
      }
    }
    unfinished.files.erase(path_);
  });
  path_.clear();
}

void removeLeftovers(const fs::path& folder) {
  std::error_code failure;
  std::vector<fs::path> found;
  for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    if (!machineOf(it->path().filename().string()).empty()) found.push_back(it->path());
  }
  for (const fs::path& path : found) {
    removeLeftover(path, machineOf(path.filename().string()) == machine());
  }
}

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
