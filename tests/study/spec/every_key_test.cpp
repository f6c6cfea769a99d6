#include <fmt/core.h>

#include "common/text.h"
#include "study/spec/study_file_fixture.h"
#include "study/spec/sweep/sweep.h"
#include "study/spec/toml_reader.h"

namespace gnomon::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// Studies that together have every key there is.

const std::string sixteenPoints =
    "[[0,0,0],[1,0,0],[2,0,0],[3,0,0],[0,1,0],[1,1,0],[2,1,0],[3,1,0],"
    "[0,2,0],[1,2,0],[2,2,0],[3,2,0],[0,3,0],[1,3,0],[2,3,0],[3,3,0]]\n";

const std::vector<std::string> surfaces = {
    "shape = \"plane\"\nquads = [8, 8]\nsize = [64, 64]\n",
    "shape = \"cylinder\"\nquads = [8, 8]\nsize = [64, 64]\ncurvature = 0.01\n",
    "shape = \"sphere\"\nquads = [8, 8]\nsize = [64, 64]\ncurvature = 0.01\n",
    "shape = \"torus\"\nquads = [60, 60]\nmajor = 40\nminor = 20\n",
    "shape = \"bezier\"\nquads = [4, 4]\npoints = " + sixteenPoints,
    "shape = \"b-spline\"\ncolumns = 4\npoints = " + sixteenPoints,
    "mesh = \"square.obj\"\nscheme = \"catmull-clark\"\n"};

const std::vector<std::string> reliefs = {
    "pattern = \"columns\"\ntexels = [32, 32]\nperiod = 16\nradius = 4\nwall = 1\n",
    "pattern = \"cosine\"\ntexels = [32, 32]\nperiod = 16\n",
    "pattern = \"cells\"\ntexels = [32, 32]\nperiod = 16\njitter = 0.5\ngroove = 6\nseed = 2\n",
    "pattern = \"ripples\"\ntexels = [32, 32]\nperiod = 16\nwindward = 0.7\nmeander = 6\n",
    "pattern = \"spectrum\"\ntexels = [32, 32]\nbeta = 3\nperiod = 16\nshortest = 4\nseed = 2\n",
    "pattern = \"scratches\"\ntexels = [32, 32]\ndensity = 0.3\nlength = 16\nwidth = 4\nseed = 2\n",
    "solid = \"noise\"\ntexels = [32, 32]\nperiod = 16\noctaves = 2\ngain = 0.5\nseed = 2\n",
    "solid = \"cells\"\ntexels = [32, 32]\nperiod = 16\njitter = 0.5\ngroove = 3\nseed = 2\n",
    ("solid = \"ripples\"\ntexels = [32, 32]\nperiod = 16\nwindward = 0.7\nmeander = 2\n"
     "direction = [1, 0, 0]\nseed = 2\n"),
    "image = \"heights.pgm\"\nchannel = 0\n",
    ("projection = \"triplanar\"\nimage = \"heights.pgm\"\nchannel = 0\ntexels = [32, 32]\n"
     "period = 16\n")};

