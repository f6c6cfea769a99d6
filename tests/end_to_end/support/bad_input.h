#pragma once

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "end_to_end/support/program.h"

namespace gnomon::test {

/// A command that must fail, and how.
struct Failure {
  std::vector<std::string> arguments;
  int status;
  std::vector<std::string> mentions;          ///< what its one line must hold
  std::vector<std::string> environment = {};  ///< NAME=VALUE
};

/// A test of commands that must fail with one line, and leave nothing half-written.
class BadInput : public EndToEnd {
 protected:
  void expectFailure(const Failure& failure) const {
    SCOPED_TRACE(fmt::format("{}", fmt::join(failure.arguments, " ")));
    const Outcome outcome = gnomon(failure.arguments, failure.environment);
    EXPECT_EQ(outcome.status, failure.status) << outcome.err;
    // A check says on standard output how it ended, too.
    const bool isCheck = !failure.arguments.empty() && failure.arguments.front() == "check";
    if (!isCheck) EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, testing::StartsWith("gnomon: "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, testing::EndsWith("\n"));
    for (const std::string& text : failure.mentions)
      EXPECT_THAT(outcome.err, testing::HasSubstr(text));
    // A run that fails may leave pictures and the list of them, but whole ones, and no figures.
    for (const std::string& name : filesBelow("out")) {
      if (name.ends_with("/files.txt")) continue;
      EXPECT_TRUE(name.ends_with(".png")) << name;
      EXPECT_EQ(name.find(".part"), std::string::npos) << name;
      EXPECT_NO_THROW(readGrey(file("out") / name));
    }
  }
  void writeSmall() const { write("small.toml", smallStudy()); }

  static std::vector<std::string> imageChange(const std::string& image) {
    return {"relief={image=\"" + image + "\", height=4, height_space=\"world\"}"};
  }
};

}  // namespace gnomon::test
