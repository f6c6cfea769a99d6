#include <fmt/core.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/files/atomic_file.h"
#include "end_to_end/support/bad_input.h"
#include "end_to_end/support/program.h"

// What cannot be used ends the program with its status and one line, and leaves nothing
// half-written. Which words tell of each fault is tested where the fault is found. What a reader
// has to know before the figures stands in all that a run leaves, in the same words.
// A driver that draws something wrong, played by a shader of the passes that is wrong: the methods
// that need it are refused by name, everywhere; the others are measured as ever.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

/// A square of two faces without texture coordinates that have an area.
constexpr const char* pointObj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1 4/1\n";
constexpr const char* methodHeader =
    "/* gnomon-method\ntitle = \"t\"\ncitation = \"c\"\ntables = [\"horizon\"]\n*/\n\n";

TEST_F(BadInput, IsOneLineAndAStatus) {
  writeSmall();
  write("empty.toml", "");
  std::string garbage;
  for (unsigned i = 1; garbage.size() < 5000; i = i * 1664525 + 1013904223) {
    garbage += static_cast<char>(i >> 24);
  }
  write("garbage.toml", garbage);
  write("cut.toml", smallStudy().substr(0, smallStudy().find("quads") + 9));
  write("typo.toml", replaced(smallStudy(), "wall =", "wal ="));
  write("lines.toml", replaced(smallStudy(), "period = 16", "period = \"1\\n6\\t\""));
  write("text.png", "this is no image");
  write("point.obj", pointObj);
  write("broken.glsl",
        std::string(methodHeader) +
            "bool isShadowed(Pixel pixel, LocalLight light) {\n  return pixel.hieght > 0.0;\n}\n");
  const std::string own = smallStudy() + "\n[[method]]\nfile = \"";
  write("broken.toml", own + "broken.glsl\"\n");
  write("parameter.toml",
        own + GNOMON_OWN_METHODS "/biased-horizon.glsl\"\nparameters = {bias = 2.5}\n");
  // Floats may hold any height: all commands refuse what rays and shaders cannot compute with.
  write("high.pfm", "Pf\n2 1\n-1.0\n" + std::string("\0\0\0\0\xe7\x84\x11\x55", 8));  // 1e13
  const auto with = [](const std::string& change, const std::string& command = "run") {
    return std::vector<std::string>{command, "small.toml", "--set", change};
  };
  std::vector<Failure> failures = {
      {{}, 2, {"run, ", "check, ", "or init", "--help"}},
      {{"rnu", "small.toml"}, 2, {"rnu", "not expected", "did you mean run?"}},
      {{"--fast", "run", "small.toml"}, 2, {"--fast"}},
      {{"compare", "a.png", "b.png", "--diff", "d.png"}, 2, {"did you mean --difference?"}},
      {{"list", "--frobnicate"}, 2, {"--frobnicate", "gnomon --help"}},
      {{"run"}, 2, {"STUDY"}},
      {{"list", "check", "small.toml"}, 2, {"--help"}},
      {{"run", "small.toml", "--out"}, 2, {"--out"}},
      {{"run", "small.toml", "--threads", "0"}, 2, {"--threads", "0"}},
      {{"run", "small.toml", "--method", "x"}, 2, {"--method x", "max-forsyth"}},
      {with("relief.height"), 2, {"--set relief.height", "KEY=VALUE"}},
      {with("light.1.elevation=3"), 2, {"there is no `light.1`"}},
      {{"run", "small.toml", "none.toml"}, 3, {"none.toml: no such file"}},
      {{"run", "."}, 3, {".: is a folder"}},
      {{"run", "small.toml", "small.toml"}, 3, {"study.name", "\"small\"", "another study"}},
      {{"run", "small.toml", "--out", "small.toml"}, 3, {"small.toml/small", "folder"}},
      {{"run", "empty.toml"}, 3, {"empty.toml:1: study: missing"}},
      {{"run", "garbage.toml"}, 3, {"garbage.toml:1:"}},
      {{"run", "cut.toml"}, 3, {"cut.toml:8:"}},
      {{"run", "typo.toml"}, 3, {"typo.toml:16: relief.wal: unknown key", "wall"}},
      {{"run", "lines.toml"}, 3, {"relief.period"}},
      {with("surface={mesh=\"point.obj\",scheme=\"catmull-clark\"}"), 3, {"no area"}},
      {with(imageChange("text.png").front()), 3, {"text.png: "}},
      {with("truth.step=1e-300"), 4, {"truth.step: 1e-300 texels"}},
      {{"run", "small.toml", "--set", "relief.texels=[4096, 4096]", "--set", "bake.radius=100",
        "--set", "bake.azimuths=1024"},
       4,
       {"bake.azimuths: 1024", "needs ", " available"}},
      {with("view.0.target=[0, 0, 160]"), 3, {"view \"camera\" shows no surface"}},
      {with("view.0.up=[0, 0, 1]"), 3, {"lie on one line"}},
      {with("relief.repeats=[1e-300, 1e-300]"), 3, {"no sample of a view has a frame"}},
      // A texel's centre line is always among the micro-mesh's: twice as coarse is the same mesh.
      {with("truth.step=1"), 3, {"truth.step: 1 texels found", "smaller step expected"}},
      {{"run", "broken.toml"}, 3, {"broken.toml: ", "broken.glsl:8: ", "hieght"}},
      {{"run", "parameter.toml"}, 3, {"method.2.parameters.bias: 2.5 found, -2 to 2 expected"}},
      {{"check", "small.toml"}, 3, {"small.toml: no [[threshold]]"}},
      {{"check", "small.toml", "--update-baseline", "--reason", "x"}, 2, {"--baseline DIR"}},
      {{"check", "small.toml", "--baseline", "ref", "--update-baseline"}, 2, {"--reason TEXT"}},
      {{"check", "small.toml", "--baseline", "ref", "--reason", "x"}, 2, {"--update-baseline"}},
      {{"check", "small.toml", "--baseline", "ref", "--update-baseline", "--reason", "x",
        "--gated"},
       2,
       {"the studies as they are expected"}}};
  for (const char* command : {"run", "bake", "truth", "export"}) {
    failures.push_back({with(imageChange("high.pfm").front(), command),
                        3,
                        {"relief.height: heights from 0 to 4e+13 found", "1e+06 expected"}});
  }
  for (const Failure& failure : failures) expectFailure(failure);
}

