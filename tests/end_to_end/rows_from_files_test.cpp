// Every row follows from the files of a run alone: from a method's mask, the truth at its samples,
// the regions there, where paths cross a seam, and in an atlas what each sample counts.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "end_to_end/support/other_renderer.h"
#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

/// Two squares whose texture coordinates do not continue each other, bent so that they shade one
/// another, under methods that draw three meshes.
std::string study() {
  std::string text = replaced(smallStudy(), "shape = \"plane\"\nquads = [4, 4]\nsize = [32, 32]",
                              "mesh = \"bent.obj\"");
  text = replaced(text, "name = \"evening\"\n", "");
  text = replaced(text, "elevation = 30", "elevation = [20, 50]");
  return text +
         "base = { subdivisions = 3 }\n\n[[method]]\nname = \"onoue-2004\"\n"
         "\n[[method]]\nname = \"shadow-volume\"\n\n[[method]]\nname = \"shadow-map\"\n";
}

/// With an atlas after its camera.
std::string withAtlas(const std::string& text) {
  return replaced(text, "[[light]]", "[[view]]\ntype = \"atlas\"\nsamples = 9\n\n[[light]]");
}

constexpr const char* bentObj =
    "v -16 -16 9\nv 0 -16 0\nv 16 -16 9\nv -16 16 9\nv 0 16 0\nv 16 16 9\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 5/3 4/4\nf 2/1 3/2 6/3 5/4\n";

class RowsFromFiles : public EndToEnd {
 protected:
  /// The picture of a shaded panel entry.
  struct Source {
    nlohmann::json picture;
    std::string view, light;
  };
  [[nodiscard]] std::vector<Source> shadings(const nlohmann::json& json) const {
    std::vector<Source> found;
    for (const nlohmann::json& panel : json.at("panels")) {
      for (const nlohmann::json& picture : panel.at("pictures")) {
        if (picture.at("kind") == "shaded") {
          found.push_back({picture, panel.at("view"), panel.at("light")});
        }
      }
    }
    return found;
  }
  [[nodiscard]] std::filesystem::path inRun(const nlohmann::json& path) const {
    return file("out/small") / path.get<std::string>();
  }
};

/// What a row counts.
struct Row {
  double samples = 0, tp = 0, fp = 0, fn = 0, tn = 0;
};

/// Counts as `gnomon compare` does: where both masks have a sample. Rows of the picture are summed
/// first.
/// @param weights  one a sample, or none for 1 each
template <typename IsIn>
Row countRow(const GreyImage& method, const GreyImage& truth, const std::vector<float>& weights,
             const IsIn& isIn) {
  Row sum;
  for (int y = 0; y < truth.height; ++y) {
    Row row;
    for (int x = 0; x < truth.width; ++x) {
      const auto i = static_cast<std::size_t>(y * truth.width + x);
      if (truth.pixels[i] == 128 || method.pixels[i] == 128 || !isIn(i)) continue;
      const bool isDark = method.pixels[i] == 0;
      const bool shouldBe = truth.pixels[i] == 0;
      const double weight = weights.empty() ? 1 : static_cast<double>(weights.at(i));
      (shouldBe ? (isDark ? row.tp : row.fn) : (isDark ? row.fp : row.tn)) += weight;
      ++row.samples;
    }
    sum.samples += row.samples;
    sum.tp += row.tp;
    sum.fp += row.fp;
    sum.fn += row.fn;
    sum.tn += row.tn;
  }
  return sum;
}

