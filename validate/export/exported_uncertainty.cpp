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

/// What the export of a folder states of a file.
std::optional<double> uncertaintyBy(const fs::path& folder, const fs::path& file) {
  const fs::path index = folder / "export.json";
  if (!pathExists(index)) return std::nullopt;
  const report::Json json = report::readJson(index);
  const report::JsonReader root(json, index.string(), "");
  for (const report::JsonReader& view : root.list("views")) {
    if (const auto found = uncertaintyIn(view, folder, file)) return found;
    if (view.text("type") != "camera") continue;
    if (const auto found = uncertaintyIn(view.object("drawn"), folder, file)) return found;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> exportedUncertainty(const fs::path& truthMask) {
  const fs::path file = fs::absolute(truthMask).lexically_normal();
  const fs::path folder = file.parent_path().parent_path();
  const auto found = uncertaintyBy(folder, file);
  return found ? found : uncertaintyBy(folder.parent_path(), file);
}

}  // namespace gnomon::exporting
