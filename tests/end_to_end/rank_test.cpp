#include <fmt/core.h>
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <sstream>

#include "end_to_end/support/program.h"

// `gnomon rank`: one shader among committed errors.

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

/// Small scenes of planes and spheres.
constexpr const char* tinySuite = R"(
[suite]
name = "tiny"
tries = 5000
[[surface]]
kind = "plane"
weight = 1
[[surface]]
kind = "sphere"
weight = 1
turn = { from = 15, to = 90, step = 1 }
[[relief]]
pattern = "columns"
weight = 1
on = ["open"]
height = { log = [0.2, 0.6] }
shadow = [0.15, 3]
whole_periods = true
lengths = { period = 1, radius = { from = 0.18, to = 0.32, step = 0.01 }, wall = { from = 0.04, to = 0.16, step = 0.01 } }
[map]
side = { among = [64] }
body_side = { among = [64] }
feature = { among = [16] }
body_feature = { log = [0.03, 0.12] }
fewest_features = 4
fewest_texels = 7
[curvature]
bounds = [0.005, 0.25]
[light]
elevation = { from = 15, to = 60, step = 0.5 }
azimuth = { from = 0, to = 359.5, step = 0.5 }
above_rim = 5
body_elevation = { from = -60, to = 60, step = 0.5 }
from_camera = [25, 90]
[view]
camera = 1
atlas = 1
elevation = { from = 35, to = 85, step = 0.5 }
azimuth = { from = 0, to = 359.5, step = 0.5 }
body_elevation = { from = -60, to = 60, step = 0.5 }
pixels = 64
atlas_samples = 4000
fov = 30
margin = 1.1
[rules]
texels_per_face = 8
radians_per_face = 0.1
triangles = 40000
azimuths = 16
bits = 8
frames = 1
)";

class Rank : public SharedRuns {
 protected:
  /// Twenty scenes whose errors are committed in a folder of shaders, scenes and results.
  void prepare() override {
    const std::filesystem::path scenes = GNOMON_SCENES;
    std::filesystem::create_directories(file("share/scenes/suite"));
    std::filesystem::create_directory_symlink(scenes.parent_path() / "shaders",
                                              file("share/shaders"));
    write("share/scenes/suite/tiny.toml", tinySuite);
    write("methods.toml",
          "[[method]]\nname = \"unshadowed\"\n[[method]]\nname = \"max-forsyth\"\n"
          "[[method]]\nname = \"relief-march\"\n[[method]]\nname = \"ellipse\"\n");
    const Outcome drawn = gnomon({"suite", "--from", "share/scenes/suite/tiny.toml", "--seed", "1",
                                  "--scenes", "20", "--methods", "methods.toml", "--out", "drawn"});
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    std::vector<std::string> run = {"run", "--metrics-only", "--out", "measured"};
    for (int i = 1; i <= 20; ++i) run.push_back(fmt::format("drawn/tiny-test-{:04}.toml", i));
    ASSERT_EQ(gnomon(run).status, 0);
    ASSERT_EQ(gnomon({"gather", "measured", "--out", "share/results/tiny"}).status, 0);
    write("share/results/suites.csv",
          "suite,seed,scenes,sha256,errors\ntiny,1,20," + drawn.out.substr(0, 64) + ",drawn-1\n");
    write("my-shadow.glsl", shader("max-forsyth"));
  }
  static std::string shader(const std::string& name) {
    std::ifstream file(std::filesystem::path(GNOMON_SCENES).parent_path() / "shaders/methods" /
                       (name + ".glsl"));
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[nodiscard]] Outcome rank(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "rank");
    arguments.insert(arguments.end(), {"--suite", "tiny", "--scenes", "20"});
    return gnomon(arguments, {"GNOMON_SHADERS=" + file("share/shaders").string()});
  }
};

