// What a camera's own rays meet of the displaced mesh, as `gnomon export` writes it.

#include <gtest/gtest.h>

#include <cmath>

#include "end_to_end/support/exported.h"
#include "support/image_files.h"

namespace gnomon::test {
namespace {

class ExportDrawn : public ExportEndToEnd {};

TEST_F(ExportDrawn, WhatACameraDrawsOfTheDisplacedMeshIsThere) {
  const nlohmann::json about = exported("ring", torusStudy(), {"--subdivisions", "8"});
  const nlohmann::json& view = about.at("views").at(0);
  EXPECT_TRUE(about.at("views").at(1).at("drawn").is_null()) << "an atlas has no rays";
  const auto part = [&](const nlohmann::json& name) {
    return file("out/ring/export/" + name.get<std::string>());
  };
  const Channels drawn = readChannels(part(view.at("drawn").at("samples")));
  const Triangles mesh = readPly(file("out/ring/export/displaced.ply"));
  const Point eye = pointOf(view.at("camera").at("eye"));
  const auto pixels = static_cast<std::size_t>(drawn.width) * std::size_t(drawn.height);
  for (std::size_t l = 0; l < 2; ++l) {
    const Point light = pointOf(about.at("lights").at(l).at("direction"));
    const SunRays rays(mesh, light);
    const GreyImage mask = readGrey(part(view.at("drawn").at("masks").at(l).at("truth")));
    std::size_t seen = 0, shadowed = 0, differ = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const Point facet = drawn.point("facet", i);
      ASSERT_EQ(mask.pixels[i] == 128, dot(facet, facet) == 0) << i;
      if (mask.pixels[i] == 128) continue;
      const Point point = drawn.point("point", i);
      EXPECT_GT(dot(facet, minus(eye, point)), 0) << "it faces the eye";
      ++seen;
      // Its mesh is finer than the truth's, whose points lie this near to it.
      Point origin = point;
      for (std::size_t k = 0; k < 3; ++k) origin.at(k) += 0.02 * facet.at(k);
      const bool lit = dot(facet, light) > 0 && !rays.blocked(origin);
      shadowed += lit ? 0 : 1;
      differ += lit != (mask.pixels[i] == 255) ? 1 : 0;
    }
    EXPECT_GT(seen, 2000U);
    EXPECT_GT(shadowed, seen / 20);
    EXPECT_LT(double(differ), 0.01 * double(seen));
  }
}

/// Directions of about equal solid angle toward a disc, in rings.
std::vector<Point> towardDisc(const Point& centre, double radius, int rings) {
  Point level = cross({0, 0, 1}, centre);
  const double length = std::sqrt(dot(level, level));
  for (double& x : level) x /= length;
  const Point upward = cross(centre, level);
  std::vector<Point> directions;
  for (int ring = 0; ring < rings; ++ring) {
    const int count = 2 * ring + 1;  // the ring from r = ring / rings to the next has that area
    const double aside = std::sin(radius) * (ring + 0.5) / rings;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * 3.14159265358979 * (k + 0.3) / count;
      Point direction{};
      for (std::size_t j = 0; j < 3; ++j) {
        direction.at(j) = std::sqrt(1 - aside * aside) * centre.at(j) +
                          aside * (std::cos(angle) * level.at(j) + std::sin(angle) * upward.at(j));
      }
      directions.push_back(direction);
    }
  }
  return directions;
}

TEST_F(ExportDrawn, WhatACameraDrawsUnderADiscAreShares) {
  const nlohmann::json about =
      exported("ring", replaced(torusStudy(), "elevation = 60\n", "elevation = 60\nradius = 8\n"),
               {"--subdivisions", "4"});
  const nlohmann::json& view = about.at("views").at(0);
  const nlohmann::json& mask = view.at("drawn").at("masks").at(0);
  const auto part = [](const nlohmann::json& name) {
    return "out/ring/export/" + name.get<std::string>();
  };
  const Channels drawn = readChannels(file(part(view.at("drawn").at("samples"))));
  const Channels shares = readChannels(file(part(mask.at("shares"))));
  const Triangles mesh = readPly(file(part(about.at("displaced_mesh").at("file"))));
  const auto pixels = static_cast<std::size_t>(drawn.width) * std::size_t(drawn.height);
  const std::vector<Point> directions =
      towardDisc(pointOf(about.at("lights").at(0).at("direction")), 8 * 3.14159265358979 / 180, 6);
  std::vector<double> seen(pixels, 0);
  for (const Point& direction : directions) {
    const SunRays rays(mesh, direction);
    for (std::size_t i = 0; i < pixels; ++i) {
      const Point facet = drawn.point("facet", i);
      if (dot(facet, direction) <= 0) continue;
      Point origin = drawn.point("point", i);
      for (std::size_t k = 0; k < 3; ++k) origin.at(k) += 0.05 * facet.at(k);
      seen[i] += rays.blocked(origin) ? 0 : 1.0 / double(directions.size());
    }
  }
  double sum = 0;
  std::size_t count = 0, between = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const Point facet = drawn.point("facet", i);
    ASSERT_EQ(shares.of.at("A")[i] == 0, dot(facet, facet) == 0) << i;
    if (shares.of.at("A")[i] == 0) continue;
    const double share = shares.of.at("V")[i];
    sum += std::abs(share - seen[i]);
    between += share > 0 && share < 1 ? 1 : 0;
    ++count;
  }
  EXPECT_LT(sum / double(count), 0.01);
  EXPECT_GT(between, count / 20) << "else masks would do as well";
  EXPECT_FALSE(view.at("drawn").at("masks").at(1).contains("shares")) << "a point";
}

// That of the pixels that the camera draws, by the rule of the samples', not that of the samples.
TEST_F(ExportDrawn, WhatACameraDrawsHasAnUncertaintyOfItsOwn) {
  const nlohmann::json about =
      exported("ring", replaced(torusStudy(), "elevation = 60\n", "elevation = 60\nradius = 8\n"));
  const nlohmann::json& view = about.at("views").at(0);
  for (std::size_t l = 0; l < 2; ++l) {
    const nlohmann::json& mask = view.at("drawn").at("masks").at(l);
    const double own = mask.at("uncertainty");
    const double samples = view.at("masks").at(l).at("uncertainty");
    EXPECT_GT(own, samples / 4);
    EXPECT_LT(own, samples * 4);
    EXPECT_NE(own, samples);
    std::vector<std::string> files = {mask.at("truth")};
    if (mask.contains("shares")) files.push_back(mask.at("shares"));
    for (const std::string& name : files) {
      const std::string path = "out/ring/export/" + name;
      const Outcome outcome = gnomon({"compare", path, path, "--json", "-"});
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_EQ(nlohmann::json::parse(outcome.out).at("uncertainty"), own) << name;
    }
  }
}

}  // namespace
}  // namespace gnomon::test
