#include "study/spec/toml/toml_reader.h"

#include <fmt/core.h>

#include <fstream>
#include <limits>

#include "common/error.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A parsed text and a reader of it, as of the file `study.toml`.
struct Document {
  explicit Document(std::string_view text)
      : table(toml::parse(text)), reader(table, "study.toml", "") {}
  toml::table table;
  TomlReader reader;
};

// ---- errors name file, line and key, what was found and what was expected

TEST(TomlReader, NamesFileLineAndKeyOfAWrongValue) {
  const Document document("\n[relief]\nperiod = 3\nheight = \"tall\"\n");
  const TomlReader relief = document.reader.table("relief");
  EXPECT_EQ(messageOf<InputError>([&] { (void)relief.number("height", positive); }),
            "study.toml:4: relief.height: the string \"tall\" found, a number above 0 expected");
}

TEST(TomlReader, NamesTheTableOfAMissingKey) {
  const Document document("\n\n[relief]\nperiod = 3\n");
  const TomlReader relief = document.reader.table("relief");
  EXPECT_EQ(messageOf<InputError>([&] { (void)relief.number("height", anyNumber); }),
            "study.toml:3: relief.height: missing, a finite number expected");
}

TEST(TomlReader, CountsTheTablesOfAList) {
  const Document document("[[light]]\nelevation = 3\n[[light]]\nelevation = 100\n");
  const auto lights = document.reader.tables("light");
  ASSERT_EQ(lights.size(), 2U);
  EXPECT_EQ(lights[0].number("elevation", NumberRange{-90, 90}), 3);
  EXPECT_EQ(messageOf<InputError>([&] {
              (void)lights[1].number("elevation", NumberRange{-90, 90});
            }),
            "study.toml:4: light.1.elevation: 100 found, a number of at least -90 and at most 90 "
            "expected");
}

TEST(TomlReader, PathsOfNestedTablesAreWhole) {
  const Document document("[method.bake]\nbits = 8\n");
  const TomlReader bake = document.reader.table("method").table("bake");
  EXPECT_THAT(messageOf<InputError>([&] { (void)bake.integer("azimuths", 1, 9); }),
              HasSubstr("method.bake.azimuths: missing"));
}

TEST(TomlReader, DescribesEveryKindOfValue) {
  const Document document(
      "a = true\nb = 1.5\nc = [1, 2]\nd = {x = 1}\ne = 1979-05-27\nf = -7\ng = inf\nh = nan\n");
  const auto found = [&](const char* key) {
    return messageOf<InputError>([&] { (void)document.reader.text(key); });
  };
  EXPECT_EQ(found("a"), "study.toml:1: a: true found, a string that is not empty expected");
  EXPECT_THAT(found("b"), HasSubstr("b: 1.5 found"));
  EXPECT_THAT(found("c"), HasSubstr("c: a list of 2 found"));
  EXPECT_THAT(found("d"), HasSubstr("d: a table found"));
  EXPECT_THAT(found("e"), HasSubstr("e: a date or time found"));
  EXPECT_THAT(found("f"), HasSubstr("f: -7 found"));
  EXPECT_THAT(found("g"), HasSubstr("g: inf found"));
  EXPECT_THAT(found("h"), HasSubstr("h: nan found"));
}

TEST(TomlReader, StatesEveryKindOfRange) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Document document("x = true\n");
  const auto expected = [&](NumberRange range) {
    return messageOf<InputError>([&] { (void)document.reader.number("x", range); });
  };
  EXPECT_THAT(expected(anyNumber), HasSubstr("true found, a finite number expected"));
  EXPECT_THAT(expected(positive), HasSubstr("a number above 0 expected"));
  EXPECT_THAT(expected({2}), HasSubstr("a number of at least 2 expected"));
  EXPECT_THAT(expected({-infinity, 4}), HasSubstr("a number of at most 4 expected"));
  EXPECT_THAT(expected({1, 4}), HasSubstr("a number of at least 1 and at most 4 expected"));
  EXPECT_THAT(expected({1, 4, true}), HasSubstr("a number above 1 and at most 4 expected"));
}

// ---- values

TEST(TomlReader, RangesIncludeTheirEndsUnlessOpen) {
  const Document document("low = 1\nhigh = 4\n");
  EXPECT_EQ(document.reader.number("low", NumberRange{1, 4}), 1);
  EXPECT_EQ(document.reader.number("high", NumberRange{1, 4}), 4);
  EXPECT_EQ(document.reader.number("high", NumberRange{1, 4, true}), 4);
  EXPECT_THROW((void)document.reader.number("low", NumberRange{1, 4, true}), InputError);
  EXPECT_THROW((void)document.reader.number("high", NumberRange{1, 3.999}), InputError);
}

