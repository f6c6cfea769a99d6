#include "study/spec/study_sections.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "common/files/atomic_file.h"

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;

/// docs/study-keys.md is what `gnomon list keys` prints.
TEST(StudySections, TheManualHasEveryKeyAsItIsDeclared) {
  const std::filesystem::path folder = GNOMON_SCENES;
  EXPECT_EQ(readFile(folder.parent_path() / "docs/study-keys.md"), studyKeysText())
      << "Run `gnomon list keys > docs/study-keys.md`";
}

TEST(StudySections, EverySectionHasATable) {
  const std::string text = studyKeysText();
  for (const StudyKey& section : studySections()) {
    EXPECT_THAT(text, HasSubstr("[" + std::string(section.name) + "]"));
  }
}

}  // namespace
}  // namespace gnomon::study
