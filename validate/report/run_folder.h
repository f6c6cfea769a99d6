#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cache/cache.h"
#include "common/files/atomic_file.h"
#include "report/tables/latex_table.h"
#include "study/record/record.h"
#include "study/record/sweep_record.h"
#include "study/run/stages/run_writer.h"

namespace gnomon::report {

/// The files that tell what is in a folder of results.
struct FolderKind {
  std::string index;  ///< written last: where it is, all other files are whole; may be ""
  std::vector<std::string> others = {};  ///< that every run writes too, as far as they are known
  std::string list = "files.txt";        ///< names of all files that were written
  /// Whether the files lie among those of others, as a ranking beside the folders of its studies.
  bool isShared = false;
};

/// A folder of results. A run writes its files into a part folder (PartFolder) beside it, which
/// takes its place when all are written: a run that is killed leaves no other trace, and of two at
/// once the later one stays. The list in it names its files, so that the next run can tell them
/// from files that somebody else put there: those stay.
///
/// Files of a shared kind are written one by one, and `clear` removes those of an earlier run.
///
/// The list is a text: a first line that says what it is, then a name a line, relative to the
/// folder. A name that ends in `/` is that of a folder with a list of its own.
class RunFolder {
 public:
  /// Reads the list; changes nothing. The folder need not be there.
  /// @throws InputError for a list that no run wrote, and for a file of the kind that it does not
  /// name
  RunFolder(std::filesystem::path place, FolderKind kind);
  /// A folder in one that is being written, which gets its place with that one.
  RunFolder(RunFolder& above, const std::string& name);

  /// Where its files will be.
  [[nodiscard]] const std::filesystem::path& place() const { return place_; }
  /// Where they are now: in the part folder, until it has taken its place.
  [[nodiscard]] std::filesystem::path path() const;
  /// Whether the list names a file or, with `/` at its end, a folder.
  [[nodiscard]] bool names(const std::string& name) const { return names_.contains(name); }
  /// All names of the list.
  [[nodiscard]] const std::set<std::string>& names() const { return names_; }

  /// @throws InputError where the list names one of these files, which a run is about to read
  void requireNone(std::span<const std::filesystem::path> inputs) const;

  /// Begins a run's files: the index of an earlier one goes, of a shared kind all of its files.
  /// @throws InputError where something cannot be removed or the folder cannot be made
  void clear();

  /// Takes a name into the list.
  void add(const std::string& name) { names_.insert(name); }
  /// The path of a new file, which is then in the list.
  /// @throws InputError where there is a file of somebody else
  std::filesystem::path newFile(const std::string& name);
  /// Writes a file, whole or not at all.
  /// @throws InputError likewise, or where it cannot be written
  void write(const std::string& name, std::string_view bytes);
  /// Waits until all files are on the disk, writes list and index, and gives the folder its place.
  /// Files that are written afterwards replace those there, one by one, until this is called again.
  /// @throws InputError where a file of somebody else has the name of one of its own
  void finish(std::string_view index);
  /// The same of a kind without an index.
  void finish();

 private:
  void takePlace();
  void writeList() const;
  void requireFree(const std::string& name) const;

  std::filesystem::path place_;
  FolderKind kind_;
  std::set<std::string> names_;
  std::shared_ptr<PartFolder> part_;  ///< none before `clear`, and of a shared kind
  std::filesystem::path below_;       ///< relative to the part folder; of one in another
};

/// The files of a run beside its pictures. Each is written whole or not at all.

/// Writes a study's: metrics.csv, bins.csv, frontier.csv, budget.csv (where there are any), its
/// ranked table as table.csv and .md, what papers take (paper_files.h), plots/NAME.svg and .pdf,
/// report.html, and last summary.json, so that its presence says that the run is whole. An older
/// one goes first.
/// @param cache  keeps plots
/// @throws InputError for a file that cannot be written or a picture that cannot be read;
///   InternalError as the writers
void writeRunFiles(const study::StudyRecord& record, const PaperOptions& paper, RunFolder& folder,
                   cache::Cache& cache);

/// Writes a sweep's: sweep.csv, cases.csv, what papers take, its plots as plots/*.svg and .pdf,
/// report.html, summary.json.
/// @throws likewise
void writeSweepFiles(const study::SweepRecord& sweep, const PaperOptions& paper, RunFolder& folder,
                     cache::Cache& cache);

/// What a run with `--metrics-only` leaves: figures, and nothing that two runs of the same study
/// with the same program do not share. Folders are the same, byte for byte.

/// A record without what tells of the run alone: times, threads, the cache's counts, and the memory
/// of the ray tracing structure.
/// @param isStep  of a sweep, whose long table has no bins: these go too
study::StudyRecord figuresAlone(study::StudyRecord record, bool isStep);

/// Writes cases.csv (longCsv), then summary.json.
/// @throws InputError for a file that cannot be written
void writeFigureFiles(const study::StudyRecord& record, RunFolder& folder);
/// Likewise a sweep's.
void writeFigureFiles(const study::SweepRecord& sweep, RunFolder& folder);

/// Writes the pictures of a run into its folder, as PNG files; what a page embeds is WebP.
class FolderWriter : public study::RunWriter {
 public:
  /// @param folder  outlives the writer
  /// @param quiet   waits for what goes on beside the run
  explicit FolderWriter(RunFolder& folder, std::function<void()> quiet = {})
      : folder_(folder), quiet_(std::move(quiet)) {}

  [[nodiscard]] std::string mask(const Mask& mask) const override;
  [[nodiscard]] std::string shares(const Visibility& map) const override;
  [[nodiscard]] std::string regions(const truth::Truth& truth) const override;
  [[nodiscard]] std::string weights(int width, int height,
                                    const std::vector<double>& weights) const override;
  [[nodiscard]] std::string picture(int width, int height,
                                    std::vector<std::uint8_t> rgb) const override;
  [[nodiscard]] std::string difference(const Mask& candidate, const Mask& truth) const override;
  [[nodiscard]] std::string difference(const Visibility& candidate,
                                       const Visibility& truth) const override;
  [[nodiscard]] std::string embedded(int width, int height, std::vector<std::uint8_t> rgb,
                                     study::EmbeddedSize size) const override;
  [[nodiscard]] std::vector<std::uint8_t> displaced(int width, int height,
                                                    const std::vector<float>& light) const override;
  void write(const std::string& path, const std::string& bytes) override;
  void beQuiet() override;

 private:
  RunFolder& folder_;
  std::function<void()> quiet_;
};

}  // namespace gnomon::report