TEST(TomlReader, NumbersAreFinite) {
  const Document document("a = inf\nb = -inf\nc = nan\nd = [1, nan]\n");
  for (const char* key : {"a", "b", "c"}) {
    EXPECT_THROW((void)document.reader.number(key, anyNumber), InputError) << key;
    EXPECT_THROW((void)document.reader.numbers(key, anyNumber), InputError) << key;
  }
  EXPECT_THROW((void)document.reader.list("d", anyNumber, 2), InputError);
}

TEST(TomlReader, AWholeNumberIsANumberButNotTheOtherWayRound) {
  const Document document("whole = 3\nreal = 3.0\nlarge = 9223372036854775807\n");
  EXPECT_EQ(document.reader.number("whole", anyNumber), 3.0);
  EXPECT_EQ(document.reader.integer("whole", 1, 4), 3);
  EXPECT_EQ(messageOf<InputError>([&] { (void)document.reader.integer("real", 1, 4); }),
            "study.toml:2: real: 3 found, a whole number from 1 to 4 expected");
  EXPECT_THROW((void)document.reader.integer("large", 1, 1024), InputError);
}

TEST(TomlReader, AChoiceIsOneOfItsNames) {
  const Document document("wrap = \"clamp\"\nother = \"mirror\"\nwrong = 1\n");
  EXPECT_EQ(document.reader.choice("wrap", {"repeat", "clamp"}), 1U);
  EXPECT_EQ(messageOf<InputError>([&] {
              (void)document.reader.choice("other", {"repeat", "clamp"});
            }),
            "study.toml:2: other: the string \"mirror\" found, one of repeat, clamp expected");
  EXPECT_THROW((void)document.reader.choice("wrong", {"repeat"}), InputError);
  EXPECT_EQ(document.reader.choice("wrong", {"0", "1"}, true), 1U);
  EXPECT_THROW((void)document.reader.choice("wrap", {"0", "clamp"}, true), InputError);
  EXPECT_THAT(messageOf<InputError>([&] { (void)document.reader.choice("none", {"repeat"}); }),
              HasSubstr("none: missing, one of repeat expected"));
}

TEST(TomlReader, AFlagIsTrueOrFalse) {
  const Document document("on = true\nnumber = 1");
  EXPECT_TRUE(document.reader.flag("on"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)document.reader.flag("number"); }),
              HasSubstr("study.toml:2: number: 1 found, true or false expected"));
}

TEST(TomlReader, ListsHaveTheirLength) {
  const Document document("two = [1, 2.5]\nthree = [1, 2, 3]\nmixed = [1, \"2\"]\none = 4\n");
  EXPECT_EQ(document.reader.list("two", anyNumber, 2), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(document.reader.list("three", anyNumber, 3), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(messageOf<InputError>([&] { (void)document.reader.list("three", anyNumber, 2); }),
            "study.toml:2: three: a list of 3 found, a list of 2 numbers expected");
  EXPECT_THAT(messageOf<InputError>([&] { (void)document.reader.list("mixed", anyNumber, 2); }),
              HasSubstr("mixed: the string \"2\" found"));
  EXPECT_THROW((void)document.reader.list("one", anyNumber, 3), InputError);
  EXPECT_THROW((void)document.reader.list("two", NumberRange{2}, 2), InputError);
}

TEST(TomlReader, NumbersAreOneOrAList) {
  const Document document("one = 4\nmany = [1, 2]\nnone = []\nwrong = [1, true]\n");
  EXPECT_EQ(document.reader.numbers("one", anyNumber), std::vector<double>{4});
  EXPECT_EQ(document.reader.numbers("many", anyNumber), (std::vector<double>{1, 2}));
  EXPECT_EQ(messageOf<InputError>([&] { (void)document.reader.numbers("none", anyNumber); }),
            "study.toml:3: none: a list of 0 found, a number or a list of at least one expected");
  EXPECT_THROW((void)document.reader.numbers("wrong", anyNumber), InputError);
  EXPECT_THROW((void)document.reader.numbers("many", NumberRange{0, 1}), InputError);
}

TEST(TomlReader, PointsAreListsOfThree) {
  const Document document("good = [[1, 2, 3], [4, 5, 6]]\nflat = [[1, 2], [3, 4]]\nno = 3\n");
  EXPECT_EQ(document.reader.points("good"), (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_THAT(messageOf<InputError>([&] { (void)document.reader.points("flat"); }),
              HasSubstr("flat: a list of 2 found, a list of 3 numbers expected"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)document.reader.points("no"); }),
              HasSubstr("no: 3 found, a list of points expected"));
}

TEST(TomlReader, TablesAreTables) {
  const Document document("relief = 3\nlight = []\nview = {x = 1}\nmethod = [1]\n");
  EXPECT_EQ(messageOf<InputError>([&] { (void)document.reader.table("relief"); }),
            "study.toml:1: relief: 3 found, a table expected");
  EXPECT_THAT(messageOf<InputError>([&] { (void)document.reader.table("study"); }),
              HasSubstr("study: missing, a table [study] expected"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)document.reader.tables("light"); }),
              HasSubstr("light: a list of 0 found, at least one [[light]] expected"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)document.reader.tables("view"); }),
              HasSubstr("view: a table found, at least one [[view]] expected"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)document.reader.tables("method"); }),
              HasSubstr("method: 1 found, at least one [[method]] expected"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)document.reader.optionalTables("light"); }),
              HasSubstr("at least one [[light]]"));
}

