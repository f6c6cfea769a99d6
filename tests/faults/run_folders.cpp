#include "faults/run_folders.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace gnomon::test {
namespace fs = std::filesystem;
namespace {

bool isIndex(const std::string& name) {
  const std::string file = fs::path(name).filename().string();
  return file == "summary.json" || file == "truth.json" || file == "export.json";
}

/// Or the command, which names a folder.
bool holdsTimes(const std::string& name) {
  const std::string file = fs::path(name).filename().string();
  return isIndex(name) || file == "report.html" || file.starts_with("table.") ||
         file == "ranking.json" || file == "ranking.html" || file.ends_with(".pdf") ||
         file.ends_with("frame-time.svg");
}

/// Or a file in a part folder.
bool isPartFile(const std::string& name) {
  return name.starts_with(".gnomon-") || name.find("/.gnomon-") != std::string::npos;
}

/// The files of one folder with an index, without the folders below that have their own.
FolderContent partOf(const FolderContent& content, const std::string& folder) {
  std::vector<std::string> below;
  for (const auto& [name, bytes] : content) {
    if (!name.starts_with(folder) || !name.ends_with("/files.txt")) continue;
    below.push_back(name.substr(0, name.size() - std::string("files.txt").size()));
  }
  FolderContent part;
  for (const auto& [name, bytes] : content) {
    if (!name.starts_with(folder) || isPartFile(name)) continue;
    const bool isBelow = std::any_of(below.begin(), below.end(), [&](const std::string& other) {
      return other.size() > folder.size() && name.starts_with(other);
    });
    if (!isBelow) part.emplace(name, bytes);
  }
  return part;
}

}  // namespace

std::string otherStudy() {
  std::string text = smallStudy();
  text = replaced(text, "name = \"evening\"", "name = \"morning\"");
  text = replaced(text, "height = 4\n", "height = 3\n");
  return replaced(text, "name = \"max-forsyth\"", "name = \"onoue-2004\"");
}

FolderContent contentOf(const fs::path& folder) {
  FolderContent content;
  if (!fs::exists(folder)) return content;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) continue;
    const std::string name = entry.path().lexically_relative(folder).string();
    std::ostringstream bytes;
    if (!holdsTimes(name)) bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    content.emplace(name, std::move(bytes).str());
  }
  return content;
}

std::vector<std::string> differences(const FolderContent& a, const FolderContent& b) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : a) {
    const auto other = b.find(name);
    if (other == b.end() || other->second != bytes) names.push_back(name);
  }
  for (const auto& [name, bytes] : b) {
    if (!a.contains(name)) names.push_back(name);
  }
  return names;
}

std::vector<std::string> partFilesBelow(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : contentOf(folder)) {
    if (isPartFile(name)) names.push_back(name);
  }
  return names;
}

Shown shownBy(const FolderContent& folder, const std::vector<FolderContent>& wholeRuns) {
  Shown shown = Shown::notWhole;
  for (const auto& [name, bytes] : folder) {
    const fs::path path(name);
    if (!isIndex(name) || isPartFile(name)) continue;
    const std::string prefix = path.has_parent_path() ? path.parent_path().string() + "/" : "";
    const FolderContent found = partOf(folder, prefix);
    const bool isOne =
        std::any_of(wholeRuns.begin(), wholeRuns.end(),
                    [&](const FolderContent& run) { return found == partOf(run, prefix); });
    if (!isOne) return Shown::mixed;
    shown = Shown::whole;
  }
  return shown;
}

}  // namespace gnomon::test