TEST_F(RowsFromFiles, GiveEveryRow) {
  write("bent.obj", bentObj);
  runStudy("small", withAtlas(study()));
  const nlohmann::json json = summary("small");
  std::size_t rows = 0;
  std::size_t withSamples = 0;
  for (const Source& source : shadings(json)) {
    const std::string method = source.picture.at("method");
    if (method == "truth") continue;
    const nlohmann::json& files = source.picture.at("truth");
    const GreyImage drawn = readGrey(inRun(source.picture.at("mask")));
    const GreyImage test = readGrey(inRun(source.picture.at("test_mask")));
    const GreyImage truth = readGrey(inRun(files.at("mask")));
    const std::vector<unsigned char> regions = readColours(inRun(files.at("regions")));
    const bool crosses = !files.at("seam").is_null();
    const GreyImage seam = crosses ? readGrey(inRun(files.at("seam"))) : truth;
    ASSERT_EQ(files.at("weights").is_null(), source.view == "camera");
    std::vector<float> weights;
    if (source.view != "camera") weights = readChannels(inRun(files.at("weights"))).of.at("area");
    for (const nlohmann::json& result : json.at("results")) {
      if (result.at("method") != method || result.at("view") != source.view ||
          result.at("light") != source.light) {
        continue;
      }
      const std::string region = result.at("region");
      const GreyImage& mask = result.at("answer") == "drawn" ? drawn : test;
      const Row row = countRow(mask, truth, weights, [&](std::size_t i) {
        if (region == "all") return true;
        if (region == "seam") return crosses && seam.pixels[i] == 255;
        const nlohmann::json& colour = json.at("region_colours").at(region);
        for (std::size_t c = 0; c < 3; ++c) {
          if (regions[3 * i + c] != colour.at(c)) return false;
        }
        return true;
      });
      const std::string where =
          fmt::format("{}, {}, {}, {}", method, source.view, source.light, region);
      EXPECT_EQ(row.samples, result.at("samples")) << where;
      EXPECT_EQ(row.tp, result.at("tp")) << where;
      EXPECT_EQ(row.fp, result.at("fp")) << where;
      EXPECT_EQ(row.fn, result.at("fn")) << where;
      EXPECT_EQ(row.tn, result.at("tn")) << where;
      if (row.samples > 0) {
        EXPECT_DOUBLE_EQ((row.fp + row.fn) / (row.tp + row.fp + row.fn + row.tn),
                         result.at("error_rate"))
            << where;
        ++withSamples;
      }
      ++rows;
    }
  }
  EXPECT_EQ(rows, json.at("results").size());
  EXPECT_EQ(rows, (5U + 4U) * 2 * 2 * 8)
      << "methods (shadow volumes have no atlas), lights, answers, regions";
  EXPECT_GT(withSamples, (5U + 4U) * 2 * 4) << "else the regions are next to empty";
}

TEST_F(RowsFromFiles, MethodsThatDrawOtherMeshesHaveTruthsOfTheirOwn) {
  write("bent.obj", bentObj);
  runStudy("small", study());
  std::map<std::string, std::set<std::string>> truthsOf;
  for (const Source& source : shadings(summary("small"))) {
    truthsOf[source.picture.at("method")].insert(source.picture.at("truth").at("mask"));
  }
  EXPECT_EQ(truthsOf.at("onoue-2004"), truthsOf.at("truth"));
  EXPECT_EQ(truthsOf.at("unshadowed"), truthsOf.at("truth"));
  EXPECT_EQ(truthsOf.at("shadow-volume"), truthsOf.at("shadow-map"));
  EXPECT_NE(truthsOf.at("shadow-volume"), truthsOf.at("truth"));
  EXPECT_NE(truthsOf.at("max-forsyth"), truthsOf.at("truth"));
  EXPECT_NE(truthsOf.at("max-forsyth"), truthsOf.at("shadow-volume"));
  for (const auto& [method, files] : truthsOf) EXPECT_EQ(files.size(), 2U) << "a light each";
  // They differ in more than their names: the standard base's truth does not give a rival's rows.
  EXPECT_NE(read("out/small/" + *truthsOf.at("shadow-map").begin()),
            read("out/small/" + *truthsOf.at("truth").begin()));
}

TEST_F(RowsFromFiles, AnAtlasShowsAllMethodsTheSameSamples) {
  write("bent.obj", bentObj);
  runStudy("small", withAtlas(study()));
  std::set<std::string> files;
  for (const Source& source : shadings(summary("small"))) {
    if (source.view == "atlas") files.insert(source.picture.at("truth").at("mask"));
  }
  EXPECT_EQ(files.size(), 2U) << "one a light";
}

}  // namespace
}  // namespace gnomon::test