// ---- what nobody asked for

TEST(TomlReader, RefusesAKeyThatNobodyReadAndNamesThoseThereAre) {
  const Document document("height = 3\nhieght = 4\nwrap = 1\n");
  (void)document.reader.number("height", anyNumber);
  (void)document.reader.find("kind");
  (void)document.reader.integer("wrap", 0, 9);
  EXPECT_EQ(
      messageOf<InputError>([&] { document.reader.finish(); }),
      "study.toml:2: hieght: unknown key, expected height, kind, wrap. Did you mean `height`?");
}

TEST(TomlReader, RefusesAKeyBeforeItMissesTheOneThatWasMeant) {
  const Document document("[relief]\nheigth = 3\n");
  const TomlReader relief = document.reader.table("relief");
  EXPECT_EQ(messageOf<InputError>([&] {
              relief.allow({"wrap", "height"});
            }),
            "study.toml:2: relief.heigth: unknown key, expected height, wrap. Did you mean "
            "`height`?");
  EXPECT_NO_THROW(relief.allow({"wrap", "heigth"}));
}

TEST(TomlReader, IsContentWhenEveryKeyWasRead) {
  const Document document("height = 3\n");
  EXPECT_TRUE(document.reader.has("height"));
  EXPECT_THROW(document.reader.finish(), InputError)
      << "asking whether a key is there reads nothing";
  (void)document.reader.find("height");
  EXPECT_NO_THROW(document.reader.finish());
}

TEST(TomlReader, OneOfTwoKeysIsNeitherBothNorNone) {
  const Document one("image = \"a.exr\"\n");
  EXPECT_NO_THROW(one.reader.requireOneOf("pattern", "image"));
  const Document both("pattern = \"cells\"\nimage = \"a.exr\"\n");
  EXPECT_EQ(messageOf<InputError>([&] { both.reader.requireOneOf("pattern", "image"); }),
            "study.toml:2: image: `pattern` found beside it, one of the two expected");
  const Document none("[relief]\nheight = 1\n");
  const TomlReader relief = none.reader.table("relief");
  EXPECT_EQ(messageOf<InputError>([&] { relief.requireOneOf("pattern", "image"); }),
            "study.toml:1: relief.pattern: missing, either `pattern` or `image` expected");
}

TEST(TomlReader, BlamesAKeyForWhatItsValueBrings) {
  const Document document("shape = \"sphere\"\n");
  EXPECT_EQ(document.reader.blame("shape", [] { return 7; }), 7);
  EXPECT_EQ(messageOf<InputError>([&] {
              document.reader.blame("shape", []() -> int { throw InputError("sphere: too flat"); });
            }),
            "study.toml:1: shape: sphere: too flat");
  EXPECT_EQ(messageOf<MemoryError>([&] {
              document.reader.blame("shape", []() -> int { throw MemoryError("too large"); });
            }),
            "study.toml:1: shape: too large");
}

