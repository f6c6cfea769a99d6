#include "study/spec/study_table.h"

#include "common/files/atomic_file.h"
#include "study/spec/method_replacement.h"
#include "study/spec/toml/toml_reader.h"

namespace gnomon::study {

toml::table studyTable(const StudyText& study, const StudyOptions& options) {
  toml::table table = parseTomlText(study.text, study.file.string());
  if (toml::array* methods = table["method"].as_array()) {
    for (const std::string& name : options.addedMethods) {
      methods->push_back(toml::table{{"name", name}});
    }
  }
  applyOverrides(table, options.overrides);
  replaceMethods(table, study.file, options.replacements);
  return table;
}

toml::table studyTable(const std::filesystem::path& file, const StudyOptions& options) {
  return studyTable(StudyText{file, readFile(file)}, options);
}

}  // namespace gnomon::study
