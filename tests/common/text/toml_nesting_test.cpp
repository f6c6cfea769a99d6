#include "common/text/toml_nesting.h"

#include <gtest/gtest.h>

#include <string>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon {
namespace {

std::string repeated(std::string_view text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

TEST(TomlNesting, OfAStudyIsShallow) {
  EXPECT_EQ(tooDeepTomlLine(""), std::nullopt);
  EXPECT_EQ(tooDeepTomlLine("[surface]\ncage = [[0.5, 1.5, -2.25], [1, 2, 3]]\n[[method]]\n"
                            "parameters.steps.x = { a = 1, b.c = [2] } # [[[[\n"),
            std::nullopt);
}

TEST(TomlNesting, IsBoundedForEveryKindOfIt) {
  for (const auto& [opening, closing] :
       {std::pair("[", "]"), std::pair("{a=", "}"), std::pair("[{a=", "}]")}) {
    const int each = std::string_view(opening).size() == 4 ? 2 : 1;
    const auto nested = [&, o = opening, c = closing](int depth) {
      return "first = 1\nx = " + repeated(o, depth / each) + "1" + repeated(c, depth / each);
    };
    EXPECT_EQ(tooDeepTomlLine(nested(mostTomlNesting)), std::nullopt) << opening;
    EXPECT_EQ(tooDeepTomlLine(nested(mostTomlNesting + each)), 2) << opening;
  }
  const auto key = [](int parts) { return "a" + repeated(".a", parts - 1); };
  for (const char* opening : {"", "[", "[[", "x = { b = 1, ", "x = [\n{ "}) {
    EXPECT_EQ(tooDeepTomlLine(opening + key(mostTomlNesting) + " = 1"), std::nullopt) << opening;
    EXPECT_TRUE(tooDeepTomlLine(opening + key(mostTomlNesting + 1) + " = 1")) << opening;
  }
  EXPECT_EQ(tooDeepTomlLine("\n\n" + repeated("'a' . \"b.\" . ", 40) + "c = 1"), 3);
}

TEST(TomlNesting, CountsOnlyWhatIsInsideOfEachOther) {
  EXPECT_EQ(tooDeepTomlLine(repeated("[[light]]\nangles = [1.5, 2.5, {a.b = 1}]\n", 1000)),
            std::nullopt);
  EXPECT_EQ(tooDeepTomlLine("x = [" + repeated("1.5, ", 1000) + "]"), std::nullopt);
  EXPECT_EQ(tooDeepTomlLine("x = [" + repeated("1.5,\n", 1000) + "]"), std::nullopt);
}

TEST(TomlNesting, PassesOverStringsAndComments) {
  const std::string deep = repeated("[", 200) + repeated("a.", 200);
  for (const std::string& text : {
           "x = \"" + deep + "\"",
           "x = '" + deep + "'",
           "x = \"\\\"" + deep + "\"",
           "x = \"\"\"\n" + deep + "\n\"\"\"",
           "x = '''\n'' " + deep + "\n'''",
           "x = \"\"\"a\\\"\"\"" + deep + "\"\"\"",
           "# " + deep,
           "x = 1 # " + deep + "\ny = 2",
       }) {
    EXPECT_EQ(tooDeepTomlLine(text), std::nullopt) << text;
  }
}

TEST(TomlNesting, SeesWhatComesAfterStringsAndComments) {
  const std::string deep = repeated("[", 200);
  for (const std::string& text : {
           "x = [\"\", " + deep,
           "x = ['', " + deep,
           "x = ['\\', " + deep,
           "x = [\"\\\\\", " + deep,
           "x = [\"\"\"\"\"\", " + deep,
           "x = [\"\"\"a\"\"\"\"\", " + deep,
           "x = ['''a'''', " + deep,
           "x = 1 # \"\ny = " + deep,
           "x = \"unfinished\ny = " + deep,
           "x = [\"\"\"\n\\\n\"\"\", " + deep,
       }) {
    EXPECT_TRUE(tooDeepTomlLine(text)) << text;
  }
}

TEST(TomlNesting, RefusalNamesFileAndLine) {
  EXPECT_EQ(messageOf<InputError>([] { requireShallowToml("a.toml", "\nx=" + repeated("[", 99)); }),
            "a.toml:2: nested too deep, at most 64 brackets or parts of a key expected");
  EXPECT_NO_THROW(requireShallowToml("a.toml", "x = [1]"));
}

}  // namespace
}  // namespace gnomon