TEST(TomlReader, BlamesTheKeyOfTheParameterThatALibraryNames) {
  const Document document("shape = \"sphere\"\n\nradius = 0\n");
  const auto messageAbout = [&](const std::string& parameter) {
    return messageOf<InputError>([&] {
      document.reader.blame("shape", [&]() -> int { throw InputError("too flat", parameter); });
    });
  };
  EXPECT_EQ(messageAbout("radius"), "study.toml:3: radius: too flat");
  EXPECT_EQ(messageAbout("columns"), "study.toml:1: shape: too flat");
}

// ---- files and overrides

class ParseToml : public TemporaryFolder {
 protected:
  toml::table parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
    std::ofstream(file("study.toml"), std::ios::binary) << text;
    return parseToml(file("study.toml"), overrides);
  }
  /// The message about a file, without the folder in front.
  template <typename ErrorType = InputError>
  std::string failure(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return withoutFolder(messageOf<ErrorType>([&] { (void)parse(text, overrides); }));
  }
};

TEST_F(ParseToml, NamesLineAndColumnOfWhatIsNoToml) {
  EXPECT_THAT(failure("[study]\nname = \n"), StartsWith("study.toml:2:8: "));
  EXPECT_THAT(failure("[study]\n[study]\n"), StartsWith("study.toml:2:"));
  EXPECT_THAT(failure("a = 1\na = 2\n"), StartsWith("study.toml:2:"));
  EXPECT_THAT(failure("a = \"unfinished\n"), StartsWith("study.toml:1:"));
}

