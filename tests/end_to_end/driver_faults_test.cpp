// A driver that draws something wrong, played by a shader of the passes that is wrong: the methods
// that need it are refused by name, everywhere; the others are measured as ever.

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/files/atomic_file.h"
#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

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
