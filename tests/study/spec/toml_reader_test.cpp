#include "study/spec/toml_reader.h"

#include <fmt/core.h>

#include <fstream>
#include <functional>
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

/// A question to a document and what the answer's error holds.
struct TomlRefusal {
  const char* text;
  std::function<void(const TomlReader&)> ask;
  std::vector<std::string> words;
};

TEST(TomlReader, RefusalsNameFileLineAndKeyWhatWasFoundAndWhatWasExpected) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto number = [](const char* key, NumberRange range) {
    return [=](const TomlReader& reader) { (void)reader.number(key, range); };
  };
  const auto text = [](const TomlReader& reader) { (void)reader.text("x"); };
  const auto list = [](const TomlReader& reader) { (void)reader.list("x", anyNumber, 2); };
  const auto numbers = [](const TomlReader& reader) { (void)reader.numbers("x", anyNumber); };
  const auto points = [](const TomlReader& reader) { (void)reader.points("x"); };
  const auto tables = [](const TomlReader& reader) { (void)reader.tables("x"); };
  const auto choice = [](const TomlReader& reader) {
    (void)reader.choice("x", {"repeat", "clamp"});
  };
  const TomlRefusal refusals[] = {
      {"\n[relief]\nheight = \"tall\"\n",
       [](const TomlReader& reader) { (void)reader.table("relief").number("height", positive); },
       {"study.toml:3: relief.height: the string \"tall\" found, a number above 0 expected"}},
      {"\n\n[relief]\nperiod = 3\n",
       [](const TomlReader& reader) { (void)reader.table("relief").number("height", anyNumber); },
       {"study.toml:3: relief.height: missing, a finite number expected"}},
      {"[[light]]\nelevation = 3\n[[light]]\nelevation = 100\n",
       [](const TomlReader& reader) {
         (void)reader.tables("light").at(1).number("elevation", NumberRange{-90, 90});
       },
       {"study.toml:4: light.1.elevation: 100 found", "at least -90 and at most 90"}},
      {"[method.bake]\nbits = 8\n",
       [](const TomlReader& reader) {
         (void)reader.table("method").table("bake").integer("azimuths", 1, 9);
       },
       {"method.bake.azimuths: missing"}},
      {"x = true\n", text, {"study.toml:1: x: true found", "a string that is not empty expected"}},
      {"x = 1.5\n", text, {"1.5 found"}},
      {"x = [1, 2]\n", text, {"a list of 2 found"}},
      {"x = {y = 1}\n", text, {"a table found"}},
      {"x = 1979-05-27\n", text, {"a date or time found"}},
      {"x = nan\n", text, {"nan found"}},
      {"x = true\n", number("x", {2}), {"a number of at least 2 expected"}},
      {"x = true\n", number("x", {-infinity, 4}), {"a number of at most 4 expected"}},
      {"x = true\n", number("x", {1, 4}), {"a number of at least 1 and at most 4 expected"}},
      {"x = true\n", number("x", {1, 4, true}), {"a number above 1 and at most 4 expected"}},
      {"x = 1\n", number("x", {1, 4, true}), {"1 found"}},
      {"x = 4\n", number("x", {1, 3.999}), {"4 found"}},
      {"x = inf\n", number("x", anyNumber), {"inf found"}},
      {"x = 3.0\n",
       [](const TomlReader& reader) { (void)reader.integer("x", 1, 4); },
       {"3 found, a whole number from 1 to 4 expected"}},
      {"x = 9223372036854775807\n",
       [](const TomlReader& reader) { (void)reader.integer("x", 1, 1024); },
       {"1 to 1024"}},
      {"x = \"mirror\"\n", choice, {"the string \"mirror\" found, one of repeat, clamp expected"}},
      {"x = 1\n", choice, {"1 found"}},
      {"", choice, {"x: missing, one of repeat, clamp expected"}},
      {"x = 1",
       [](const TomlReader& reader) { (void)reader.flag("x"); },
       {"true or false expected"}},
      {"x = [1, 2, 3]\n", list, {"a list of 3 found, a list of 2 numbers expected"}},
      {"x = [1, \"2\"]\n", list, {"the string \"2\" found"}},
      {"x = [1, nan]\n", list, {"nan found"}},
      {"x = 4\n", list, {"4 found"}},
      {"x = []\n", numbers, {"a list of 0 found, a number or a list of at least one expected"}},
      {"x = [1, true]\n", numbers, {"true found"}},
      {"x = nan\n", numbers, {"nan found"}},
      {"x = [[1, 2], [3, 4]]\n", points, {"a list of 2 found, a list of 3 numbers expected"}},
      {"x = 3\n", points, {"3 found, a list of points expected"}},
      {"x = 3\n",
       [](const TomlReader& reader) { (void)reader.table("x"); },
       {"study.toml:1: x: 3 found, a table expected"}},
      {"", [](const TomlReader& reader) { (void)reader.table("x"); }, {"a table [x] expected"}},
      {"x = []\n", tables, {"a list of 0 found, at least one [[x]] expected"}},
      {"x = {y = 1}\n", tables, {"a table found, at least one [[x]] expected"}},
      {"x = [1]\n", tables, {"1 found, at least one [[x]] expected"}},
      {"x = []\n",
       [](const TomlReader& reader) { (void)reader.optionalTables("x"); },
       {"at least one [[x]]"}}};
  for (const TomlRefusal& refusal : refusals) {
    const Document document(refusal.text);
    const std::string said = messageOf<InputError>([&] { refusal.ask(document.reader); });
    for (const std::string& word : refusal.words) {
      EXPECT_THAT(said, HasSubstr(word)) << refusal.text;
    }
  }
}

TEST(TomlReader, GivesTheValuesOfItsKeys) {
  const Document document(
      "low = 1\nhigh = 4\nwhole = 3\nwrap = \"clamp\"\nnumber = 1\non = true\n"
      "two = [1, 2.5]\npoints = [[1, 2, 3], [4, 5, 6]]\n");
  const TomlReader& reader = document.reader;
  EXPECT_EQ(reader.number("low", NumberRange{1, 4}), 1) << "a range has its ends";
  EXPECT_EQ(reader.number("high", NumberRange{1, 4, true}), 4);
  EXPECT_EQ(reader.number("whole", anyNumber), 3.0);
  EXPECT_EQ(reader.integer("whole", 1, 4), 3);
  EXPECT_EQ(reader.choice("wrap", {"repeat", "clamp"}), 1U);
  EXPECT_EQ(reader.choice("number", {"0", "1"}, true), 1U);
  EXPECT_TRUE(reader.flag("on"));
  EXPECT_EQ(reader.list("two", anyNumber, 2), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(reader.numbers("low", anyNumber), std::vector<double>{1});
  EXPECT_EQ(reader.numbers("two", anyNumber), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(reader.points("points"), (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
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
