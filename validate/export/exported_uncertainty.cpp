#include "export/exported_uncertainty.h"

#include "common/files/input_file.h"
#include "report/json/json_reader.h"

namespace gnomon::exporting {
namespace fs = std::filesystem;

std::optional<double> exportedUncertainty(const fs::path& truthMask) {
  const fs::path mask = fs::absolute(truthMask).lexically_normal();
  const fs::path folder = mask.parent_path().parent_path();
  const fs::path index = folder / "export.json";
  if (!pathExists(index)) return std::nullopt;
  const report::Json json = report::readJson(index);
  const report::JsonReader root(json, index.string(), "");
  for (const report::JsonReader& view : root.list("views")) {
    for (const report::JsonReader& entry : view.list("masks")) {
      if (folder / entry.text("truth") == mask) return entry.number("uncertainty");
    }
  }
  return std::nullopt;
}

}  // namespace gnomon::exporting
