#include "report/run_folder.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <sstream>
#include <system_error>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/files/disk_sync.h"
#include "common/files/part_file.h"

namespace gnomon::report {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view firstLine =
    "# Written by a run of gnomon: its files in this folder, which the next run removes.";

/// Of names that a list may hold: none leads out of the folder.
bool isInside(const std::string& name) {
  const fs::path path(name);
  const bool isPlain = std::all_of(path.begin(), path.end(), [](const fs::path& part) {
    return part != ".." && part != "." && !part.string().empty();
  });
  return !name.empty() && path.is_relative() && isPlain;
}

std::string withoutSlash(const std::string& name) {
  return name.ends_with('/') ? name.substr(0, name.size() - 1) : name;
}

/// The names of a list; none where there is no such file.
std::optional<std::set<std::string>> readList(const fs::path& file) {
  std::error_code failure;
  const fs::file_status status = fs::symlink_status(file, failure);
  if (!fs::exists(status)) return std::nullopt;
  const auto refuse = [&](std::size_t line, const std::string& found) -> InputError {
    return InputError(fmt::format("{}:{}: {} found, a run's list of its files expected",
                                  file.string(), line, found));
  };
  constexpr std::uintmax_t mostBytes = 1 << 26;
  if (!fs::is_regular_file(status)) throw refuse(1, "no file");
  if (fs::file_size(file) > mostBytes) throw refuse(1, "a larger file");
  const std::string text = readFile(file);
  std::set<std::string> names;
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    // A killed run may have left a part of a line, whose file is not there.
    if (lines.eof()) break;
    if (number == 1 && line != firstLine) throw refuse(1, "another first line");
    if (number == 1) continue;
    if (!isInside(withoutSlash(line))) throw refuse(number, "\"" + line + "\"");
    names.insert(line);
  }
  // Empty, or only a part of the first line: it was begun.
  if (names.empty() && !firstLine.starts_with(text.substr(0, text.find('\n')))) {
    throw refuse(1, "another first line");
  }
  return names;
}

void append(const fs::path& file, const std::string& text, bool anew) {
  const int mode = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | (anew ? O_TRUNC : O_APPEND);
  const int descriptor = ::open(file.c_str(), mode, 0666);
  const off_t before = descriptor < 0 ? 0 : ::lseek(descriptor, 0, SEEK_END);
  errno = descriptor < 0 ? errno : ENOSPC;  // which a part that is written does not set
  const bool isWritten =
      descriptor >= 0 && ::write(descriptor, text.data(), text.size()) == std::ssize(text);
  const int error = errno;
  if (descriptor >= 0) {
    // No name that is written later may be joined to a part of this one.
    const bool isWhole = isWritten || ::ftruncate(descriptor, before) == 0;
    (void)isWhole;
    ::close(descriptor);
  }
  if (isWritten) return;
  throw InputError(fmt::format("{}: cannot be written: {}", file.string(),
                               std::generic_category().message(error)));
}

bool isThere(const fs::path& path) {
  std::error_code failure;
  return fs::exists(fs::symlink_status(path, failure));
}

/// Whether a path still lies in the folder when links are followed: a linked folder holds others'.
bool liesIn(const fs::path& folder, const fs::path& path) {
  std::error_code failure;
  const fs::path above = fs::canonical(path.parent_path(), failure);
  if (failure) return false;
  const fs::path whole = fs::canonical(folder, failure);
  if (failure) return false;
  return std::mismatch(whole.begin(), whole.end(), above.begin(), above.end()).first == whole.end();
}

bool isOneOf(const fs::path& path, std::span<const fs::path> files) {
  return std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
    std::error_code failure;
    return fs::equivalent(path, file, failure);
  });
}

void removeFile(const fs::path& path) {
  std::error_code failure;
  const fs::file_status status = fs::symlink_status(path, failure);
  if (!fs::exists(status) || fs::is_directory(status)) return;
  fs::remove(path, failure);
  if (!failure) return;
  throw InputError(fmt::format("{}: cannot be removed: {}", path.string(), failure.message()));
}