TEST_F(BadInput, AMethodThatNoViewCanShow) {
  const std::string atlas = replaced(
      smallStudy(), "type = \"camera\"\nwidth = 64\nheight = 64\neye = [0, 0, 80]\nfov = 30",
      "type = \"atlas\"\nsamples = 8");
  write("small.toml", replaced(atlas, "name = \"max-forsyth\"", "name = \"shadow-volume\""));
  expectFailure(
      {{"run", "small.toml"}, 3, {"method \"shadow-volume\"", "[[view]] of type camera expected"}});
  // In an atlas beside a camera it is left out, and in the camera's view it answers.
  const std::string both =
      replaced(smallStudy(), "[[light]]", "[[view]]\ntype = \"atlas\"\nsamples = 8\n\n[[light]]");
  runStudy("small", replaced(both, "name = \"max-forsyth\"", "name = \"shadow-volume\""));
  const nlohmann::json written = summary("small");
  for (const nlohmann::json& result : written.at("results")) {
    if (result.at("method") == "shadow-volume") {
      EXPECT_EQ(result.at("view"), "camera");
    }
  }
  EXPECT_LT(resultOf(written, "shadow-volume", "evening", "camera").at("error_rate"), 0.02);
}

// ---- a library, a driver or a folder that is not there

TEST_F(BadInput, WhatTheMachineLacksIsOneLine) {
  writeSmall();
  write("libEGL.so.1", "not a library");
  for (const char* gl : {"gl/libGL.so.1", "gl/libOpenGL.so.0"}) {
    std::filesystem::create_directories(file("gl"));
    write(gl, "not a library");
  }
  write("text.so", "not a library");
  runStudy("probe", replaced(smallStudy(), "\"small\"", "\"probe\""), {"--out", "probe"});
  const std::string version = summary("probe", "probe").at("environment").at("gl_version");
  const bool isMesa = version.find("Mesa") != std::string::npos;
  const std::string noGl = "no OpenGL";
  const std::string noImage = "no image can be read or written";
  const auto module = [&](const std::string& path) {
    return std::vector<std::string>{"GNOMON_IMAGE_MODULE=" + (folder() / path).string()};
  };
  struct Lack {
    std::vector<std::string> environment;
    const char* command;
    int status;
    std::vector<std::string> mentions;
    bool needsMesa = false;
  };
  for (const Lack& lack : std::vector<Lack>{
           {{"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent", "__EGL_VENDOR_LIBRARY_FILENAMES="},
            "run",
            77,
            {noGl, "surfaceless platform: not offered"}},
           {{"LD_LIBRARY_PATH=" + folder().string()}, "run", 77, {noGl, "libEGL.so.1"}},
           {{"LD_LIBRARY_PATH=" + file("gl").string()}, "run", 77, {noGl, "neither libGL.so.1"}},
           {{"GALLIUM_DRIVER=nosuch"}, "run", 77, {noGl, "cannot be initialised"}, true},
           {{"MESA_GL_VERSION_OVERRIDE=4.3"}, "run", 77, {noGl, "has no OpenGL 4.5 core"}, true},
           {module("missing.so"), "bake", 4, {noImage, "missing.so", "cannot open"}},
           {module("text.so"), "bake", 4, {noImage, "text.so", "cannot be loaded"}},
           {module(GNOMON_OTHER_IMAGE_MODULE), "bake", 4, {noImage, "version of another day"}},
           {module(GNOMON_OLDER_IMAGE_MODULE), "bake", 4, {noImage, "version none found"}},
           {{"GNOMON_SHADERS=/nonexistent"}, "run", 3, {"GNOMON_SHADERS: /nonexistent"}}}) {
    if (lack.needsMesa && !isMesa) continue;
    expectFailure({{lack.command, "small.toml"}, lack.status, lack.mentions, lack.environment});
    EXPECT_TRUE(filesBelow("out").empty());
  }
}

