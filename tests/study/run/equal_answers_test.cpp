#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cache/cache.h"
#include "render/gl_context.h"
#include "study/run/no_files.h"
#include "study/run/run_study.h"
#include "study/spec/study_file.h"
#include "support/columns_study.h"
#include "support/temporary_folder.h"

// Of methods that answer alike one is compared, and its pictures are encoded once. What is said and
// shown of each must be what it is of the method alone.

namespace gnomon::study {
namespace {

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
    SceneStore store;
    return runStudy(readStudy(file("s.toml"), {}), gl_, files, none, store);
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

}  // namespace
}  // namespace gnomon::study
