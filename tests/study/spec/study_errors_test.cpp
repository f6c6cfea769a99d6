#include "study/spec/study_file_fixture.h"

namespace gnomon::study {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using StudyErrors = StudyFile;

struct Refusal {
  const char* change;  ///< an override
  const char* message;
};

TEST_F(StudyErrors, RefusesWhatItCannotUse) {
  const Refusal refusals[] = {
      // out of range
      {"surface.quads=[0, 1]", "surface.quads: 0 found, a number of at least 1 and at most 4096"},
      {"surface.size=[64, -32]", "surface.size: -32 found, a number above 0 expected"},
      {"surface.size=[64, 1e13]", "surface.shape: plane: height is 1e+13, expected"},
      {"relief.texels=[64, 16385]", "relief.texels: 16385 found"},
      {"relief.period=0.5", "plain.toml: relief.period: 0.5 found, 1 to"},
      {"relief.height=1e7", "relief.height: 10000000 found"},
      {"relief.repeats=[0, 1]",
       "relief.repeats: 0 found, a number above 0 and at most 1000000 expected"},
      {"bake.azimuths=0", "bake.azimuths: 0 found, a whole number from 1 to 1024 expected"},
      {"bake.radius=0", "bake.radius: 0 found, a number above 0"},
      {"bake.bits=9", "bake.bits: 9 found, one of 8, 16, 32 expected"},
      {"base.subdivisions=0", "base.subdivisions: 0 found"},
      {"base.curvature=mesh",
       "base.curvature: the string \"mesh\" found, one of limit, vertices expected"},
      {"surface.scheme=loop", "surface.scheme: unknown key"},
      {"truth.step=0", "truth.step: 0 found, a number above 0 expected"},
      {"view.0.fov=180", "view.0.fov: 180 found, a number of at least 0.1 and at most 170"},
      {"view.0.width=0", "view.0.width: 0 found, a whole number from 1 to 16384"},
      {"view.1.samples=0", "view.1.samples: 0 found"},
      {"light.0.elevation=90.5", "light.0.elevation: 90.5 found"},
      {"light.0.azimuth=1e308", "light.0.azimuth: 1e+308 found"},
      // what is missing or one too many
      {"surface.mesh=a.obj", "surface.mesh: `shape` found beside it, one of the two expected"},
      {"relief.image=a.exr", "relief.image: `pattern` found beside it"},
      {"method.0.file=a.glsl", "method.0.file: `name` found beside it"},
      {"method=[{}]", "method.0.name: missing, either `name` or `file` or `masks` expected"},
      {"surface={quads=[1, 1]}", "surface.shape: missing, either `shape` or `mesh` expected"},
      {"view=[{type=\"camera\"}]", "view.0.eye: missing, a list of 3 numbers expected"},
      {"light=[{azimuth=3}]", "light.0.elevation: missing, a number or a list of numbers"},
      // names that do not exist
      {"surface.shape=cube",
       "the string \"cube\" found, one of plane, cylinder, sphere, torus, bezier, b-spline"},
      {"relief.pattern=noise",
       "the string \"noise\" found, one of columns, cosine, cells, ripples, spectrum, scratches "
       "expected"},
      {"relief.wrap=mirror", "one of repeat, clamp expected"},
      {"relief.height_space=tangent", "one of world, texture expected"},
      {"view.0.type=orthographic", "one of camera, atlas expected"},
      {"method.0.name=max-forsythe", "method.0.name: no method `max-forsythe`, there are "},
      {"method.0.filter=nearest", "one of exact, hardware expected"},
      // empty lists
      {"view=[]", "view: a list of 0 found, at least one [[view]] expected"},
      {"light=[]", "light: a list of 0 found, at least one [[light]] expected"},
      {"method=[]", "method: a list of 0 found, at least one [[method]] expected"},
      {"threshold=[]", "threshold: a list of 0 found, at least one [[threshold]] expected"},
      {"light.0.azimuth=[]", "light.0.azimuth: a list of 0 found"},
      // names twice
      {"view.1.name=camera", "view \"camera\" appears twice, distinct names expected"},
      {"method.1.label=max-forsyth", "method label \"max-forsyth\" appears twice"},
      {"light.0.elevation=[30, 30]", "light \"elevation 30° azimuth 20°\" appears twice"},
      {"method.1.label=truth", "method.1.label: \"truth\" found, that name is taken"},
      // a projected image
      {R"(relief={image="a.png", projection="cubic", height=1, height_space="world"})",
       "relief.projection: \"cubic\" found, one of triplanar expected"},
      {R"(relief={image="a.png", projection="triplanar", texels=[8, 8], height=1, height_space="world"})",
       "relief.period: missing, a number above 0 expected"},
      {R"(relief={image="a.png", projection="triplanar", texels=[8, 8], period=1, repeats=[2, 2], height=1, height_space="world"})",
       "relief.repeats: a solid has a texel of its own for every point"},
      {R"(relief={pattern="cosine", projection="triplanar", texels=[8, 8], period=1, height=1, height_space="world"})",
       "relief.image: missing"},
      // names that become a folder
      {"study.name=../up", "study.name: \"../up\" found, letters, digits, - and _ expected"},
      {"study.name=.hidden", "study.name: \".hidden\" found"},
      {"study.name=a b", "study.name: \"a b\" found"},
      // shapes that the surface code refuses
      {R"(surface={shape="sphere", quads=[1, 1], size=[9, 9], curvature=0.1})",
       "surface.shape: sphere: rows is 1"},
      {R"(surface={shape="torus", quads=[60, 60], major=1, minor=1})",
       "surface.shape: torus: minor is 1, expected less than major"},
      {R"(surface={shape="torus", quads=[60, 60], major=1, minor=1.5})",
       "surface.shape: torus: minor is 1.5, expected less than major"},
      {R"(surface={shape="bezier", quads=[1, 1], points=[[0, 0, 0]]})",
       "surface.shape: bezier: 1 points found, 16 expected"},
      {R"(surface={shape="b-spline", columns=4, points=[[0, 0, 0]]})",
       "surface.shape: b-spline: 1 points found, at least 4 rows of 4 expected"},
  };
  for (const Refusal& refusal : refusals) {
    SCOPED_TRACE(refusal.change);
    const std::string message = failureWith({refusal.change});
    EXPECT_THAT(message, StartsWith("plain.toml"));
    EXPECT_THAT(message, HasSubstr(refusal.message));
  }
}

TEST_F(StudyErrors, NamesTheLine) {
  EXPECT_THAT(failureOf("height = 4\n", "height = true\n"),
              StartsWith("plain.toml:14: relief.height: true found"));
  EXPECT_THAT(failureOf("height_space = \"world\"\n", ""),
              StartsWith("plain.toml:11: relief.height_space: missing"));
  EXPECT_THAT(failureOf("height = 4\n", "heigth = 4\n"),
              StartsWith("plain.toml:14: relief.heigth: unknown key, expected"));
  EXPECT_THAT(failureOf("label =", "lable ="),
              StartsWith("plain.toml:36: method.1.lable: unknown"));
  EXPECT_THAT(failureOf("shape = \"plane\"", "shape = \"sphere\""),
              StartsWith("plain.toml:6: surface.curvature: missing"));
  EXPECT_THAT(failureOf("pattern = \"columns\"\n", ""),
              StartsWith("plain.toml:11: relief.pattern: missing, either"));
}

TEST_F(StudyErrors, MissesEverySection) {
  for (const std::string section : {"study", "surface", "relief", "view", "light", "method"}) {
    // Renamed everywhere, so that nothing else changes.
    std::string text = plainStudy;
    const std::string opening = "[" + section + "]";
    for (std::size_t at = 0; (at = text.find(opening, at)) != std::string::npos; ++at) {
      text.replace(at, opening.size(), "[x" + section + "]");
    }
    EXPECT_THAT(failure(text), HasSubstr("x" + section + ": unknown key, expected "));
    EXPECT_THAT(failure(text), HasSubstr("Did you mean `" + section + "`?"));
    // Put where nothing reads it, it is missing.
    for (std::size_t at = 0; (at = text.find("[x" + section, at)) != std::string::npos; ++at) {
      text.insert(at + 1, "sweep.");
    }
    EXPECT_THAT(failure(text), HasSubstr(section + ": missing"));
  }
}

TEST_F(StudyErrors, NamesFilesThatAreMissing) {
  EXPECT_THAT(failureWith({R"(relief={image="none.exr", height=1, height_space="world"})"}),
              StartsWith("plain.toml: relief.image: none.exr: no such file"));
  EXPECT_THAT(failureWith({R"(surface={mesh="none.obj"})"}),
              StartsWith("plain.toml: surface.mesh: none.obj: no such file"));
  EXPECT_THAT(
      failureOf("shape = \"plane\"\nquads = [4, 2]\nsize = [64, 32]", "mesh = \"none.obj\""),
      testing::MatchesRegex("plain\\.toml:[0-9]+: surface\\.mesh: none\\.obj: no such file"));
  EXPECT_THAT(
      failureOf("name = \"max-forsyth\"", "file = \"none.glsl\""),
      testing::MatchesRegex("plain\\.toml:[0-9]+: method\\.0\\.file: none\\.glsl: no such file"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)readStudy(file("none.toml")); }),
              HasSubstr("none.toml: no such file"));
}

}  // namespace
}  // namespace gnomon::study