TEST_F(BadInput, WhatIsNotNeededMayLack) {
  writeSmall();
  const std::vector<std::string> noGl = {"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent"};
  EXPECT_EQ(gnomon({"list"}, noGl).status, 0);
  EXPECT_EQ(gnomon({"bake", "small.toml"}, noGl).status, 0);
  EXPECT_EQ(gnomon({"run", "missing.toml"}, noGl).status, 3) << "input is checked first";
  const std::vector<std::string> noImage = {"GNOMON_IMAGE_MODULE=/nonexistent"};
  EXPECT_EQ(gnomon({"cache"}, noImage).status, 0);
  const Outcome run = gnomon({"run", "small.toml"}, noImage);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(file("out/small/report.html")));
  // The loader lists what it would load in place of running the program.
  EXPECT_THAT(gnomon({}, {"LD_TRACE_LOADED_OBJECTS=1"}).out,
              AllOf(HasSubstr("libstdc++"), Not(HasSubstr("libOpenImageIO"))));
}

class CommandLine : public EndToEnd {};

TEST_F(CommandLine, ListNamesMethodsShapesPatternsAndMetrics) {
  const Outcome outcome = gnomon({"list"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* name : {"unshadowed", "max-forsyth", "onoue-2004", "Blinn 1978", "bezier",
                           "sphere", "columns", "ripples", "error_rate", "mcc"}) {
    EXPECT_THAT(outcome.out, HasSubstr(name));
  }
}

TEST_F(CommandLine, HelpAndVersion) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--help"}, std::vector<std::string>{"check", "--help"}}) {
    const Outcome help = gnomon(words);
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_THAT(help.out, AllOf(HasSubstr("run"), HasSubstr("--help")));
  }
  const Outcome version = gnomon({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

// It is invalid, as the XDG Base Directory Specification has it: neither the cache nor a library
// that the program loads makes it in the working folder, or says that it could not.
TEST_F(CommandLine, ARelativeCacheFolderIsIgnored) {
  write("small.toml", smallStudy());
  const std::string home = file("home").string();
  const Outcome outcome =
      gnomon({"run", "small.toml"}, {"GNOMON_CACHE=", "XDG_CACHE_HOME=caches", "HOME=" + home});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("Report: out/small/report.html"));
  EXPECT_EQ(outcome.out.find('\033'), std::string::npos) << "no colours where there is no terminal";
  EXPECT_FALSE(std::filesystem::exists(file("caches")));
  EXPECT_TRUE(std::filesystem::exists(file("home/.cache/gnomon")));
}

TEST_F(CommandLine, BakeWritesTheTables) {
  write("small.toml", smallStudy());
  const Outcome outcome = gnomon({"bake", "small.toml", "--set", "bake.azimuths=16"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("out/small/tables.exr: 32 × 32 texels, 16 azimuths"));
  // Two tables of a byte.
  EXPECT_THAT(outcome.out, HasSubstr("32.8 kB in 8 bits"));
  EXPECT_EQ(filesBelow("out"), std::vector<std::string>{"small/tables.exr"});
}

class Notices : public EndToEnd {
 protected:
  /// Runs a study and expects its notices to be told the same everywhere.
  [[nodiscard]] std::vector<std::string> noticesOf(const std::string& text,
                                                   const std::vector<std::string>& options = {}) {
    write("small.toml", text);
    std::vector<std::string> arguments = {"run", "small.toml"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::vector<std::string> notices = summary("small").at("notices");
    const std::string report = read("out/small/report.html");
    for (const std::string& notice : notices) {
      std::string head = notice.substr(0, 60);
      for (auto at = head.find('\''); at != std::string::npos; at = head.find('\'', at + 1)) {
        head.replace(at, 1, "&#39;");
      }
      EXPECT_THAT(report, HasSubstr("<b>Notice:</b> " + head));
      // The terminal breaks lines.
      EXPECT_THAT(outcome.out, HasSubstr("Notice: " + notice.substr(0, 60)));
    }
    if (notices.empty()) {
      EXPECT_EQ(report.find("Notice:"), std::string::npos);
      EXPECT_EQ(outcome.out.find("Notice:"), std::string::npos);
    }
    return notices;
  }
};

TEST_F(Notices, ASoundStudyHasNone) {
  EXPECT_EQ(noticesOf(replaced(smallStudy(), "step = 0.25", "step = 0.05")).size(), 0U);
}

TEST_F(Notices, AnUncertainTruthSaysSoAndTheStepThatItNamesMendsIt) {
  const std::string rough = replaced(smallStudy(), "step = 0.25", "step = 0.5");
  const std::vector<std::string> notices = noticesOf(rough);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_THAT(notices[0], HasSubstr("Set truth.step = 0.25 (now 0.5)."));
  EXPECT_GT(summary("small").at("truth").at("uncertainty"), 0.003);
  // A check says it as well.
  write("gated.toml", rough + "\n[[threshold]]\nmethod = \"max-forsyth\"\nmax = 0.9\n");
  EXPECT_THAT(gnomon({"check", "gated.toml"}).out, HasSubstr("Notice: gated.toml: The truth"));
  EXPECT_THAT(gnomon({"truth", "small.toml"}).out, HasSubstr("Notice: " + notices[0]));
}

TEST_F(Notices, AMapThatRepeatsOverAnOpenMeshIsNoticedAndNotTheDefault) {
  // A bowl, out of which no ray to the light finds by itself.
  std::string obj;
  for (int j = 0; j <= 4; ++j) {
    for (int i = 0; i <= 4; ++i) {
      const int x = 8 * i - 16;
      const int y = 8 * j - 16;
      obj += "v " + std::to_string(x) + " " + std::to_string(y) + " " +
             std::to_string((x * x + y * y) / 16.0) + "\nvt " + std::to_string(i / 4.0) + " " +
             std::to_string(j / 4.0) + "\n";
    }
  }
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      obj += "f";
      for (const int corner : {5 * j + i + 1, 5 * j + i + 2, 5 * j + i + 7, 5 * j + i + 6}) {
        obj += " " + std::to_string(corner) + "/" + std::to_string(corner);
      }
      obj += "\n";
    }
  }
  write("bowl.obj", obj);
  const std::string bowl =
      replaced(smallStudy(), "shape = \"plane\"\nquads = [4, 4]\nsize = [32, 32]",
               "mesh = \"bowl.obj\"\nscheme = \"catmull-clark\"");
  const auto tellsIt = [](const std::vector<std::string>& notices) {
    return std::any_of(notices.begin(), notices.end(), [](const std::string& notice) {
      return notice.find("The map repeats past the border") != std::string::npos;
    });
  };
  const auto wrap = [this]() -> std::string {
    return summary("small").at("study").at("settings").at("relief").at("wrap");
  };
  EXPECT_FALSE(tellsIt(noticesOf(bowl)));
  EXPECT_EQ(wrap(), "clamp");
  EXPECT_TRUE(tellsIt(noticesOf(replaced(bowl, "[relief]\n", "[relief]\nwrap = \"repeat\"\n"))));
  EXPECT_EQ(wrap(), "repeat");
}

TEST_F(Notices, ASweepTellsEachOnceAndWhereItHolds) {
  write("small.toml", smallStudy() + "\n[sweep]\nkey = \"truth.step\"\nvalues = [0.05, 0.5]\n");
  const Outcome outcome = gnomon({"run", "small.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Notice: At truth.step = 0.5: The truth itself"));
  EXPECT_THAT(read("out/small/report.html"),
              HasSubstr("<b>Notice:</b> At truth.step = 0.5: The truth itself"));
}

/// Beside those of the small study.
const std::string surfaceMethods =
    "[[method]]\nname = \"shadow-volume\"\n[[method]]\nname = \"shadow-map\"\n";

class DriverFaults : public EndToEnd {
 protected:
  /// Variables with which the passes' shader FILE is wrong.
  std::vector<std::string> withFault(const char* name, const char* text, const char* instead) {
    const fs::path shaders = folder() / "shaders";
    fs::remove_all(shaders);
    fs::copy(fs::path(GNOMON_SCENES).parent_path() / "shaders", shaders,
             fs::copy_options::recursive);
    const fs::path path = shaders / "common" / name;
    const std::string wrong = replaced(readFile(path), text, instead);
    std::ofstream(path) << wrong;
    return {"GNOMON_SHADERS=" + shaders.string()};
  }
  /// Every other side of the shadow volumes is missing.
  std::vector<std::string> withOpenVolumes() {
    return withFault("shadow_volume.geom", "  emitWall(lit, b, c, a.world, world[3]);\n", "");
  }
  static std::vector<std::string> labelsOf(const nlohmann::json& rows, const char* key) {
    std::vector<std::string> labels;
    for (const nlohmann::json& row : rows) {
      const std::string label = row.at(key);
      if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
    }
    return labels;
  }
};

TEST_F(DriverFaults, RefuseTheMethodsThatNeedWhatIsWrongAndNoOther) {
  write("small.toml", smallStudy() + surfaceMethods);
  const std::vector<std::string> run = {"run", "small.toml", "--out", "right"};
  ASSERT_EQ(gnomon(run).status, 0);
  const Outcome outcome = gnomon({"run", "small.toml", "--out", "wrong"}, withOpenVolumes());
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("shadow-volume is not measured: this OpenGL gets shadow"));
  const std::string page = read("wrong/small/report.html");
  EXPECT_THAT(page, HasSubstr("shadow-volume is not measured: this OpenGL gets shadow volumes"));
  const nlohmann::json found = summary("small", "wrong");
  EXPECT_EQ(found.at("status"), "fail");
  EXPECT_THAT(std::string(found.at("notices").at(0)), HasSubstr("shadow-volume is not measured"));
  EXPECT_THAT(std::string(found.at("problems").at(0).at("message")),
              HasSubstr("shadow-volume is not measured"));
  EXPECT_THAT(labelsOf(found.at("results"), "method"),
              ElementsAre("unshadowed", "max-forsyth", "shadow-map"));
  // What is left is what it was.
  nlohmann::json expected = summary("small", "right").at("results");
  for (auto row = expected.begin(); row != expected.end();) {
    row = row->at("method") == "shadow-volume" ? expected.erase(row) : row + 1;
  }
  EXPECT_EQ(found.at("results"), expected);
}

