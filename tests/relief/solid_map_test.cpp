#include "relief/solid_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/random_stream.h"
#include "relief/patterns.h"
#include "relief/triplanar.h"
#include "surface/cage/shapes.h"
#include "surface/mesh_file.h"
#include "surface/shared_sides.h"
#include "surface/texel_frame.h"

namespace gnomon::relief {
namespace {

/// The largest slope of a solid about the origin, by differences.
double largestSlope(const SolidFunction& f) {
  constexpr double e = 1e-4;
  RandomStream random(9);
  double most = 0;
  for (int i = 0; i < 40000; ++i) {
    const Vec3 p(2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1);
    const Vec3 slope(f(p + Vec3(e, 0, 0)) - f(p), f(p + Vec3(0, e, 0)) - f(p),
                     f(p + Vec3(0, 0, e)) - f(p));
    most = std::max(most, glm::length(slope) / e);
  }
  return most;
}

/// What a map jumps by where two faces meet, and by how much it may.
struct SeamJump {
  double jump, texelSize;
};

/// At points of all edges whose two faces have other texture coordinates there.
std::vector<SeamJump> seamJumps(const surface::LimitSurface& surface, const HeightField& field) {
  const Vec2 texelsPerUv(field.width(), field.height());
  const auto at = [&](const surface::FaceSide& side, double share) {
    constexpr std::array<Vec2, 5> corners = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1),
                                             Vec2(0, 0)};
    const auto k = static_cast<std::size_t>(side.side);
    const Vec2 place = glm::mix(corners.at(k), corners.at(k + 1), share);
    return surface::texelFrame(surface.tangentPoint(side.face, place.x, place.y), texelsPerUv);
  };
  std::vector<SeamJump> jumps;
  for (const auto& [first, second] : surface::sharedSides(surface)) {
    for (const double share : {0.1, 0.33, 0.5, 0.78, 0.9}) {
      const surface::TexelFrame a = at(first, share);
      const surface::TexelFrame b = at(second, 1 - share);
      if (glm::length(a.texel - b.texel) < 1e-6) continue;
      const double size =
          std::max(glm::length(a.px) + glm::length(a.py), glm::length(b.px) + glm::length(b.py));
      jumps.push_back({std::abs(field.at(a.texel) - field.at(b.texel)), size});
    }
  }
  return jumps;
}

double meanJump(const std::vector<SeamJump>& jumps) {
  double sum = 0;
  for (const SeamJump& one : jumps) sum += one.jump;
  return sum / static_cast<double>(jumps.size());
}

surface::LimitSurface spot() {
  return surface::LimitSurface(surface::readMeshFile(GNOMON_SCENES "/meshes/spot_control_mesh.obj",
                                                     surface::SubdivisionScheme::catmullClark));
}

TEST(SolidMap, OnAPlaneIsTheFunctionAtTexelCentres) {
  const surface::LimitSurface plane(surface::makePlane(6, 3, 4, 5));
  for (const SolidPattern& solid :
       {SolidPattern(SolidNoise{}), SolidPattern(SolidCells{}), SolidPattern(SolidRipples{})}) {
    const SolidFunction f = solidFunction(solid);
    const HeightField field = makeSolidMap(plane, 60, 30, f, 2, Wrap::clamp);
    for (int j = 0; j < 30; ++j) {
      for (int i = 0; i < 60; ++i) {
        const Vec3 place(6 * (i + 0.5) / 60 - 3, 3 * (j + 0.5) / 30 - 1.5, 0);
        ASSERT_NEAR(field.texel(i, j), 2 * f(place), 1e-5) << i << " " << j;
      }
    }
  }
}

