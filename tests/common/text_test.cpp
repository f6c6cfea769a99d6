#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>

#include "common/error.h"
#include "common/files/input_file.h"
#include "common/text.h"
#include "support/error_messages.h"

namespace gnomon {
namespace {

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, TakesAnyByte) {
  EXPECT_EQ(base64(std::string_view("\xfb\xff\xbf\x00\x10\x83", 6)), "+/+/ABCD");
}

const std::set<std::string, std::less<>> reliefKeys = {"height", "height_space", "radius", "wall",
                                                       "wrap"};

TEST(NearestName, FindsOneMistakeOfEveryKind) {
  EXPECT_EQ(nearestName("heigth", reliefKeys), "height") << "swapped";
  EXPECT_EQ(nearestName("hight", reliefKeys), "height") << "missing";
  EXPECT_EQ(nearestName("heeight", reliefKeys), "height") << "one too many";
  EXPECT_EQ(nearestName("hejght", reliefKeys), "height") << "wrong";
  EXPECT_EQ(nearestName("heigth_space", reliefKeys), "height_space");
  EXPECT_EQ(nearestName("wal", reliefKeys), "wall");
}

TEST(NearestName, TakesTheNearerOfTwo) {
  EXPECT_EQ(nearestName("wral", {"wall", "wrap", "real"}), "wrap");
  EXPECT_EQ(nearestName("wrapp", {"wall", "wrap"}), "wrap");
}

TEST(NearestName, FindsWhatWasCutOff) {
  EXPECT_EQ(nearestName("diff", {"difference", "different-one", "dir"}), "difference");
  EXPECT_EQ(nearestName("hei", reliefKeys), "height") << "the shortest";
  EXPECT_FALSE(nearestName("he", reliefKeys)) << "two letters";
}

TEST(NearestName, FindsNothingThatIsFarAway) {
  EXPECT_FALSE(nearestName("colour", reliefKeys));
  EXPECT_FALSE(nearestName("", reliefKeys));
  EXPECT_FALSE(nearestName("height", {}));
  EXPECT_FALSE(nearestName(std::string(100000, 'h'), reliefKeys));
}

TEST(OneLine, HasASpaceForEveryControlCharacter) {
  EXPECT_EQ(oneLine("saw 't\n'\r\tand\x01more"), "saw 't '  and more");
}

TEST(OneLine, HasOneForEveryOtherEndOfALineToo) {
  EXPECT_EQ(oneLine("a\x7f"
                    "b\xc2\x85"
                    "c\xc2\x9b"
                    "2Jd\u2028e\u2029f"),
            "a b c 2Jd e f");
}

TEST(OneLine, ShowsWhereSomethingIsNoUtf8OrTurnsText) {
  EXPECT_EQ(oneLine("a\xff\xc3(b\xed\xa0\x80"), "a\uFFFD\uFFFD(b\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(oneLine("\u202epass\u202c\u2066x\u2069"), "\uFFFDpass\uFFFD\uFFFDx\uFFFD");
}

TEST(OneLine, KeepsAllElse) {
  EXPECT_EQ(oneLine("日本 𝛋 עברית"), "日本 𝛋 עברית");
  EXPECT_EQ(oneLine(""), "");
  EXPECT_EQ(oneLine("κ × h ~ 1"), "κ × h ~ 1");
}

// The examples of FIPS 180-4's published test vectors (NIST, "Secure Hashing").
TEST(Sha256, IsThatOfThePublishedExamples) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, TakesEveryByte) {
  const std::string zeros("\0\0", 2);
  EXPECT_NE(sha256(zeros), sha256(zeros.substr(1)));
  EXPECT_NE(sha256(std::string("a\0b", 3)), sha256("a"));
}

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
