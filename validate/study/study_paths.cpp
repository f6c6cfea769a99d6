#include "study/study_paths.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// The tables of a list, or of none.
template <typename Work>
void forEachTable(toml::node* list, const Work& work) {
  if (list == nullptr || !list->is_array()) return;
  for (toml::node& entry : *list->as_array()) {
    if (toml::table* table = entry.as_table()) work(*table);
  }
}

}  // namespace

std::string pathFrom(const fs::path& file, const fs::path& folder) {
  return fs::proximate(fs::absolute(file), fs::absolute(folder)).generic_string();
}

void movePath(toml::table& table, const char* key, const fs::path& from, const fs::path& to) {
  const auto path = table[key].value<std::string>();
  if (!path || fs::path(*path).is_absolute()) return;
  table.insert_or_assign(key, pathFrom(from / *path, to));
}

void movePaths(toml::table& study, const fs::path& from, const fs::path& to) {
  if (toml::table* relief = study["relief"].as_table()) movePath(*relief, "image", from, to);
  if (toml::table* surface = study["surface"].as_table()) movePath(*surface, "mesh", from, to);
  const auto moveShader = [&](toml::table& table) { movePath(table, "file", from, to); };
  forEachTable(study.get("method"), moveShader);
  forEachTable(study.get("ladder"), [&](toml::table& ladder) {
    moveShader(ladder);
    forEachTable(ladder.get("rung"), [&](toml::table& rung) {
      if (toml::table* set = rung["set"].as_table()) moveShader(*set);
    });
  });
}

}  // namespace gnomon