std::string everyKey(const std::string& surface, const std::string& relief,
                     const std::string& truth) {
  return "[study]\nname = \"plain\"\ntitle = \"t\"\nsource = \"s\"\nranked = true\nframes = "
         "25\n[surface]\n" +
         surface + "[relief]\n" + relief +
         "height = 4\nheight_space = \"world\"\nwrap = \"clamp\"\nrepeats = [1, 1]\n"
         "invert = false\nresample = 1\n"
         "[bake]\nazimuths = 8\nradius = 16\nbits = 8\nlimit = 90\n"
         "[base]\nsubdivisions = 1\ncurvature = \"limit\"\n[truth]\n" +
         truth + R"([[view]]
type = "atlas"
name = "a"
samples = 9
[[view]]
type = "camera"
name = "b"
eye = [0, -10, 100]
target = [0, 0, 0]
up = [0, 1, 0]
fov = 30
width = 32
height = 32
[[light]]
name = "noon"
azimuth = 20
elevation = 45
radius = 0.5
[[light]]
azimuth = [20, 40]
elevation = [10, 20]
sun = true
[[method]]
name = "max-forsyth"
label = "one"
filter = "exact"
disc = true
bake = { azimuths = 8, radius = 16, bits = 8, limit = 90 }
base = { subdivisions = 1, curvature = "limit" }
[[method]]
name = "relief-march"
label = "two"
parameters = { steps = 8 }
[[threshold]]
method = "one"
light = "noon"
view = "b"
region = "all"
metric = "error_rate"
min = 0
max = 0.5
quick = true
[[claim]]
text = "t"
source = "s"
less = "one"
than = "two"
metric = "error_rate"
region = "all"
[[claim]]
text = "t"
source = "s"
method = "one"
above = 0
below = 1
[[ladder]]
method = "one"
name = "max-forsyth"
filter = "exact"
bake = { bits = 8 }
base = { subdivisions = 1 }
[[ladder.rung]]
cause = "azimuth count"
change = "16"
set = { bake.azimuths = 16 }
[[ladder.rung]]
cause = "another method"
set = { name = "relief-march", parameters = { steps = 9 } }
[[sweep]]
key = "bake.limit"
values = [80, 90]
axis = "limit"
[[sweep]]
key = "bake.azimuths"
values = [8, 16]
with = "bake.limit"
)";
}

/// A key of a study and what stands there.
struct Place {
  std::string path;
  const toml::node* node;
};

/// A study with the places in it that no study before has.
struct Study {
  std::string text;
  toml::table table;
  std::vector<Place> places;
};

void collect(const toml::node& node, const std::string& path, std::vector<Place>& places) {
  if (!path.empty()) places.push_back({path, &node});
  const auto below = [&](const std::string& part) {
    return path.empty() ? part : path + "." + part;
  };
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, child] : *table) collect(child, below(std::string(key.str())), places);
  }
  if (node.is_array_of_tables()) {
    for (std::size_t i = 0; i < node.as_array()->size(); ++i) {
      collect(*node.as_array()->get(i), below(std::to_string(i)), places);
    }
  }
}

class EveryKey : public StudyFile {
 protected:
  EveryKey() {
    std::ofstream(file("square.obj")) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\n"
                                         "vt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    std::ofstream(file("heights.pgm")) << "P2\n3 2\n255\n0 90 255 10 30 70\n";
  }
  static std::vector<Study> studies() {
    std::vector<std::string> texts;
    for (const std::string& surface : surfaces) {
      texts.push_back(everyKey(surface, reliefs[0], "step = 0.5\ndirections = 64\n"));
    }
    for (const std::string& relief : reliefs) {
      texts.push_back(everyKey(surfaces[0], relief, "triangles = 1000\n"));
    }
    std::vector<Study> found;
    std::set<std::string> known;
    for (const std::string& text : texts) {
      Study study{text, toml::parse(text), {}};
      collect(study.table, "", study.places);
      // What a shape's or a pattern's keys mean hangs on which it is.
      std::erase_if(study.places, [&](const Place& place) {
        const std::string form =
            place.path.starts_with("surface.")  ? text.substr(text.find("[sur"), 60)
            : place.path.starts_with("relief.") ? text.substr(text.find("[rel"), 60)
                                                : "";
        return !known.insert(place.path + form).second;
      });
      found.push_back(std::move(study));
    }
    return found;
  }
  /// What reading says with one key changed; empty where it is read.
  /// @param path  of the key: `[[sweep]]` is read with its steps
  std::string saidOf(const std::string& text, const std::string& path, const std::string& change) {
    std::ofstream(file("plain.toml"), std::ios::binary) << text;
    try {
      const StudyOptions options{{change}, {}, false};
      if (path.starts_with("sweep")) {
        (void)readStudyPlan(file("plain.toml"), options);
      } else {
        (void)readStudy(file("plain.toml"), options);
      }
    } catch (const InputError& error) {
      return withoutFolder(error.what());
    }
    return "";
  }
};

TEST_F(EveryKey, IsReadWithItsOwnType) {
  for (const Study& study : studies()) EXPECT_EQ(saidOf(study.text, "sweep", "study.title=u"), "");
}