/// The folders below it that hold a file of the list, the deepest first.
std::set<fs::path, std::greater<>> foldersOf(const std::set<std::string>& names) {
  std::set<fs::path, std::greater<>> folders;
  for (const std::string& name : names) {
    for (fs::path above = fs::path(name).parent_path(); !above.empty();
         above = above.parent_path()) {
      folders.insert(above);
    }
  }
  return folders;
}

}  // namespace

RunFolder::RunFolder(fs::path folder, FolderKind kind)
    : folder_(std::move(folder)), kind_(std::move(kind)) {
  names_ = readList(listFile()).value_or(std::set<std::string>{});
  if (!kind_.index.empty()) requireFree(kind_.index);
  for (const std::string& name : kind_.others) requireFree(name);
}

void RunFolder::requireFree(const std::string& name) const {
  if (names(name) || !isThere(folder_ / name)) return;
  throw InputError(
      fmt::format("{}: is in the way: no run's list of its files ({}) names it, so it is not "
                  "replaced; move it away, or choose another --out",
                  (folder_ / name).string(), kind_.list));
}

void RunFolder::requireNone(std::span<const fs::path> inputs) const {
  for (const std::string& name : names_) {
    if (!isOneOf(folder_ / name, inputs)) continue;
    throw InputError(fmt::format(
        "{}: an earlier run wrote this file, the new one would read it and remove it; move it "
        "away, or choose another --out",
        (folder_ / name).string()));
  }
}

void RunFolder::removeIndex() {
  if (names(kind_.index)) removeFile(folder_ / kind_.index);
}

std::set<std::string> RunFolder::removeFiles(std::span<const fs::path> kept) {
  removeIndex();
  std::set<std::string> staying;
  for (const std::string& name : names_) {
    const fs::path path = folder_ / name;
    if (!liesIn(folder_, path)) continue;
    if (name.ends_with('/')) {
      RunFolder below(folder_ / withoutSlash(name), kind_);
      below.remove(kept);
      if (!below.names_.empty()) staying.insert(name);
    } else if (isOneOf(path, kept)) {
      staying.insert(name);
    } else {
      removeFile(path);
    }
  }
  removeLeftovers(folder_);
  for (const fs::path& folder : foldersOf(names_)) {
    if (liesIn(folder_, folder_ / folder / "any")) removeLeftovers(folder_ / folder);
  }
  return staying;
}

void RunFolder::removeFolders() const {
  std::error_code isNotEmpty;
  for (const fs::path& folder : foldersOf(names_)) {
    if (liesIn(folder_, folder_ / folder)) fs::remove(folder_ / folder, isNotEmpty);
  }
}

void RunFolder::writeList(std::set<std::string> names) {
  names_ = std::move(names);
  std::string text = std::string(firstLine) + "\n";
  for (const std::string& name : names_) text += name + "\n";
  append(listFile(), text, true);
}

void RunFolder::clear(std::span<const fs::path> kept) {
  std::set<std::string> staying = removeFiles(kept);
  removeFolders();
  std::error_code failure;  // which writing the list tells too
  fs::create_directories(folder_, failure);
  writeList(std::move(staying));
}

void RunFolder::remove(std::span<const fs::path> kept) {
  if (!isThere(listFile())) return;
  std::set<std::string> staying = removeFiles(kept);
  if (!staying.empty()) return writeList(std::move(staying));
  removeFile(listFile());
  removeFolders();
  names_.clear();
}

void RunFolder::add(const std::string& name) {
  if (!names_.insert(name).second) return;
  append(listFile(), name + "\n", false);
}

fs::path RunFolder::newFile(const std::string& name) {
  requireFree(name);
  add(name);
  return folder_ / name;
}

void RunFolder::write(const std::string& name, std::string_view bytes) {
  const fs::path path = newFile(name);
  replaceFile(path, bytes, Sync::later, path.parent_path());
}

void RunFolder::finish() {
  syncFileSystem(folder_);
}

void RunFolder::finish(std::string_view index) {
  finish();
  const fs::path path = newFile(kind_.index);
  replaceFile(path, index, Sync::now, folder_);
}

}  // namespace gnomon::report
