#include "study/spec/study_text.h"

#include "common/files/input_file.h"

namespace gnomon::study {
namespace fs = std::filesystem;

StudyText readStudyText(const fs::path& file) {
  return {file, readFileOrStream(file)};
}

fs::path studyFolder(const fs::path& file) {
  return isGivenStream(file) ? fs::path() : file.parent_path();
}

}  // namespace gnomon::study