TEST(SolidMap, AgreesOnBothSidesOfSeams) {
  const surface::LimitSurface surface = spot();
  const SolidFunction f = solidFunction(SolidNoise{0.25, 2, 0.5, 1});
  const double slope = largestSlope(f);
  const HeightField field = makeSolidMap(surface, 512, 512, f, 1, Wrap::clamp);
  const auto jumps = seamJumps(surface, field);
  ASSERT_GT(jumps.size(), 200U);
  for (const SeamJump& one : jumps) EXPECT_LE(one.jump, slope * one.texelSize);
  // Half the texels' size, less than half the jump: of second order but where texture coordinates
  // bend, at the faces' edges.
  const HeightField fine = makeSolidMap(surface, 1024, 1024, f, 1, Wrap::clamp);
  EXPECT_LT(meanJump(seamJumps(surface, fine)), 0.45 * meanJump(jumps));
}

/// The control: a pattern of the plane on the same mesh.
TEST(SolidMap, OfThePlaneJumps) {
  const surface::LimitSurface surface = spot();
  const SolidFunction f = solidFunction(SolidNoise{0.25, 2, 0.5, 1});
  const double solid =
      meanJump(seamJumps(surface, makeSolidMap(surface, 512, 512, f, 1, Wrap::clamp)));
  const double planar = meanJump(seamJumps(surface, makeCosine(512, 512, {}, 1, Wrap::clamp)));
  EXPECT_GT(planar, 20 * solid);
}

/// A projection depends on the normal too, which both sides have in common.
TEST(SolidMap, OfAProjectionAgreesOnBothSidesOfSeams) {
  const surface::LimitSurface surface = spot();
  const HeightField image = makeCosine(64, 64, {32}, 1, Wrap::clamp);
  const SurfaceFunction f = triplanar(image, 0.5);
  const auto meanAt = [&](int side) {
    return meanJump(seamJumps(surface, makeSolidMap(surface, side, side, f, 1, Wrap::clamp)));
  };
  const double coarse = meanAt(512);
  EXPECT_LT(meanAt(1024), 0.45 * coarse);
  // The control: the same image laid over the texture jumps.
  EXPECT_GT(meanJump(seamJumps(surface, image)), 20 * coarse);
}

/// The normal goes on turning in the margin: by atan(d / R) a way d along the tangent.
TEST(SolidMap, TurnsTheNormalInItsMargin) {
  surface::Cage cage = surface::makeCylinder(2, 1, 2, 16, 4);
  for (Vec2& uv : cage.uvs) uv = 0.25 + 0.5 * uv;
  const SurfaceFunction f = [](const Vec3&, const Vec3& normal) { return normal.x; };
  const HeightField field = makeSolidMap(surface::LimitSurface(cage), 64, 64, f, 1, Wrap::clamp);
  constexpr double radiansPerTexel = 1.0 / 32;
  for (int i = 12; i < 52; ++i) {
    const double along = radiansPerTexel * (i + 0.5 - 32);
    const double within = std::clamp(along, -0.5, 0.5);
    EXPECT_NEAR(field.texel(i, 32), std::sin(within + std::atan(along - within)), 2e-4) << i;
  }
}

/// On a closed torus the map meets itself: texels across its border are those of the other side.
TEST(SolidMap, ContinuesWhereTheMapRepeats) {
  const surface::LimitSurface torus(surface::makeTorus(2, 1, 60, 60));
  const SolidFunction f = solidFunction(SolidNoise{0.8, 1, 0.5, 1});
  const HeightField field = makeSolidMap(torus, 300, 150, f, 1, Wrap::repeat);
  double inside = 0;
  double across = 0;
  for (int j = 0; j < 150; ++j) {
    for (int i = 0; i < 300; ++i) {
      const double step = std::abs(field.texel(i + 1, j) - field.texel(i, j));
      (i == 299 ? across : inside) = std::max(i == 299 ? across : inside, step);
    }
  }
  EXPECT_LE(across, inside);
  EXPECT_GT(across, 0);
}

