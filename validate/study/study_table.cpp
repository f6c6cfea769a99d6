#include "study/study_table.h"

#include "study/method_replacement.h"
#include "study/toml_reader.h"

namespace gnomon {

toml::table studyTable(const std::filesystem::path& file, const StudyOptions& options) {
  toml::table table = parseToml(file, options.overrides);
  replaceMethods(table, file, options.replacements);
  return table;
}

}  // namespace gnomon
