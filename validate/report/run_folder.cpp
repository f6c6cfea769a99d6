#include "report/run_folder.h"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "report/json/results_json.h"
#include "report/json/summary_json.h"
#include "report/page/case_html.h"
#include "report/page/overview_html.h"
#include "report/page/report_html.h"
#include "report/paper_files.h"
#include "report/plots/line_plot.h"
#include "report/plots/study_plots.h"
#include "report/tables/case_tables.h"
#include "report/tables/confidence.h"
#include "report/tables/cost_table.h"
#include "report/tables/ranked_table.h"
#include "report/tables/sweep_tables.h"
#include "report/tables/table.h"
#include "report/view_images.h"

namespace gnomon::report {

namespace fs = std::filesystem;
namespace {

constexpr std::string_view firstLine =
    "# Written by a run of gnomon: its files in this folder, which the next run removes.";

/// Of names that a list may hold: none leads out of the folder.
bool isInside(const std::string& name) {
  const fs::path path(name);
  return path.is_relative() && std::none_of(path.begin(), path.end(), [](const fs::path& part) {
           return part == ".." || part == ".";
         });
}

/// The names of a list; none where there is no such file.
std::set<std::string> readList(const fs::path& file) {
  std::error_code failure;
  const fs::file_status status = fs::symlink_status(file, failure);
  if (!fs::exists(status)) return {};
  const auto refuse = [&](std::size_t line, const std::string& found) -> InputError {
    return InputError(fmt::format("{}:{}: {} found, a run's list of its files expected",
                                  file.string(), line, found));
  };
  constexpr std::uintmax_t mostBytes = 1 << 26;
  if (!fs::is_regular_file(status)) throw refuse(1, "no file");
  if (fs::file_size(file) > mostBytes) throw refuse(1, "a larger file");
  std::istringstream lines(readFile(file));
  std::string line;
  if (!std::getline(lines, line) || line != firstLine) throw refuse(1, "another first line");
  std::set<std::string> names;
  for (std::size_t number = 2; std::getline(lines, line); ++number) {
    if (line.empty() || !isInside(line)) throw refuse(number, "\"" + line + "\"");
    names.insert(line);
  }
  return names;
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

void removeFile(const fs::path& path) {
  std::error_code failure;
  const fs::file_status status = fs::symlink_status(path, failure);
  if (!fs::exists(status) || fs::is_directory(status)) return;
  fs::remove(path, failure);
  if (!failure) return;
  throw InputError(fmt::format("{}: cannot be removed: {}", path.string(), failure.message()));
}

/// The files below a folder that no run's list names, relative to it.
std::vector<fs::path> othersIn(const fs::path& folder, const std::string& list) {
  std::vector<fs::path> others;
  if (!isThere(folder)) return others;
  const std::set<std::string> names = readList(folder / list);
  for (fs::recursive_directory_iterator it(folder), end; it != end; ++it) {
    const fs::path name = it->path().lexically_relative(folder);
    if (fs::is_directory(it->symlink_status())) {
      if (!names.contains(name.string() + "/")) continue;
      it.disable_recursion_pending();
      for (const fs::path& other : othersIn(it->path(), list)) others.push_back(name / other);
    } else if (name != list && !names.contains(name.string())) {
      others.push_back(name);
    }
  }
  return others;
}

InputError isInTheWay(const fs::path& path, const std::string& list) {
  return InputError(
      fmt::format("{}: is in the way: no run's list of its files ({}) names it, so it is not "
                  "replaced; move it away, or choose another --out",
                  path.string(), list));
}

/// Gives a file of somebody else a second name, in a folder of the same file system; where that
/// has no such names, a copy.
void keepOther(const fs::path& from, const fs::path& to) {
  fs::create_directories(to.parent_path());
  std::error_code failure;
  if (!fs::is_symlink(fs::symlink_status(from))) fs::create_hard_link(from, to, failure);
  if (failure || !isThere(to)) fs::copy(from, to, fs::copy_options::copy_symlinks);
}

}  // namespace

RunFolder::RunFolder(fs::path place, FolderKind kind)
    : place_(std::move(place)), kind_(std::move(kind)), names_(readList(place_ / kind_.list)) {
  if (!kind_.index.empty()) requireFree(kind_.index);
  for (const std::string& name : kind_.others) requireFree(name);
}

RunFolder::RunFolder(RunFolder& above, const std::string& name)
    : place_(above.place_ / name),
      kind_(above.kind_),
      part_(above.part_),
      below_(above.below_ / name) {
  above.add(name + "/");
}

fs::path RunFolder::path() const {
  if (!part_ || part_->path().empty()) return place_;
  return below_.empty() ? part_->path() : part_->path() / below_;
}

void RunFolder::requireFree(const std::string& name) const {
  if (!names(name) && isThere(path() / name)) throw isInTheWay(path() / name, kind_.list);
}

void RunFolder::requireNone(std::span<const fs::path> inputs) const {
  for (const std::string& name : names_) {
    const fs::path path = place_ / name;
    const bool isRead = std::any_of(inputs.begin(), inputs.end(), [&](const fs::path& input) {
      std::error_code failure;
      return fs::equivalent(path, input, failure);
    });
    if (!isRead) continue;
    throw InputError(fmt::format(
        "{}: an earlier run wrote this file, the new one would read it and remove it; move it "
        "away, or choose another --out",
        path.string()));
  }
}

void RunFolder::clear() {
  if (names(kind_.index)) removeFile(place_ / kind_.index);
  if (kind_.isShared) {
    for (const std::string& name : names_) {
      if (!name.ends_with('/') && liesIn(place_, place_ / name)) removeFile(place_ / name);
    }
    removeFile(place_ / kind_.list);
  } else {
    part_ = std::make_shared<PartFolder>(place_);
  }
  names_.clear();
}

fs::path RunFolder::newFile(const std::string& name) {
  requireFree(name);
  const bool isNew = names_.insert(name).second;
  // In its place the list names a file before it is there.
  if (isNew && (!part_ || part_->path().empty())) writeList();
  return path() / name;
}

void RunFolder::write(const std::string& name, std::string_view bytes) {
  const fs::path path = newFile(name);
  replaceFile(path, bytes, Sync::later, path.parent_path());
}

void RunFolder::writeList() const {
  std::string text = std::string(firstLine) + "\n";
  for (const std::string& name : names_) text += name + "\n";
  replaceFile(path() / kind_.list, text, Sync::later, path());
}

void RunFolder::takePlace() {
  if (!part_ || part_->path().empty() || !below_.empty()) return;
  try {
    for (const fs::path& other : othersIn(place_, kind_.list)) {
      if (isThere(path() / other)) throw isInTheWay(place_ / other, kind_.list);
      keepOther(place_ / other, path() / other);
    }
    part_->nameIt(place_);
  } catch (const fs::filesystem_error& error) {
    throw InputError(
        fmt::format("{}: cannot be replaced: {}", place_.string(), error.code().message()));
  }
}

void RunFolder::finish() {
  writeList();
  syncFileSystem(path());
  takePlace();
}

void RunFolder::finish(std::string_view index) {
  names_.insert(kind_.index);
  writeList();
  syncFileSystem(path());
  replaceFile(path() / kind_.index, index, Sync::now, path());
  takePlace();
}

namespace {

/// Draws the plots of the methods that they show, and writes them.
std::vector<DrawnPlot> writePlots(const std::vector<LinePlot>& plots, RunFolder& folder,
                                  cache::Cache& cache) {
  std::vector<DrawnPlot> drawn = drawPlots(sheetsOf(plots), &cache);
  for (const DrawnPlot& plot : drawn) {
    folder.write(fmt::format("plots/{}.svg", plot.sheet.name), plot.svg);
    folder.write(fmt::format("plots/{}.pdf", plot.sheet.name), plot.pdf);
  }
  return drawn;
}

}  // namespace

void writeRunFiles(const study::StudyRecord& record, const PaperOptions& paper, RunFolder& folder,
                   cache::Cache& cache) {
  folder.write("metrics.csv", csvTable(metricsTable(record)));
  const Table ranked = rankedTable(record, study::rankMethods(record));
  for (const TableFormat& format : tableFormats()) {
    if (format.isFile) folder.write(fmt::format("table.{}", format.name), format.print(ranked));
  }
  writePaperFiles(record, paper, folder);
  const auto writeRows = [&](const char* name, const Table& table) {
    if (!table.rows.empty()) folder.write(name, csvTable(table));
  };
  writeRows("bins.csv", binsTable(record));
  writeRows("frontier.csv", frontierTable(frontier(record, Price::memory)));
  writeRows("budget.csv", budgetPartsTable(record));
  const std::vector<DrawnPlot> plots =
      writePlots(studyPlots(record, plottedMethods(study::studyMeans(record))), folder, cache);
  for (const CasePage& page : casePages(record, folder.path())) {
    folder.write(page.file, page.page.text());
  }
  folder.write("report.html", reportHtml(record, folder.path(), plots).text());
  folder.finish(summaryJson(record));
}

void writeSweepFiles(const study::SweepRecord& sweep, const PaperOptions& paper, RunFolder& folder,
                     cache::Cache& cache) {
  folder.write("sweep.csv", csvTable(sweepMeansTable(sweep)));
  folder.write("cases.csv", longCsv(sweep));
  writePaperFiles(sweep, paper, folder);
  const std::vector<DrawnPlot> plots =
      writePlots(sweepPlots(sweep, plottedMethods(study::studyMeans(sweep))), folder, cache);
  folder.write("report.html", sweepHtml(sweep, plots).text());
  folder.finish(sweepJson(sweep));
}

study::StudyRecord figuresAlone(study::StudyRecord record, bool isStep) {
  record.timings.clear();
  record.cache.reset();
  record.truth.bvhBytes.reset();
  record.environment.threads = 0;
  if (isStep) record.bins = {};
  return record;
}

void writeFigureFiles(const study::StudyRecord& record, RunFolder& folder) {
  folder.write("cases.csv", longCsv(record));
  folder.finish(summaryJson(record));
}

void writeFigureFiles(const study::SweepRecord& sweep, RunFolder& folder) {
  folder.write("cases.csv", longCsv(sweep));
  folder.finish(sweepJson(sweep));
}

std::string FolderWriter::mask(const Mask& mask) const {
  return image::pngOf(image::maskImage(mask));
}

std::string FolderWriter::shares(const Visibility& map) const {
  return image::sharePng(map);
}

std::string FolderWriter::regions(const truth::Truth& truth) const {
  return image::pngOf(regionImage(truth));
}

std::string FolderWriter::weights(int width, int height, const std::vector<double>& weights) const {
  image::ChannelImage image{width, height, {"area"}, {}};
  image.values.reserve(weights.size());
  for (const double weight : weights) image.values.push_back(static_cast<float>(weight));
  return image::exrBytes(image);
}

std::string FolderWriter::picture(int width, int height, std::vector<std::uint8_t> rgb) const {
  return image::pngOf(image::Image{width, height, std::move(rgb)});
}

std::string FolderWriter::difference(const Mask& candidate, const Mask& truth) const {
  return image::pngOf(image::differenceImage(candidate, truth));
}

std::string FolderWriter::difference(const Visibility& candidate, const Visibility& truth) const {
  return image::pngOf(image::shareDifferenceImage(candidate, truth));
}

std::string FolderWriter::embedded(int width, int height, std::vector<std::uint8_t> rgb,
                                   study::EmbeddedSize size) const {
  const image::Image image{width, height, std::move(rgb)};
  return size == study::EmbeddedSize::small
             ? image::webPicture(image, image::smallQuality, image::smallSide)
             : image::webPicture(image, image::fineQuality);
}

std::vector<std::uint8_t> FolderWriter::displaced(int width, int height,
                                                  const std::vector<float>& light) const {
  return displacedImage(width, height, light).rgb;
}

void FolderWriter::beQuiet() {
  if (quiet_) quiet_();
}

void FolderWriter::write(const std::string& path, const std::string& bytes) {
  folder_.write(path, bytes);
}

}  // namespace gnomon::report
