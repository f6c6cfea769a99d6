#include "study/run/scene/run_keys.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "render/shader_files.h"
#include "support/columns_study.h"
#include "support/temporary_folder.h"

// Every key of a study either changes the keys of what it can change, or nothing that it could.

namespace gnomon::study {
namespace {

namespace fs = std::filesystem;

const std::string studyText =
    test::columnsStudy("keys", "cylinder", "curvature = 0.01\nquads = [12, 4]\n", "64, 32",
                       test::thinColumns) +
    R"(
[bake]
azimuths = 8
radius = 64

[truth]
step = 0.25

[[view]]
type = "camera"
width = 32
height = 32
eye = [0, 0, 180]

[[light]]
elevation = 30

[[method]]
name = "onoue-2004"

[[method]]
name = "unshadowed"

[[method]]
name = "sloan-cohen-surface"

[[method]]
name = "relief-march"

[[threshold]]
method = "unshadowed"
max = 0.5
)";

/// The keys of one study, by what they stand for.
using Keys = std::map<std::string, cache::ContentKey>;

class RunKeysTest : public TemporaryFolder {
 protected:
  Keys keysOf(const std::vector<std::string>& overrides) {
    std::ofstream(file("keys.toml")) << studyText;
    return keysOf(overrides, render::shaderFolder());
  }
  Keys keysOf(const std::vector<std::string>& overrides, const fs::path& shaders) {
    StudyOptions options;
    options.overrides = overrides;
    const StudySpec study = readStudy(file("keys.toml"), options);
    const RunKeys keys(study, gl_, shaders);
    const MeshChoice base{render::DrawnMesh::base, study.base};
    Keys all;
    all["samples"] = keys.samples(base, 0);
    all["surface"] = keys.surface();
    all["truth"] = keys.truth(base, 0, 0);
    all["bins"] = keys.bins(base, 0, 0);
    all["displaced"] = keys.displacedPicture(0, 0);
    for (const MethodSpec& spec : study.methods) {
      const render::Method method = render::readMethod(spec.file);
      all[method.name] = keys.mask(keys.method(spec, method), meshOf(spec, method), 0, 0);
    }
    return all;
  }
  /// Names of those that differ.
  static std::set<std::string> changed(const Keys& before, const Keys& after) {
    std::set<std::string> names;
    for (const auto& [name, key] : before) {
      if (after.at(name) != key) names.insert(name);
    }
    return names;
  }
  static std::set<std::string> namesIn(const std::string& list) {
    std::istringstream words(list);
    return {std::istream_iterator<std::string>(words), {}};
  }

  render::GlContext gl_;
};

const char* const everything =
    "bins displaced onoue-2004 relief-march samples sloan-cohen-surface surface truth unshadowed";

TEST_F(RunKeysTest, EveryKeyOfAStudyChangesWhatDependsOnIt) {
  const std::string masks = "onoue-2004 relief-march sloan-cohen-surface unshadowed";
  const std::string drawn = masks + " bins samples truth";
  const std::string tables = "onoue-2004 sloan-cohen-surface";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"study.title='Another'", ""},
      {"study.source='another test'", ""},
      {"study.name='other'", ""},
      {"study.ranked=false", ""},
      {"study.frames=9", ""},  // they enter what a method costs
      {"threshold.0.max=0.6", ""},
      {"light.0.name='evening'", ""},
      {"light.0.radius=0", ""},
      {"light.0.radius=0.5", masks + " bins displaced truth"},
      {"truth.directions=64", ""},  // no light has a disc
      {"method.0.disc=true", "onoue-2004"},
      {"view.0.name='front'", ""},
      {"method.0.label='theirs'", ""},
      {"surface.curvature=0.011", everything},
      {"surface.size=[64, 33]", everything},
      {"surface.quads=[13, 4]", everything},
      {"relief.period=8", everything},
      {"relief.radius=5", everything},
      {"relief.wall=2", everything},
      {"relief.height=4.000001", everything},
      {"relief.height_space='texture'", everything},
      {"relief.texels=[64, 48]", everything},
      {"relief.wrap='clamp'", everything},
      {"relief.repeats=[1, 2]", everything},
      {"relief.invert=true", everything},
      {"truth.step=0.125", "displaced sloan-cohen-surface surface truth"},
      {"bake.azimuths=16", "onoue-2004"},  // eight are Sloan & Cohen's own
      {"bake.bits=16", tables},
      // Marches end there, and it parts the regions cast and distant.
      {"bake.radius=20", tables + " relief-march truth"},
      {"bake.limit=80", tables},
      {"base.subdivisions=2", drawn},
      {"base.curvature='vertices'", drawn},
      {"view.0.width=33", drawn + " displaced"},
      {"view.0.height=33", drawn + " displaced"},
      {"view.0.eye=[0, 1, 180]", drawn + " displaced"},
      {"view.0.target=[0, 1, 0]", drawn + " displaced"},
      {"view.0.up=[1, 0, 0]", drawn + " displaced"},
      {"view.0.fov=31", drawn + " displaced"},
      {"light.0.elevation=31", masks + " bins truth displaced"},
      {"light.0.azimuth=1", masks + " bins truth displaced"},
      {"method.0.filter='hardware'", "onoue-2004"},
      {"method.0.bake.azimuths=16", "onoue-2004"},
      {"method.0.base.subdivisions=2", "onoue-2004"},
      {"method.3.parameters.steps=12", "relief-march"},
  };
  const Keys before = keysOf({});
  for (const auto& [override, expected] : cases) {
    EXPECT_EQ(changed(before, keysOf({override})), namesIn(expected)) << override;
  }
}

