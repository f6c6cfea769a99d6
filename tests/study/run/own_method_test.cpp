#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "cache/cache.h"
#include "common/files/atomic_file.h"
#include "render/gl_context.h"
#include "study/run/run_study.h"
#include "study/spec/study_file.h"
#include "study/spec/study_inputs.h"
#include "support/columns_study.h"
#include "support/replaced.h"
#include "support/temporary_folder.h"

// What a method brings is paid for: its bakes as memory and as the stage "bake", its passes as
// memory. And it is baked again where, and only where, something has changed that it is made from.

namespace gnomon::study {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::Not;

class OwnMethod : public TemporaryFolder {
 protected:
  OwnMethod() {
    const fs::path given = fs::path(GNOMON_SCENES).parent_path() / "tests/render/sixteenth";
    fs::copy(given, folder(), fs::copy_options::recursive);
    std::ofstream(file("own.toml"))
        << test::smallestStudy("own")
        << "\n[[light]]\nelevation = 30\n\n[[method]]\nfile = \"sixteenth.glsl\"\n";
  }

  StudyRecord run(const std::vector<std::string>& overrides = {}) {
    StudyOptions options;
    options.overrides = overrides;
    const StudySpec study = readStudy(file("own.toml"), options);
    cache::Cache cache(file("kept"), 100'000'000, {}, {});
    SceneStore store;
    return runStudyFigures(study, gl_, cache, store);
  }
  static std::vector<std::string> stages(const StudyRecord& record) {
    std::vector<std::string> names;
    for (const TimingRecord& timing : record.timings) names.push_back(timing.stage);
    return names;
  }
  void edit(const std::string& name, const std::string& text, const std::string& instead) const {
    const std::string changed = test::replaced(readFile(file(name)), text, instead);
    std::ofstream(file(name)) << changed;
  }

  render::GlContext gl_;
};

/// Its horizons are there while it bakes alone: a channel of 8 bits is what its frames read.
TEST_F(OwnMethod, DoesNotCostWhatOnlyItsBakeReads) {
  std::ofstream(file("baked.glsl"))
      << "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\ntables = [\"horizon\"]\n"
         "[bakes.high]\nbits = 8\n[bakes.twice]\nbits = 8\n*/\n"
         "float bakeHigh(vec2 texel) { return horizonAt(texel, 0.0); }\n"
         "float bakeTwice(vec2 texel) { return 0.5 * highAt(texel); }\n"
         "bool isShadowed(Pixel pixel, LocalLight light) { return twiceAt(pixel.texel) > 0.1; }\n";
  edit("own.toml", "[[method]]", "[[method]]\nfile = \"baked.glsl\"\n\n[[method]]");
  const StudyRecord record = run();
  EXPECT_EQ(record.cost.front().method, "baked");
  EXPECT_EQ(record.cost.front().tableBytes, 32U * 32);
}

TEST_F(OwnMethod, CostsItsBakesAndItsPasses) {
  const StudyRecord record = run();
  ASSERT_EQ(record.cost.size(), 1U);
  // Two channels of 16 bits in four layers; twice a value and a mark of 8 bits.
  EXPECT_EQ(record.cost.front().tableBytes, 32U * 32 * (4 * 2 * 2 + 2 * 2));
  EXPECT_EQ(record.cost.front().heightBytes, 32U * 32 * 4);
  EXPECT_EQ(record.cost.front().passes, 3);
  EXPECT_THAT(stages(record), Contains("bake"));
}

TEST_F(OwnMethod, IsBakedAgainWhereItsInputsChange) {
  (void)run();
  EXPECT_THAT(stages(run()), Not(Contains("bake")));
  const std::uint64_t all = run({"light.0.elevation=31"}).cache->misses;
  // Another light asks the bakes back from the cache; another height bakes them.
  EXPECT_EQ(run({"light.0.elevation=32"}).cache->misses, all);
  EXPECT_GT(run({"light.0.elevation=33", "method.0.parameters.reach=20"}).cache->misses, all);
  EXPECT_THAT(stages(run({"relief.height=5"})), Contains("bake"));
  edit("parts/steps.glsl", "rise > 0.0", "rise > 0.5");
  EXPECT_THAT(stages(run()), Contains("bake"));
  edit("sixteenth.glsl", "sum > 4.5", "sum > 5.5");
  EXPECT_THAT(stages(run()), Contains("bake"));
}

TEST_F(OwnMethod, ThatNeedsACameraIsLeftOutOfAnAtlasWhichANoticeSaysOnce) {
  edit("sixteenth.glsl", "tables = ", "needs = \"camera\"\ntables = ");
  std::ofstream(file("own.toml"), std::ios::app)
      << "\n[[method]]\nname = \"unshadowed\"\n\n[[view]]\ntype = \"atlas\"\nname = \"all\"\n"
         "samples = 4\n\n[[light]]\nelevation = 50\n";
  const StudyRecord record = run();
  EXPECT_EQ(std::count(record.notices.begin(), record.notices.end(),
                       "sixteenth answers at a camera's pixels alone: it is left out of \"all\"."),
            1);
  const auto rows = [&](const std::string& method, const std::string& view) {
    return std::count_if(record.results.begin(), record.results.end(), [&](const auto& result) {
      return result.method == method && result.view == view;
    });
  };
  EXPECT_GT(rows("sixteenth", "camera"), 0);
  EXPECT_EQ(rows("sixteenth", "all"), 0);
  EXPECT_GT(rows("unshadowed", "all"), 0);
}

TEST_F(OwnMethod, ItsFilesAreInputs) {
  const StudySpec study = readStudy(file("own.toml"));
  std::vector<std::string> files;
  for (const InputRecord& input : studyInputs(study, folder())) files.push_back(input.file);
  EXPECT_THAT(files, Contains("sixteenth.glsl"));
  EXPECT_THAT(files, Contains("parts/steps.glsl"));
}

TEST_F(OwnMethod, WholeNumbersAndFlagsStayThatInAStudy) {
  edit("sixteenth.glsl", "[[pass]]\nname = \"dark\"",
       "[parameters.isOn]\ndefault = true\n\n[[pass]]\nname = \"dark\"");
  const auto settings = [&](const std::vector<std::string>& overrides) {
    StudyOptions options;
    options.overrides = overrides;
    const StudySpec study = readStudy(file("own.toml"), options);
    return *tableOf(study.methods.front(), folder(), 1)["parameters"].as_table();
  };
  const toml::table standard = settings({});
  EXPECT_EQ(standard["reach"].value_exact<std::int64_t>(), 40);
  EXPECT_EQ(standard["isOn"].value_exact<bool>(), true);
  const toml::table changed =
      settings({"method.0.parameters.reach=12", "method.0.parameters.isOn=false"});
  EXPECT_EQ(changed["reach"].value_exact<std::int64_t>(), 12);
  EXPECT_EQ(changed["isOn"].value_exact<bool>(), false);
  for (const auto& [override, expected] :
       {std::pair("method.0.parameters.reach=2.5",
                  "2.5 found, a whole number from 1 to 64 expected"),
        {"method.0.parameters.reach=true", "true found, a whole number from 1 to 64 expected"},
        {"method.0.parameters.isOn=3", "3 found, true or false expected"}}) {
    try {
      (void)settings({override});
      ADD_FAILURE() << override;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(expected));
    }
  }
}

}  // namespace
}  // namespace gnomon::study
