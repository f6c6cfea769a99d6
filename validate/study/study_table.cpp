#include "study/study_table.h"

#include "study/method_replacement.h"
#include "study/toml_reader.h"

namespace gnomon {

toml::table studyTable(const std::filesystem::path& file, const StudyOptions& options) {
  toml::table table = parseToml(file);
  if (toml::array* methods = table["method"].as_array()) {
    for (const std::string& name : options.addedMethods) {
      methods->push_back(toml::table{{"name", name}});
    }
  }
  applyOverrides(table, options.overrides);
  replaceMethods(table, file, options.replacements);
  return table;
}

}  // namespace gnomon
