#include "study/spec/sections/study_key.h"

#include <gmock/gmock.h>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;

enum class Colour { red, green };

/// A section with a key of every type.
struct Section {
  std::string text = "old";
  bool flag = false;
  int whole = 3;
  double number = 0.1;
  std::optional<double> maybe;
  Vec2 pair{1, 2};
  glm::ivec2 wholePair{4, 5};
  Vec3 point{1, 2, 3};
  std::vector<Vec3> points{{0, 0, 1}};
  Colour colour = Colour::red;
  int bits = 8;
  double angle = radians(30);
  double texels = 6;
  std::vector<double> numbers{7};
  bool rare = false;
  int count = 256;
  double radius = 0;
};

StudyKeys keysOf(Section& s) {
  const std::vector<std::pair<Colour, std::string>> colours = {{Colour::red, "red"},
                                                               {Colour::green, "green"}};
  return {studyKey("text", &s.text, "a text", {}, {}, Enters::nothing),
          studyKey("flag", &s.flag, "a flag"),
          studyKey("whole", &s.whole, "a whole number", {1, 9}),
          studyKey("number", numbers(s.number), "a number", positive),
          studyKey("maybe", OptionalNumber{&s.maybe}, "may be missing", {}, "none"),
          studyKey("pair", numbers(s.pair), "two numbers"),
          studyKey("whole_pair", &s.wholePair, "two whole numbers", {1, 9}),
          studyKey("point", numbers(s.point), "a point"),
          studyKey("points", &s.points, "points"),
          studyKey("colour", chosenName(s.colour, colours), "a colour"),
          studyKey("bits", chosenName<int>(s.bits, {{8, "8"}, {16, "16"}}, true), "bits"),
          studyKey("angle", degrees(s.angle), "degrees", {0, 90}),
          studyKey("texels", numbers(s.texels, 3), "texels", {}, {}, Enters::search),
          studyKey("numbers", NumberOrList{&s.numbers}, "numbers"),
          studyKey("rare", Unusual{&s.rare}, "a flag that few set"),
          studyKey("count", Unusual{&s.count, 256}, "a number that few set", {2, 512}),
          studyKey("radius", Unusual{&s.radius}, "likewise", {0, 10})};
}

Section read(const std::string& text) {
  const toml::table table = toml::parse(text);
  Section section;
  readSection(TomlReader(table, "study.toml", "part"), keysOf(section));
  return section;
}

constexpr const char* everyValue = R"(text = "new"
flag = true
whole = 9
number = 0.25
maybe = 0.1
pair = [3, 4.5]
whole_pair = [6, 7]
point = [7, 8, 9]
points = [[1, 2, 3], [4, 5, 6]]
colour = "green"
bits = 16
angle = 24
texels = 1.5
numbers = [1, 2]
)";