TEST_F(DriverFaults, FailTheGatesOfARefusedMethod) {
  const std::string gates =
      "[[threshold]]\nmethod = \"shadow-volume\"\nmetric = \"error_rate\"\nmax = 0.9\n"
      "[[threshold]]\nmethod = \"max-forsyth\"\nmetric = \"error_rate\"\nmax = 0.9\n";
  write("small.toml", smallStudy() + surfaceMethods + gates);
  ASSERT_EQ(gnomon({"check", "small.toml"}).status, 0);
  const Outcome outcome =
      gnomon({"check", "small.toml", "--junit", "junit.xml"}, withOpenVolumes());
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.err, HasSubstr("shadow-volume is not measured"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(read("junit.xml"), HasSubstr("this OpenGL gets shadow volumes wrong"));
  std::size_t failed = 0;
  const nlohmann::json found = summary("small");
  for (const nlohmann::json& gate : found.at("thresholds")) {
    const bool isRefused = gate.at("method") == "shadow-volume";
    EXPECT_EQ(gate.at("passed"), !isRefused) << gate;
    failed += isRefused ? 1 : 0;
  }
  EXPECT_GT(failed, 0U);
  // Without a gate of its own a refused method does not pass either.
  write("small.toml", smallStudy() + surfaceMethods + gates.substr(gates.rfind("[[")));
  EXPECT_EQ(gnomon({"check", "small.toml"}, withOpenVolumes()).status, 4);
}

TEST_F(DriverFaults, LeaveNothingWhereAllMethodsNeedWhatIsWrong) {
  write("small.toml", smallStudy() + surfaceMethods);
  const Outcome outcome =
      gnomon({"run", "small.toml"},
             withFault("samples.frag", "sampleSt = clamp(st", "sampleSt = clamp(st.yx"));
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.err, HasSubstr("nothing is measured: this OpenGL gets the samples of a"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.out, Not(HasSubstr("max-forsyth")));
}

}  // namespace
}  // namespace gnomon::test