TEST_F(Rank, OfAPublishedMethodUnderAnotherNameIsItsCommittedErrors) {
  const Outcome outcome = rank({"my-shadow.glsl", "--out", "ranked"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("my-shadow: place "));
  EXPECT_THAT(outcome.out, HasSubstr("By Holm's correction over these 4."));
  EXPECT_THAT(outcome.out, HasSubstr("on a sphere"));
  std::map<std::string, std::string> errors[2];
  std::istringstream lines(read("ranked/suite.csv"));
  for (std::string line; std::getline(lines, line);) {
    for (const std::string method : {"max-forsyth", "my-shadow"}) {
      const std::size_t at = line.find("," + method + ",");
      if (at == std::string::npos) continue;
      errors[method == "my-shadow"][line.substr(0, at)] = line.substr(at + method.size() + 2);
    }
  }
  EXPECT_EQ(errors[0].size(), 20U);
  EXPECT_EQ(errors[0], errors[1]);
  const auto json = nlohmann::json::parse(read("ranked/suite.json"));
  for (const auto& pair : json["pairs"]) {
    const bool isBoth = (pair["first"] == "max-forsyth" && pair["second"] == "my-shadow") ||
                        (pair["second"] == "max-forsyth" && pair["first"] == "my-shadow");
    if (isBoth) EXPECT_EQ(pair["verdict"], "not distinguishable");
  }
  const std::string page = read("ranked/suite.html");
  EXPECT_THAT(page, HasSubstr("my-shadow: place "));
  EXPECT_THAT(page, HasSubstr("href=\"worst/tiny-test-"));
  EXPECT_TRUE(std::filesystem::exists(file("ranked/worst")));
  // A second call finds what it needs, and takes the place of the first; what is not its own stays.
  EXPECT_EQ(rank({"my-shadow.glsl", "--out", "ranked"}).status, 0);
  write("ranked/scenes/mine.txt", "mine");
  const Outcome refused = rank({"my-shadow.glsl", "--out", "ranked"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("files found, an empty folder or a new one expected"));
  EXPECT_EQ(read("ranked/scenes/mine.txt"), "mine");
}

TEST_F(Rank, IsRefusedWhereTruthOrScenesAreOthers) {
  const std::string table = read("share/results/tiny/suite.csv");
  const std::size_t row = table.find("tiny-test-0007,unshadowed,0.");
  ASSERT_NE(row, std::string::npos);
  std::string other = table;
  char& digit = other[other.find(',', row + 28) - 1];
  digit = digit == '1' ? '2' : '1';
  write("share/results/tiny/suite.csv", other);
  const Outcome changed = rank({"my-shadow.glsl", "--out", "refused"});
  write("share/results/tiny/suite.csv", table);
  EXPECT_EQ(changed.status, 3);
  EXPECT_THAT(changed.err, HasSubstr("tiny-test-0007: error rate of `unshadowed`: "));
  EXPECT_FALSE(std::filesystem::exists(file("refused/suite.json")));

  const std::string suite = read("share/scenes/suite/tiny.toml");
  write("share/scenes/suite/tiny.toml", replaced(suite, "fov = 30", "fov = 31"));
  const Outcome scenes = rank({"my-shadow.glsl", "--out", "refused"});
  write("share/scenes/suite/tiny.toml", suite);
  EXPECT_EQ(scenes.status, 3);
  EXPECT_THAT(scenes.err, HasSubstr("not those of the committed errors"));
}

TEST_F(Rank, NamesWhatItCannotTake) {
  EXPECT_EQ(rank({"--out", "refused"}).status, 2);
  write("max-forsyth.glsl", shader("ellipse"));
  std::filesystem::create_directories(file("other"));
  write("other/my-shadow.glsl", shader("ellipse"));
  const Outcome twice = rank({"my-shadow.glsl", "other/my-shadow.glsl", "--out", "refused"});
  EXPECT_EQ(twice.status, 3);
  EXPECT_THAT(twice.err, HasSubstr("two entries \"my-shadow\" found"));
  EXPECT_NE(rank({"nowhere.glsl", "--out", "refused"}).status, 0);
  // One that answers at a camera's pixels alone has no place, and says on how many scenes it
  // answers.
  write("screen.glsl", shader("screen-space"));
  const Outcome camera = rank({"screen.glsl", "--out", "camera"});
  ASSERT_EQ(camera.status, 0) << camera.err;
  EXPECT_THAT(camera.out, HasSubstr("screen: no place, since it answers on "));
  // A committed label stays its own.
  const Outcome named = rank({"max-forsyth.glsl", "--out", "named"});
  ASSERT_EQ(named.status, 0) << named.err;
  EXPECT_THAT(named.out, HasSubstr("max-forsyth (yours): place "));
}

}  // namespace
}  // namespace gnomon::test