TEST(StudyKey, ReadsEveryTypeIntoItsPlace) {
  const Section section = read(everyValue);
  EXPECT_EQ(section.text, "new");
  EXPECT_TRUE(section.flag);
  EXPECT_EQ(section.whole, 9);
  EXPECT_EQ(section.number, 0.25);
  EXPECT_EQ(section.maybe, 0.1);
  EXPECT_EQ(section.pair, Vec2(3, 4.5));
  EXPECT_EQ(section.wholePair, glm::ivec2(6, 7));
  EXPECT_EQ(section.point, Vec3(7, 8, 9));
  EXPECT_EQ(section.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(section.colour, Colour::green);
  EXPECT_EQ(section.bits, 16);
  EXPECT_EQ(section.angle, radians(24));
  EXPECT_EQ(section.texels, 4.5) << "three texels for one of the file's";
  EXPECT_EQ(section.numbers, (std::vector<double>{1, 2}));
}

TEST(StudyKey, IsWrittenAsItIsRead) {
  EXPECT_TRUE(settingsOf(read(everyValue)) == toml::parse(R"(text = "new"
flag = true
whole = 9
number = 0.25
maybe = 0.1
pair = [3.0, 4.5]
whole_pair = [6, 7]
point = [7.0, 8.0, 9.0]
points = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
colour = "green"
bits = 16
angle = 24.0
texels = 1.5
numbers = [1.0, 2.0]
)"));
}

TEST(StudyKey, LeavesItsPlaceWhereTheFileDoesNotHaveIt) {
  EXPECT_TRUE(settingsOf(read("")) == settingsOf(Section{}));
  EXPECT_FALSE(read("").maybe);
}

TEST(StudyKey, RefusesWhatItsDeclarationDoesNotAllow) {
  const auto refused = [](const std::string& text) {
    return messageOf<InputError>([&] { (void)read(text); });
  };
  EXPECT_EQ(refused("whole = 10"),
            "study.toml:1: part.whole: 10 found, a whole number from 1 to 9 expected");
  EXPECT_THAT(refused("number = 0"), HasSubstr("a number above 0 expected"));
  EXPECT_THAT(refused("whole_pair = [1, 2.5]"), HasSubstr("two whole numbers expected"));
  EXPECT_THAT(refused("colour = \"blue\""), HasSubstr("one of red, green expected"));
  EXPECT_THAT(refused("bits = \"16\""), HasSubstr("one of 8, 16 expected"));
  EXPECT_THAT(refused("angle = 91"), HasSubstr("at most 90 expected"));
  EXPECT_THAT(refused("color = 3"),
              HasSubstr("unknown key, expected angle, bits, colour, count, flag"));
  std::string name;
  const toml::table table = toml::parse("name = \"x\"");
  const TomlReader reader(table, "study.toml", "part");
  EXPECT_THAT(
      messageOf<InputError>([&] {
        readKeys(reader, {studyKey("name", &name, "", {}, {}, Enters::nothing, {"a", "b"})});
      }),
      HasSubstr("part.name: \"x\" found, one of a, b expected"));
  EXPECT_THAT(messageOf<InputError>(
                  [&] { readKeys(reader, {studyKey("other", &name, "", {}, required)}); }),
              HasSubstr("part.other: missing, a string expected"));
}

/// What no declaration leaves out, the cache cannot miss.
TEST(StudyKey, EveryValueEntersTheCachesKeyUnlessItsDeclarationSaysOtherwise) {
  const auto keyOf = [](const Section& section, Enters result) {
    cache::KeyBuilder key("test");
    addSettings(key, section, result);
    return key.key();
  };
  const Section before;
  const toml::table changed = toml::parse(everyValue);
  for (const auto& [name, value] : changed) {
    std::ostringstream line;
    line << toml::table{{name, value}};
    const Section after = read(line.str());
    EXPECT_EQ(keyOf(after, Enters::everything) != keyOf(before, Enters::everything),
              name.str() != "text")
        << name.str();
    EXPECT_EQ(keyOf(after, Enters::costs) != keyOf(before, Enters::costs),
              name.str() != "text" && name.str() != "texels")
        << name.str();
  }
}

TEST(StudyKey, ThatIsUnusualIsWrittenAndKeyedOnlyThen) {
  const auto keyOf = [](const std::string& text) {
    cache::KeyBuilder key("section");
    addSettings(key, read(text), Enters::everything);
    return key.key();
  };
  const std::string usual = "rare = false\ncount = 256\nradius = 0\n";
  EXPECT_TRUE(settingsOf(read(usual)) == settingsOf(Section{}));
  EXPECT_EQ(keyOf(usual), keyOf(""));
  for (const std::string text : {"rare = true\n", "count = 16\n", "radius = 0.5\n"}) {
    toml::table expected = settingsOf(Section{});
    for (auto&& [name, value] : toml::parse(text)) expected.insert(name, value);
    EXPECT_TRUE(settingsOf(read(text)) == expected) << text;
    EXPECT_NE(keyOf(text), keyOf("")) << text;
  }
  EXPECT_THAT(messageOf<InputError>([] { (void)read("count = 1000"); }), HasSubstr("2 to 512"));
}

}  // namespace
}  // namespace gnomon::study
