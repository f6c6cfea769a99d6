#include "common/text/shell_quote.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

namespace gnomon {
namespace {

/// What a shell makes of words.
std::string echoed(const std::string& words) {
  const std::string command = "printf '%s|' " + words;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe.get()) != nullptr) text += buffer.data();
  return text;
}

TEST(ShellQuote, LeavesPlainWordsAlone) {
  for (const char* word : {"scenes/figure8.toml", "--set", "relief.height=4", "a_b@1:2,3%+-"}) {
    EXPECT_EQ(shellQuoted(word), word);
  }
}

TEST(ShellQuote, IsReadBackByAShell) {
  for (const std::string word :
       {"", "two words", "it's", "''", "a;b", "$HOME", "`id`", "\"x\"", "\\", "*", "~", "a\nb", "!",
        "{1,2}", "resampled-horizon, 8 azimuths", "elevation 30°", "#no", "x=[1, 2]"}) {
    EXPECT_EQ(echoed(shellQuoted(word) + " " + shellQuoted(word)), word + "|" + word + "|");
  }
}

}  // namespace
}  // namespace gnomon
