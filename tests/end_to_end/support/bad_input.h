#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "end_to_end/support/program.h"

namespace gnomon::test {

/// A command that must fail, and how.
struct Failure {
  std::string name;  ///< of the case
  std::vector<std::string> arguments;
  int status;
  std::vector<std::string> mentions;  ///< what its one line must hold
};

/// A test of commands that must fail with one line, and leave nothing half-written.
class BadInput : public EndToEnd {
 protected:
  void expectFailure(const Failure& failure) const {
    SCOPED_TRACE(failure.name);
    const Outcome outcome = gnomon(failure.arguments);
    EXPECT_EQ(outcome.status, failure.status) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, testing::StartsWith("gnomon: "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(!outcome.err.empty() && outcome.err.back() == '\n');
    for (const std::string& text : failure.mentions)
      EXPECT_THAT(outcome.err, testing::HasSubstr(text));
    expectNothingHalfWritten();
  }
  /// A run that fails may leave pictures and the list of them, but whole ones, and no figures.
  void expectNothingHalfWritten() const {
    for (const std::string& name : filesBelow("out")) {
      if (name.ends_with("/files.txt")) continue;
      EXPECT_TRUE(name.size() > 4 && name.substr(name.size() - 4) == ".png") << name;
      EXPECT_EQ(name.find(".part"), std::string::npos) << name;
      EXPECT_NO_THROW(readGrey(file("out") / name));
    }
  }
  /// Runs the small study with changes on the command line.
  void expectFailureWith(const std::vector<std::string>& changes, int status,
                         const std::vector<std::string>& mentions) const {
    std::vector<std::string> arguments = {"run", "small.toml"};
    for (const std::string& change : changes) {
      arguments.emplace_back("--set");
      arguments.push_back(change);
    }
    std::vector<std::string> all = mentions;
    all.emplace_back("small.toml");
    expectFailure({changes.empty() ? "" : changes.front(), arguments, status, all});
  }
  void writeSmall() const { write("small.toml", smallStudy()); }

  static std::vector<std::string> imageChange(const std::string& image) {
    return {"relief={image=\"" + image + "\", height=4, height_space=\"world\"}"};
  }
  static std::vector<std::string> meshChange(const std::string& mesh) {
    return {"surface={mesh=\"" + mesh + "\"}"};
  }
};

}  // namespace gnomon::test
