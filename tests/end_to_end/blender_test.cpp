#include <gmock/gmock.h>

#include <cstdlib>

#include "end_to_end/support/program.h"

// docs/blender.py, where Blender is installed: another renderer's masks come back within what the
// truth is uncertain by.

namespace gnomon::test {
namespace {

bool hasBlender() {
  return std::system("blender --version > /dev/null 2>&1") == 0;  // NOLINT(cert-env33-c)
}

class Blender : public EndToEnd {
 protected:
  void SetUp() override {
    if (!hasBlender()) GTEST_SKIP() << "Blender is not installed: apt install blender";
    EndToEnd::SetUp();
  }
  /// Runs the script on an export; its masks are in `back`.
  [[nodiscard]] int blender(const std::string& exported) const {
    const std::string script = GNOMON_DOCS "/blender.py";
    return endOf(startCommand(
        folder(),
        {"blender", "-b", "--factory-startup", "-P", script, "--", exported, "back", "--pictures"},
        {}, file("out.txt"), file("err.txt")));
  }
  [[nodiscard]] nlohmann::json compared(const std::string& mine, const std::string& truth) const {
    const Outcome outcome = gnomon({"compare", mine, truth, "--json", "-"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
};

/// Figure 8's patch at a quarter of the view's side.
TEST_F(Blender, GivesTheMasksOfFigure8BackAsAMethod) {
  const std::string study =
      replaced(read(GNOMON_SCENES "/figure8.toml"), "[study]", "[study]\nquick = true");
  write("figure8.toml", study);
  ASSERT_EQ(gnomon({"export", "figure8.toml"}).status, 0);
  const std::string exported = "out/figure8/export";
  ASSERT_EQ(blender(exported), 0) << read("out.txt") << read("err.txt");
  const nlohmann::json all = compared("back/masks", exported + "/masks").at("all");
  EXPECT_GT(all.at("samples"), 20000);
  EXPECT_LE(all.at("error_rate"), all.at("uncertainty"));
  // Cycles sees other points, by its own rays.
  EXPECT_LE(compared("back/drawn", exported + "/drawn/masks").at("all").at("error_rate"), 0.003);
  write("figure8.toml", study + "\n[[method]]\nmasks = \"back/masks\"\nlabel = \"blender\"\n");
  const Outcome run = gnomon({"run", "figure8.toml", "--method", "blender"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(resultOf(summary("figure8"), "blender", "elevation 24° azimuth 165°", "camera")
                .at("error_rate"),
            all.at("error_rate"));
}

}  // namespace
}  // namespace gnomon::test
