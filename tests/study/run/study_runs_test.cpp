#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cache/cache.h"
#include "common/files/atomic_file.h"
#include "render/gl_context.h"
#include "study/run/method_trial.h"
#include "study/run/run_study.h"
#include "study/spec/resolved_study.h"
#include "study/spec/study_file.h"
#include "study/spec/study_file_fixture.h"
#include "support/columns_study.h"
#include "support/replaced.h"
#include "support/temporary_folder.h"

// Of methods that answer alike one is compared, and its pictures are encoded once. What is said and
// shown of each must be what it is of the method alone.
// What a method brings is paid for: its bakes as memory and as the stage "bake", its passes as
// memory. And it is baked again where, and only where, something has changed that it is made from.

namespace gnomon::study {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::Not;

/// Keeps files as the values of their samples and pixels.
class Files : public NoFiles {
 public:
  [[nodiscard]] std::string mask(const Mask& mask) const override {
    std::string bytes;
    for (const Shade shade : mask.samples) bytes += "ls-"[static_cast<int>(shade)];
    return bytes;
  }
  [[nodiscard]] std::string picture(int, int, std::vector<std::uint8_t> rgb) const override {
    return {rgb.begin(), rgb.end()};
  }
  [[nodiscard]] std::string difference(const Mask& a, const Mask& b) const override {
    return mask(a) + mask(b);
  }
  [[nodiscard]] std::string embedded(int, int, std::vector<std::uint8_t> rgb,
                                     EmbeddedSize) const override {
    return {rgb.begin(), rgb.end()};
  }
  [[nodiscard]] std::vector<std::uint8_t> displaced(
      int, int, const std::vector<float>& light) const override {
    std::vector<std::uint8_t> bytes;
    for (const float value : light) bytes.push_back(value > 0 ? 1 : 0);
    return bytes;
  }
  void write(const std::string& path, const std::string& bytes) override { all[path] = bytes; }

  std::map<std::string, std::string> all;
};

class EqualAnswers : public TemporaryFolder {
 protected:
  /// A method's name and its label.
  using Names = std::pair<const char*, const char*>;

  StudyRecord run(const std::vector<Names>& methods, Files& files) {
    std::ofstream study(file("s.toml"));
    study << test::smallestStudy("s") << "\n[[light]]\nelevation = 30\n";
    for (const auto& [name, label] : methods) {
      study << "\n[[method]]\nname = \"" << name << "\"\nlabel = \"" << label << "\"\n";
    }
    study.close();
    cache::Cache none;
    return runStudy(readStudy(file("s.toml"), {}), gl_, files, none);
  }

  /// All that is said of a method.
  static std::vector<std::vector<double>> resultsOf(const StudyRecord& record,
                                                    const std::string& label) {
    std::vector<std::vector<double>> results;
    for (const ResultRecord& result : record.results) {
      if (result.method != label) continue;
      const compare::Counts& counts = result.counts;
      std::vector<double>& values = results.emplace_back();
      values = {counts.truePositive, counts.falsePositive, counts.falseNegative, counts.total()};
      if (result.lengths) values.push_back(result.lengths->runs);
      for (const compare::Metric& metric : result.boundaries) {
        values.push_back(metric.value.value_or(-1));
      }
    }
    return results;
  }
  static const PictureRecord& shadingOf(const StudyRecord& record, const std::string& label) {
    for (const PictureRecord& picture : record.panels.front().pictures) {
      if (picture.method == label && picture.kind == PictureRecord::Kind::shaded) return picture;
    }
    throw std::out_of_range(label);
  }

