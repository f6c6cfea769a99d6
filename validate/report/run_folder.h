#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::report {

/// The files that tell what is in a folder of results.
struct FolderKind {
  std::string
      index;  ///< written last and removed first: where it is, all other files are whole; may be ""
  std::vector<std::string> others = {};  ///< that every run writes too, as far as they are known
  std::string list = "files.txt";        ///< names of all files that were written
};

/// A folder of results, with a list of the files that a run writes into it. The next run removes
/// the files of the list, and no others: a file that somebody else put there is neither removed nor
/// replaced. A name enters the list before its file is written, so that a run that is killed leaves
/// no file that the list lacks.
///
/// The list is a text: a first line that says what it is, then a name a line, relative to the
/// folder. A name that ends in `/` is that of a folder with a list of its own.
///
/// Lock the list's file while you use the folder: see FileLock.
class RunFolder {
 public:
  /// Reads the list; changes nothing. The folder need not be there.
  /// @throws InputError for a list that no run wrote, and for a file of the kind that it does not
  /// name
  RunFolder(std::filesystem::path folder, FolderKind kind);

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  [[nodiscard]] std::filesystem::path listFile() const { return folder_ / kind_.list; }
  /// Whether the list names a file or, with `/` at its end, a folder.
  [[nodiscard]] bool names(const std::string& name) const { return names_.contains(name); }
  /// All names of the list.
  [[nodiscard]] const std::set<std::string>& names() const { return names_; }

  /// @throws InputError where the list names one of these files, which a run is about to read
  void requireNone(std::span<const std::filesystem::path> inputs) const;

  /// Removes the index alone: the folder then holds no finished run.
  void removeIndex();
  /// Removes the files of the list, those of the lists of its folders, what killed writers left
  /// among them, and folders that are then empty; begins a new list.
  /// @param kept  files that stay, wherever they are, and stay in their list
  /// @throws InputError where something cannot be removed or the list cannot be written
  void clear(std::span<const std::filesystem::path> kept = {});
  /// As above; the list goes too, unless a file stays.
  void remove(std::span<const std::filesystem::path> kept = {});

  /// Takes over a file that is there, or a folder with a list of its own.
  void add(const std::string& name);
  /// The path of a new file, which is then in the list.
  /// @throws InputError where there is a file that the list does not name
  std::filesystem::path newFile(const std::string& name);
  /// Writes a file, whole or not at all.
  /// @throws InputError likewise, or where it cannot be written
  void write(const std::string& name, std::string_view bytes);
  /// Waits until all files are on the disk, then writes the index.
  void finish(std::string_view index);
  /// The same of a kind without an index.
  void finish();

 private:
  /// @return names of what stays
  [[nodiscard]] std::set<std::string> removeFiles(std::span<const std::filesystem::path> kept);
  void removeFolders() const;
  void requireFree(const std::string& name) const;
  void writeList(std::set<std::string> names);

  std::filesystem::path folder_;
  FolderKind kind_;
  std::set<std::string> names_;
};

}  // namespace gnomon::report
