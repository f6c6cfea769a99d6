#include "study/spec/sections/study_paths.h"

#include <gmock/gmock.h>

#include <string_view>

#include "study/spec/study_text.h"
#include "study/spec/toml/toml_text.h"

namespace gnomon::study {
namespace {

namespace fs = std::filesystem;

TEST(PathText, IsThePathItselfWhereTomlCanHoldIt) {
  for (const char* path :
       {"a.png", "../heights/a b.png", "/tmp/ä/日本.obj", "100%.png", "a:b", ""}) {
    EXPECT_EQ(pathText(path), path);
    EXPECT_EQ(pathOf(path), path);
  }
}

TEST(PathText, EncodesBytesThatAreNoText) {
  EXPECT_EQ(pathText("../caf\xE9/a b.png"), "file:../caf%E9/a%20b.png");
  EXPECT_EQ(pathText("file:x"), "file:file%3Ax");
  EXPECT_EQ(stemText("../caf\xE9.glsl"), "caf%E9");
  EXPECT_EQ(stemText("../file:a b.glsl"), "file:a b");
}

TEST(PathText, WhatIsNoEncodingStaysAsItIs) {
  EXPECT_EQ(pathOf("file:a%"), "a%");
  EXPECT_EQ(pathOf("file:a%4"), "a%4");
  EXPECT_EQ(pathOf("file:%zz%+1%41"), "%zz%+1A");
}

TEST(PathText, ReadsBackToTheByteWhateverTheNameHolds) {
  for (int first = 1; first < 256; ++first) {
    for (int second = 1; second < 256; ++second) {
      const std::string name{static_cast<char>(first), static_cast<char>(second)};
      const std::string text = pathText(name);
      ASSERT_EQ(pathOf(text).native(), name);
      ASSERT_NO_THROW((void)tomlText(toml::table{{"file", text}}));
    }
  }
}

TEST(PathText, MovesPathsThatAreNoText) {
  toml::table table{{"image", "file:a%E9.png"}};
  movePath(table, "image", "/studies", "/studies/out/x");
  EXPECT_EQ(table["image"].value<std::string>(), "file:../../a%E9.png");
  movePath(table, "image", "/studies/out/x", "/studies/caf\xE9");
  EXPECT_EQ(table["image"].value<std::string>(), "file:../a%E9.png");
  movePath(table, "image", "/studies/caf\xE9", "/other");
  EXPECT_EQ(table["image"].value<std::string>(), "file:../studies/a%E9.png");
  table = toml::table{{"image", "file:/a%E9.png"}};
  movePath(table, "image", "/studies", "/other");
  EXPECT_EQ(table["image"].value<std::string>(), "file:/a%E9.png") << "absolute";
}

TEST(StudyFolder, IsTheFilesOrTheWorkingDirectory) {
  EXPECT_EQ(studyFolder("scenes/a.toml"), "scenes");
  EXPECT_EQ(studyFolder("a.toml"), "");
  EXPECT_EQ(studyFolder("/dev/stdin"), "");
  EXPECT_EQ(studyFolder("/dev/fd/63"), "");
  EXPECT_EQ(studyFolder("/dev/shm/a.toml"), "/dev/shm");
}

}  // namespace
}  // namespace gnomon::study