  render::GlContext gl_;
};

TEST_F(EqualAnswers, AreSaidAndShownAsThoseOfTheMethodAlone) {
  Files together;
  const StudyRecord both = run({{"max-forsyth", "first"},
                                {"unshadowed", "between"},
                                {"max-forsyth", "second"},
                                {"unshadowed", "last"}},
                               together);
  for (const auto& [name, labels] : {std::pair{"max-forsyth", std::array{"first", "second"}},
                                     std::pair{"unshadowed", std::array{"between", "last"}}}) {
    for (const char* label : labels) {
      Files alone;
      const StudyRecord own = run({{name, label}}, alone);
      ASSERT_GT(resultsOf(own, label).size(), 2U);
      EXPECT_EQ(resultsOf(both, label), resultsOf(own, label)) << label;
      EXPECT_GE(alone.all.size(), 6U);
      for (const auto& [path, bytes] : alone.all) {
        ASSERT_FALSE(bytes.empty() && path.find("regions") == std::string::npos) << path;
        EXPECT_EQ(together.all.at(path), bytes) << path;
      }
      const PictureRecord& shown = shadingOf(both, label);
      const PictureRecord& right = shadingOf(own, label);
      EXPECT_EQ(shown.embedded, right.embedded) << label;
      EXPECT_FALSE(right.embedded.empty());
      ASSERT_EQ(shown.worst.size(), right.worst.size()) << label;
      for (std::size_t i = 0; i < right.worst.size(); ++i) {
        EXPECT_EQ(shown.worst[i].answer, right.worst[i].answer) << label;
      }
    }
  }
  EXPECT_NE(shadingOf(both, "first").embedded, shadingOf(both, "between").embedded);
}

/// What a run asks of its writer, in order.
class Asked : public NoFiles {
 public:
  void write(const std::string&, const std::string&) override { all.emplace_back("write"); }
  void beQuiet() override { all.emplace_back("quiet"); }

  std::vector<std::string> all;
};

class QuietFrames : public TemporaryFolder {
 protected:
  std::vector<std::string> askedWith(const char* frames) {
    std::ofstream(file("s.toml")) << test::smallestStudy("s")
                                  << "\n[[light]]\nelevation = 30\n"
                                     "\n[[method]]\nname = \"max-forsyth\"\n";
    StudyOptions options;
    options.overrides = {std::string("study.frames=") + frames};
    const render::GlContext gl;
    cache::Cache none;
    Asked writer;
    (void)runStudy(readStudy(file("s.toml"), options), gl, writer, none);
    return writer.all;
  }
};

/// The frame that draws the answers may be among those timed: what goes on beside the run has ended
/// before, not only before further frames.
TEST_F(QuietFrames, AreThoseThatDrawTheAnswersToo) {
  const std::vector<std::string> asked = askedWith("1");
  ASSERT_GT(asked.size(), 3U);
  EXPECT_EQ(asked.front(), "quiet");
  EXPECT_THAT(asked, testing::Contains("write"));
  EXPECT_THAT(askedWith("0"), testing::Each("write"));
}

class SharedTables : public StudyFile {
 protected:
  /// What a bake finds in the cache on a processor.
  cache::CacheCounts countsOf(const StudySpec& study, const char* processor) {
    const cache::ContentKey program = cache::keyOfBytes("a program");
    cache::Cache cache(file("kept"), 100'000'000, {program, cache::keyOfBytes(processor)}, {});
    (void)bakeStudyTables(study, cache, {});
    return cache.counts();
  }
};

/// Processors share horizons, whose bits are the same on all instruction sets, as
/// horizon_targets_test shows.
TEST_F(SharedTables, AreBakedOnceForAllProcessors) {
  const StudySpec study = readWith({"relief.texels=[256, 256]", "bake.azimuths=32"});
  EXPECT_EQ(countsOf(study, "with AVX-512").misses, 1U);
  const cache::CacheCounts other = countsOf(study, "without");
  EXPECT_EQ(other.hits, 1U);
  EXPECT_EQ(other.misses, 0U);
}

TEST_F(SharedTables, AreNotKeptWhereABakeIsAsFast) {
  const StudySpec study = readWith({"bake.azimuths=8"});
  for (int run = 0; run < 2; ++run) {
    const cache::CacheCounts counts = countsOf(study, "with AVX-512");
    EXPECT_EQ(counts.hits + counts.misses, 0U);
  }
}

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
    return runStudyFigures(study, gl_, cache);
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