TEST_F(RunKeysTest, EllipsesEnterByTheirFrame) {
  std::ofstream(file("keys.toml")) << studyText;
  const StudySpec study = readStudy(file("keys.toml"), {});
  const RunKeys keys(study, gl_, render::shaderFolder());
  const BakeSpec& bake = study.methods.front().bake;
  EXPECT_EQ(keys.ellipses(bake, 0.5), keys.ellipses(bake, 0.5));
  EXPECT_NE(keys.ellipses(bake, 0.5), keys.ellipses(bake, 1));
}

TEST_F(RunKeysTest, ShadersEnterByTheirText) {
  const Keys before = keysOf({});
  const fs::path shaders = file("shaders");
  fs::copy(render::shaderFolder(), shaders, fs::copy_options::recursive);
  EXPECT_EQ(changed(before, keysOf({}, shaders)), namesIn("")) << "where they lie does not matter";
  // What editors and file managers leave, a half-saved shader among it.
  for (const char* part : {"common", "methods"}) {
    for (const char* name : {".pixel.glsl.swp", "pixel.glsl~", "#pixel.glsl#", ".DS_Store", "4913",
                             ".pixel.glsl", "pixel.glsl.orig"}) {
      std::ofstream(shaders / part / name) << "half a sha";
    }
    fs::create_symlink("user@host.1234:5678", shaders / part / ".#pixel.glsl");
    fs::create_symlink("nowhere", shaders / part / "gone.glsl");
    fs::create_directory(shaders / part / "folder.glsl");
  }
  EXPECT_EQ(changed(before, keysOf({}, shaders)), namesIn("")) << "editor files";
  EXPECT_EQ(render::methodNames(shaders), render::methodNames(render::shaderFolder()));
  std::ofstream(shaders / "common/pixel.glsl", std::ios::app) << "// edited\n";
  EXPECT_EQ(changed(before, keysOf({}, shaders)),
            namesIn("bins onoue-2004 relief-march samples sloan-cohen-surface truth unshadowed"));
}

TEST_F(RunKeysTest, TheMeshOfAMethodsLightEntersItsMasks) {
  (void)keysOf({});
  const StudySpec study = readStudy(file("keys.toml"), {});
  MethodSpec spec = study.methods.front();
  spec.file = render::methodFile(render::shaderFolder(), "two-scales");
  render::Method method = render::readMethod(spec.file);
  const RunKeys keys(study, gl_, render::shaderFolder());
  const cache::ContentKey nine = keys.method(spec, method);
  EXPECT_EQ(meshOf(spec, method).kind, render::DrawnMesh::base);
  ASSERT_TRUE(lightMeshOf(spec, method).has_value());
  EXPECT_EQ(lightMeshOf(spec, method)->kind, render::DrawnMesh::displaced);
  EXPECT_EQ(lightMeshOf(spec, method)->base.subdivisions, 9);
  // By another default as well as by a value of its own.
  method.parameters.at("light_pieces").defaultValue = 10;
  EXPECT_NE(keys.method(spec, method), nine);
  method.parameters.at("light_pieces").defaultValue = 9;
  EXPECT_EQ(keys.method(spec, method), nine);
  spec.parameters["light_pieces"] = 10;
  EXPECT_NE(keys.method(spec, method), nine);
  EXPECT_EQ(lightMeshOf(spec, method)->base.subdivisions, 10);
  spec.parameters["light_pieces"] = 9.5;
  EXPECT_THROW((void)keys.method(spec, method), InputError);

  const MethodSpec& other = study.methods.front();
  EXPECT_FALSE(lightMeshOf(other, render::readMethod(other.file)).has_value());
}

TEST_F(RunKeysTest, AMethodEntersByItsText) {
  (void)keysOf({});
  fs::copy(render::methodFile(render::shaderFolder(), "onoue-2004"), file("onoue-2004.glsl"));
  const StudySpec study = readStudy(file("keys.toml"), {});
  MethodSpec spec = study.methods.front();
  const RunKeys keys(study, gl_, render::shaderFolder());
  const cache::ContentKey before = keys.method(spec, render::readMethod(spec.file));
  spec.file = file("onoue-2004.glsl");
  EXPECT_EQ(keys.method(spec, render::readMethod(spec.file)), before)
      << "where it lies does not matter";
  std::ofstream(spec.file, std::ios::app) << "// edited\n";
  EXPECT_NE(keys.method(spec, render::readMethod(spec.file)), before);
}

TEST_F(RunKeysTest, TheProgramHasOne) {
  EXPECT_EQ(programKey(), programKey());
  EXPECT_NE(programKey(), cache::ContentKey{});
}

TEST_F(RunKeysTest, TheTruthOfADiscDependsOnItsDirections) {
  const Keys disc = keysOf({"light.0.radius=0.5"});
  EXPECT_EQ(changed(disc, keysOf({"light.0.radius=0.5", "truth.directions=64"})), namesIn("truth"));
  EXPECT_EQ(changed(disc, keysOf({"light.0.radius=0.25"})),
            namesIn("bins displaced onoue-2004 relief-march sloan-cohen-surface truth unshadowed"));
}

}  // namespace
}  // namespace gnomon::study