TEST_F(EveryKey, IsRefusedWithAnyOther) {
  std::size_t refusals = 0;
  for (const auto& [text, table, places] : studies()) {
    for (const auto& [path, node] : places) {
      if (std::isdigit(static_cast<unsigned char>(path.back())) != 0) continue;  // of a list
      const std::vector<std::pair<std::string, bool>> values = {{"true", node->is_boolean()},
                                                                {"\"x\"", node->is_string()},
                                                                {"3", node->is_number()},
                                                                {"[]", false},
                                                                {"[[]]", false},
                                                                {"{}", node->is_table()},
                                                                {"1979-05-27", false},
                                                                {"nan", false},
                                                                {"[true]", false}};
      for (const auto& [value, fits] : values) {
        // A light takes one number as well as a list of them.
        const bool isLight = path.starts_with("light.1.") && value == "3";
        if (fits || isLight) continue;
        const std::string change = fmt::format("{}={}", path, value);
        EXPECT_THAT(saidOf(text, path, change), AllOf(HasSubstr(path), HasSubstr("expected")))
            << change;
        ++refusals;
      }
    }
  }
  EXPECT_GT(refusals, 1000U);
}

TEST_F(EveryKey, NoTableTakesAnotherKey) {
  for (const auto& [text, table, places] : studies()) {
    EXPECT_THAT(saidOf(text, "zzz", "zzz=1"), HasSubstr("zzz: unknown key, expected "));
    for (const auto& [path, node] : places) {
      if (!node->is_table()) continue;
      const std::string key = path + ".zzz";
      const std::string said = saidOf(text, path, key + "=1");
      const bool isParameter = path.ends_with("parameters");
      EXPECT_THAT(said, HasSubstr(key + (isParameter ? ": relief-march has no such parameter"
                                                     : ": unknown key, expected ")));
    }
  }
}

/// An unknown key is told before the key that is missing in its place.
TEST_F(EveryKey, MistypedIsToldWithTheOneThatWasMeant) {
  for (const auto& [text, table, places] : studies()) {
    for (const auto& [path, node] : places) {
      const std::string key = path.substr(path.rfind('.') + 1);
      if (std::isdigit(static_cast<unsigned char>(key.back())) != 0) continue;
      if (key.size() < 4 || path.find("parameters.") != std::string::npos) continue;
      // Written in its own table under a name whose last two letters are swapped.
      std::string mistyped = key;
      std::swap(mistyped[key.size() - 1], mistyped[key.size() - 2]);
      if (mistyped == key) continue;
      toml::table changed = table;
      toml::node* at = &changed;
      std::size_t begin = 0;
      for (std::size_t dot = 0; (dot = path.find('.', begin)) != std::string::npos;
           begin = dot + 1) {
        const std::string part = path.substr(begin, dot - begin);
        at = at->is_table() ? at->as_table()->get(part) : at->as_array()->get(std::stoul(part));
      }
      at->as_table()->erase(key);
      at->as_table()->insert(mistyped, *node);
      std::ostringstream written;
      written << changed;
      EXPECT_THAT(saidOf(written.str(), path, "study.title=u"),
                  AllOf(HasSubstr(mistyped + ": unknown key, expected "),
                        HasSubstr("Did you mean `" + key + "`?")))
          << path;
    }
  }
}

TEST_F(EveryKey, NoListHasAnEntryPastItsEnd) {
  const std::vector<Study> all = studies();
  const auto& [text, table, places] = all.front();
  for (const auto& [path, node] : places) {
    if (!node->is_array_of_tables()) continue;
    const std::size_t size = node->as_array()->size();
    const std::string change = fmt::format("{}.{}.name=x", path, size);
    std::ofstream(file("plain.toml"), std::ios::binary) << text;
    EXPECT_THAT(messageOf<UsageError>([&] {
                  (void)readStudyPlan(file("plain.toml"), {{change}, {}, false});
                }),
                HasSubstr(fmt::format("--set {}: there is no `{}.{}`", change, path, size)));
  }
}

}  // namespace
}  // namespace gnomon::study