TEST_F(ParseToml, RefusesBytesThatAreNoText) {
  std::string bytes;
  for (int i = 0; i < 3000; ++i) bytes += static_cast<char>((i * 167 + i * i * 31) % 256);
  EXPECT_THAT(failure(bytes), StartsWith("study.toml:1:"));
  EXPECT_THAT(failure(std::string(4096, '\0')), StartsWith("study.toml:1:"));
  EXPECT_THAT(failure(std::string(100'000, '[')), StartsWith("study.toml:1:"));
}

// All of these have overflown the stack, in the parser or when the tables were destroyed.
TEST_F(ParseToml, RefusesWhatNestsTooDeep) {
  const auto deep = [](const std::string& part) {
    std::string text;
    for (int i = 0; i < 100'000; ++i) text += part;
    return text;
  };
  for (const std::string& text : {
           "[" + deep("a.") + "a]\n",
           "[[" + deep("a.") + "a]]\n",
           deep("a.") + "a = 1\n",
           deep("\"a\" . ") + "a = 1\n",
           "x = {" + deep("a.") + "a = 1}\n",
           "x = " + deep("[") + deep("]") + "\n",
           "x = " + deep("{a=") + "1" + deep("}") + "\n",
           "x = " + deep("[{a=") + "1\n",
       }) {
    EXPECT_EQ(failure("y = 1\n" + text),
              "study.toml:2: nested too deep, at most 64 brackets or parts of a key expected");
  }
  for (const std::string& change :
       {deep("a.") + "a=1", deep("a,b.") + "a=1", "x=" + deep("["), "x={" + deep("a.") + "a=1}"}) {
    EXPECT_THAT(failure<UsageError>("", {change}), HasSubstr("…: nested too deep, at most 64"));
  }
}

// What the bound lets pass: as many braces as it allows, each with as long a key.
TEST_F(ParseToml, TakesTheDeepestThatItAllows) {
  std::string key = "a";
  for (int i = 1; i < 64; ++i) key += ".a";
  std::string text = "[" + key + "]\nx = ";
  for (int i = 0; i < 64; ++i) text += "{" + key + " = ";
  text += "1" + std::string(64, '}');
  toml::table table = parse(text, {key.substr(2) + ".b=2"});
  EXPECT_TRUE(toml::table(table) == table);
}

TEST_F(ParseToml, NamesAFileThatIsMissing) {
  EXPECT_THAT(messageOf<InputError>([&] { (void)parseToml(file("none.toml"), {}); }),
              HasSubstr("none.toml: no such file"));
}

TEST_F(ParseToml, AnEmptyFileIsAnEmptyTable) {
  EXPECT_TRUE(parse("").empty());
}

TEST_F(ParseToml, OverridesReplaceValuesOfAnyType) {
  const toml::table table =
      parse("[relief]\nheight = 8\nwrap = \"clamp\"\nrepeats = [1, 1]\n",
            {"relief.height=4.5", "relief.wrap=\"repeat\"", "relief.repeats=[2, 3]"});
  EXPECT_EQ(table["relief"]["height"].value<double>(), 4.5);
  EXPECT_EQ(table["relief"]["wrap"].value<std::string>(), "repeat");
  EXPECT_EQ(table["relief"]["repeats"][1].value<int>(), 3);
}

TEST_F(ParseToml, AnOverrideThatIsNoTomlIsText) {
  const toml::table table = parse("", {"relief.pattern=cells", "study.name=a = b",
                                       "study.title=", "study.source=1\n[relief]\nheight=3"});
  EXPECT_EQ(table["relief"]["pattern"].value<std::string>(), "cells");
  EXPECT_EQ(table["study"]["name"].value<std::string>(), "a = b");
  EXPECT_EQ(table["study"]["title"].value<std::string>(), "");
  EXPECT_EQ(table["study"]["source"].value<std::string>(), "1\n[relief]\nheight=3");
  EXPECT_FALSE(table["relief"]["height"]);
}

TEST_F(ParseToml, OverridesReachIntoLists) {
  const toml::table table = parse("[[light]]\nelevation = 60\n[[light]]\nelevation = 30\n",
                                  {"light.1.elevation=20", "light.0.bake.azimuths=8"});
  EXPECT_EQ(table["light"][0]["elevation"].value<int>(), 60);
  EXPECT_EQ(table["light"][1]["elevation"].value<int>(), 20);
  EXPECT_EQ(table["light"][0]["bake"]["azimuths"].value<int>(), 8);
}

TEST_F(ParseToml, OverridesMakeSections) {
  const toml::table table = parse("", {"truth.step=0.125", "base={subdivisions=2}"});
  EXPECT_EQ(table["truth"]["step"].value<double>(), 0.125);
  EXPECT_EQ(table["base"]["subdivisions"].value<int>(), 2);
}

TEST_F(ParseToml, TheLaterOverrideHolds) {
  EXPECT_EQ(parse("a = 1\n", {"a=2", "a=3"})["a"].value<int>(), 3);
}

TEST_F(ParseToml, AnOverriddenValueHasNoLine) {
  const toml::table table = parse("[relief]\n\nheight = 1\n", {"relief.height=\"tall\""});
  const TomlReader relief = TomlReader(table, "study.toml", "").table("relief");
  EXPECT_THAT(messageOf<InputError>([&] { (void)relief.number("height", anyNumber); }),
              StartsWith("study.toml: relief.height: the string \"tall\" found"));
}

TEST_F(ParseToml, RefusesOverridesThatLeadNowhere) {
  const std::string text = "a = 1\n[[light]]\nelevation = 60\neye = [1, 2, 3]\n";
  const auto refused = [&](const std::string& change) {
    return failure<UsageError>(text, {change});
  };
  EXPECT_EQ(refused("a"), "--set a: KEY=VALUE expected, as relief.height=4");
  EXPECT_EQ(refused("=3"), "--set =3: KEY=VALUE expected, as relief.height=4");
  for (const char* entry : {"1", "2", "x", "-1", "0x"}) {
    const std::string change = fmt::format("light.{}.elevation=3", entry);
    EXPECT_EQ(
        refused(change),
        fmt::format("--set {}: there is no `light.{}`, light has 1 counted from 0", change, entry));
  }
  EXPECT_EQ(refused("light.0.eye.3.x=3"),
            "--set light.0.eye.3.x=3: there is no `light.0.eye.3`, light.0.eye has 3 counted "
            "from 0");
  EXPECT_EQ(refused("a.b.c=3"), "--set a.b.c=3: there is no `a.b`");
  EXPECT_EQ(refused("a.b=3"), "--set a.b=3: `b` is no key of a table");
  EXPECT_EQ(refused("light.0=3"), "--set light.0=3: `0` is no key of a table");
  EXPECT_EQ(refused("light.0.eye.0=3"), "--set light.0.eye.0=3: `0` is no key of a table");
  EXPECT_EQ(refused("relief.=3"), "--set relief.=3: `` is no key of a table");
}

class TomlFile : public TemporaryFolder {};

TEST_F(TomlFile, AFaultOfSyntaxIsOneLineEvenAtTheEndOfOne) {
  std::ofstream(file("cut.toml")) << "[relief]\nwall = t\nheight = 3\n";
  const auto refused = messageOf<InputError>([&] { parseToml(file("cut.toml"), {}); });
  EXPECT_THAT(refused, HasSubstr("cut.toml:2:9: "));
}

}  // namespace
}  // namespace gnomon::study
