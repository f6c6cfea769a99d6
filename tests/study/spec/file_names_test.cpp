#include <gtest/gtest.h>

#include <set>

#include "study/spec/file_names.h"

namespace gnomon::study {
namespace {

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

}  // namespace
}  // namespace gnomon::study
