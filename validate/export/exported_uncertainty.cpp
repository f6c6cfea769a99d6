#include "export/exported_uncertainty.h"

#include "common/files/input_file.h"
#include "report/json/json_reader.h"

namespace gnomon::exporting {
namespace fs = std::filesystem;

namespace {

/// What the masks of a view, or of its drawn mesh, state of a file.
std::optional<double> uncertaintyIn(const report::JsonReader& view, const fs::path& folder,
                                    const fs::path& file) {
  for (const report::JsonReader& entry : view.list("masks")) {
    const bool isIts = folder / entry.text("truth") == file ||
                       (entry.has("shares") && folder / entry.text("shares") == file);
    if (isIts && entry.has("uncertainty")) return entry.number("uncertainty");
  }
  return std::nullopt;
}

/// What an export states of a file; the folder is the export's.
std::optional<double> uncertaintyBy(const fs::path& index, const fs::path& file) {
  if (!pathExists(index)) return std::nullopt;
  const report::Json json = report::readJson(index);
  const report::JsonReader root(json, index.string(), "");
  const fs::path folder = index.parent_path();
  for (const report::JsonReader& view : root.list("views")) {
    if (const auto found = uncertaintyIn(view, folder, file)) return found;
    if (view.text("type") != "camera") continue;
    if (const auto found = uncertaintyIn(view.object("drawn"), folder, file)) return found;
  }
  return std::nullopt;
}

}  // namespace

std::array<fs::path, 2> exportIndices(const fs::path& truthMask) {
  const fs::path folder = fs::absolute(truthMask).lexically_normal().parent_path().parent_path();
  return {folder / "export.json", folder.parent_path() / "export.json"};
}

std::optional<double> exportedUncertainty(const fs::path& truthMask) {
  const fs::path file = fs::absolute(truthMask).lexically_normal();
  for (const fs::path& index : exportIndices(truthMask)) {
    if (const auto found = uncertaintyBy(index, file)) return found;
  }
  return std::nullopt;
}

}  // namespace gnomon::exporting
