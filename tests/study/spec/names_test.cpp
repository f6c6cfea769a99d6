#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <set>
#include <string_view>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "study/spec/method_changes.h"
#include "study/spec/sections/study_files.h"
#include "study/spec/study_file.h"
#include "study/spec/study_sections.h"
#include "study/spec/toml_reader.h"
#include "support/error_messages.h"

namespace gnomon::study {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

using Names = std::vector<std::string>;

TEST(FileNames, KeepLettersDigitsDotsAndDashes) {
  EXPECT_EQ(fileNames({"onoue-2004", "elevation 24.5° azimuth 165°", "(a) max-forsyth", "a/b\\c"}),
            (Names{"onoue-2004", "elevation-24.5-azimuth-165", "a-max-forsyth", "a-b-c"}));
}

TEST(FileNames, AreDistinctForDistinctEntries) {
  EXPECT_EQ(fileNames({"a b", "a-b", "a_b", "a-b-2"}), (Names{"a-b", "a-b-2", "a-b-3", "a-b-2-2"}));
}

TEST(FileNames, AreNeverEmptyAndNeverALeadOutOfTheFolder) {
  EXPECT_EQ(fileNames({"", "°°", "///"}), (Names{"unnamed", "unnamed-2", "unnamed-3"}));
  for (const std::string& name : fileNames({"../../etc", "a/../b", std::string("\0x", 2)})) {
    EXPECT_EQ(name.find('/'), std::string::npos) << name;
    EXPECT_EQ(name.find('\0'), std::string::npos) << name;
  }
}

TEST(FileNames, LeaveNamesThatAreTaken) {
  EXPECT_EQ(fileNames({"truth", "truth!", "other"}, {"truth", "displaced"}),
            (Names{"truth-2", "truth-3", "other"}));
}

TEST(FileNames, AreShortEnoughForAFileSystem) {
  const Names names = fileNames({std::string(500, 'x'), std::string(501, 'x')});
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 2U);
  for (const std::string& name : names) EXPECT_LE(name.size(), 70U);
}

TEST(PathText, IsThePathItselfWhereTomlCanHoldIt) {
  for (const char* path :
       {"a.png", "../heights/a b.png", "/tmp/ä/日本.obj", "100%.png", "a:b", ""}) {
    EXPECT_EQ(fileText(path), path);
    EXPECT_EQ(fileOf(path), path);
  }
}

TEST(PathText, EncodesBytesThatAreNoText) {
  EXPECT_EQ(fileText("../caf\xE9/a b.png"), "file:../caf%E9/a%20b.png");
  EXPECT_EQ(fileText("file:x"), "file:file%3Ax");
  EXPECT_EQ(stemText("../caf\xE9.glsl"), "caf%E9");
  EXPECT_EQ(stemText("../file:a b.glsl"), "file:a b");
}

TEST(PathText, WhatIsNoEncodingStaysAsItIs) {
  EXPECT_EQ(fileOf("file:a%"), "a%");
  EXPECT_EQ(fileOf("file:a%4"), "a%4");
  EXPECT_EQ(fileOf("file:%zz%+1%41"), "%zz%+1A");
}

TEST(PathText, ReadsBackToTheByteWhateverTheNameHolds) {
  for (int first = 1; first < 256; ++first) {
    for (int second = 1; second < 256; ++second) {
      const std::string name{static_cast<char>(first), static_cast<char>(second)};
      const std::string text = fileText(name);
      ASSERT_EQ(fileOf(text).native(), name);
      ASSERT_NO_THROW((void)tomlText(toml::table{{"file", text}}));
    }
  }
}

TEST(PathText, MovesPathsThatAreNoText) {
  toml::table table{{"image", "file:a%E9.png"}};
  moveFile(table, "image", "/studies", "/studies/out/x");
  EXPECT_EQ(table["image"].value<std::string>(), "file:../../a%E9.png");
  moveFile(table, "image", "/studies/out/x", "/studies/caf\xE9");
  EXPECT_EQ(table["image"].value<std::string>(), "file:../a%E9.png");
  moveFile(table, "image", "/studies/caf\xE9", "/other");
  EXPECT_EQ(table["image"].value<std::string>(), "file:../studies/a%E9.png");
  table = toml::table{{"image", "file:/a%E9.png"}};
  moveFile(table, "image", "/studies", "/other");
  EXPECT_EQ(table["image"].value<std::string>(), "file:/a%E9.png") << "absolute";
}

TEST(StudyFolder, IsTheFilesOrTheWorkingDirectory) {
  EXPECT_EQ(studyFolder("scenes/a.toml"), "scenes");
  EXPECT_EQ(studyFolder("a.toml"), "");
  EXPECT_EQ(studyFolder("/dev/stdin"), "");
  EXPECT_EQ(studyFolder("/dev/fd/63"), "");
  EXPECT_EQ(studyFolder("/dev/shm/a.toml"), "/dev/shm");
}

TEST(WithKeys, ReturnsWhatTheWorkReturns) {
  EXPECT_EQ(withKeys("truth", [] { return 7; }), 7);
}

TEST(WithKeys, PutsTheKeyInThePlaceOfTheParameter) {
  EXPECT_EQ(messageOf<InputError>([] {
              withKeys("truth", []() -> int { throw InputError("0 texels found", "step"); });
            }),
            "truth.step: 0 texels found");
  EXPECT_EQ(messageOf<MemoryError>([] {
              withKeys("bake", []() -> int { throw MemoryError("too many", "azimuths"); });
            }),
            "bake.azimuths: too many");
}

TEST(WithKeys, LeavesErrorsAloneThatNameNoParameter) {
  EXPECT_EQ(messageOf<InputError>(
                [] { withKeys("truth", []() -> int { throw InputError("cage: no faces"); }); }),
            "cage: no faces");
  EXPECT_THROW(withKeys("truth", []() -> int { throw InternalError("a fault"); }), InternalError);
}

TEST(TomlText, HasSectionsInOrderAndShortNumbers) {
  const toml::table table = toml::parse(R"(
light = [{elevation = 30}, {elevation = 0.1, azimuth = 1e-7}]
[study]
title = 'A "b" ü'
ranked = false
[method]
bake = {bits = 8, radius = 8.0}
points = [[1, 2], [3.5, -4]]
empty = []
)");
  EXPECT_EQ(tomlText(table, {"study", "nothing", "method"}), R"([study]
ranked = false
title = 'A "b" ü'

[method]
bake = { bits = 8, radius = 8.0 }
empty = []
points = [
  [1, 2],
  [3.5, -4],
]

[[light]]
elevation = 30

[[light]]
azimuth = 1e-07
elevation = 0.1
)");
}

TEST(TomlText, ReadsBackToTheBit) {
  toml::table table{{"a", toml::table{{"third", 1.0 / 3},
                                      {"whole", 4.0},
                                      {"large", 1e300},
                                      {"infinite", std::numeric_limits<double>::infinity()},
                                      {"lines", "one\ntwo ' three \" \\ \t"},
                                      {"an odd key", 1}}}};
  EXPECT_TRUE(toml::parse(tomlText(table)) == table);
}

TEST(TomlText, RefusesWhatTomlCannotHold) {
  EXPECT_THROW(tomlText(toml::table{{"a", "not-\xff-text"}}), InputError);
}

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