/// Outside all charts, and beyond the margin, nothing is.
TEST(SolidMap, EndsAtItsMargin) {
  surface::Cage cage = surface::makePlane(2, 2, 4, 4);
  for (Vec2& uv : cage.uvs) uv = 0.25 + 0.5 * uv;
  const HeightField field = makeSolidMap(
      surface::LimitSurface(cage), 64, 64, [](const Vec3& p) { return 5 + p.x; }, 1, Wrap::clamp);
  // The chart is texels 16 to 47; the plane goes on in its margin.
  for (int i = 0; i < 64; ++i) {
    const bool isNear = i >= 12 && i < 52;
    EXPECT_NEAR(field.texel(i, 32), isNear ? 5 + 2 * (i + 0.5 - 32) / 32 : 0, 1e-5) << i;
  }
}

/// Two planes, the second beside the first or on it, that have the same texture coordinates.
surface::Cage stackedPlanes(double beside) {
  surface::Cage cage = surface::makePlane(16, 16, 4, 4);
  const surface::Cage first = cage;
  const int offset = static_cast<int>(first.positions.size());
  for (const Vec3& at : first.positions) cage.positions.push_back(at + Vec3(beside, 0, 0));
  for (const int vertex : first.faceVertices) cage.faceVertices.push_back(vertex + offset);
  cage.faceUvs.insert(cage.faceUvs.end(), first.faceUvs.begin(), first.faceUvs.end());
  cage.grid = std::nullopt;
  return cage;
}

TEST(SolidMap, RefusesChartsThatAskForTwoHeights) {
  const SolidFunction alongX = [](const Vec3& p) { return 0.5 + p.x / 100; };
  const SolidFunction alongY = [](const Vec3& p) { return 0.5 + p.y / 100; };
  const auto mapOn = [](double beside, const SolidFunction& solid, double amplitude) {
    return makeSolidMap(surface::LimitSurface(stackedPlanes(beside)), 32, 32, solid, amplitude,
                        Wrap::clamp);
  };
  try {
    (void)mapOn(20, alongX, 3);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("100 % of the surface's texels"), std::string::npos)
        << error.what();
  }
  // The same heights, to less than a step of 16 bits; and no heights.
  EXPECT_NO_THROW((void)mapOn(20, alongY, 3));
  EXPECT_NO_THROW((void)mapOn(100 * 0.9 * solidStep, alongX, 3));
  EXPECT_THROW((void)mapOn(100 * 1.1 * solidStep, alongX, 3), InputError);
  EXPECT_NO_THROW((void)mapOn(20, alongX, 0));
}

TEST(SolidMap, ChartsThatOverlapModuloTheMapAreRefusedWhereItRepeats) {
  surface::Cage cage = stackedPlanes(20);
  const std::size_t corners = cage.faceUvs.size() / 2;
  const auto uvs = static_cast<int>(cage.uvs.size());
  for (int k = 0; k < uvs; ++k)
    cage.uvs.push_back(cage.uvs[static_cast<std::size_t>(k)] + Vec2(3, -2));
  for (std::size_t k = corners; k < 2 * corners; ++k) cage.faceUvs[k] += uvs;
  const surface::LimitSurface surface(cage);
  const SolidFunction solid = [](const Vec3& p) { return 0.5 + p.x / 100; };
  EXPECT_NO_THROW((void)makeSolidMap(surface, 32, 32, solid, 3, Wrap::clamp));
  EXPECT_THROW((void)makeSolidMap(surface, 32, 32, solid, 3, Wrap::repeat), InputError);
}

TEST(SolidMap, SpotFoldsAtSoFewTexelsThatItIsAccepted) {
  const surface::LimitSurface spot(
      surface::readMeshFile(std::string(GNOMON_SCENES) + "/meshes/spot_control_mesh.obj"));
  EXPECT_NO_THROW(
      (void)makeSolidMap(spot, 128, 128, solidFunction(SolidNoise{0.24}), 1, Wrap::clamp));
}

}  // namespace
}  // namespace gnomon::relief
