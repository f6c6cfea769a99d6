#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"
#include "common/random_stream.h"
#include "relief/patterns.h"
#include "relief/solid.h"
#include "support/error_messages.h"
#include "surface/cage/shapes.h"
#include "surface/closed_surface.h"
#include "surface/mesh_file.h"
#include "surface/texel_frame.h"

namespace gnomon::relief {
namespace {

using ::testing::StartsWith;

std::vector<Vec3> somePoints(int count) {
  RandomStream random(1);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.unit() * 20 - 10, random.unit() * 20 - 10, random.unit() * 20 - 10);
  }
  return points;
}

TEST(Solid, EveryKindRunsFromAboutZeroToOne) {
  for (const SolidPattern& solid :
       {SolidPattern(SolidNoise{}), SolidPattern(SolidCells{}), SolidPattern(SolidRipples{})}) {
    const SolidFunction f = solidFunction(solid);
    double least = 1;
    double most = 0;
    for (const Vec3& p : somePoints(20000)) {
      least = std::min(least, f(p));
      most = std::max(most, f(p));
    }
    EXPECT_GE(least, 0) << solid.index();
    EXPECT_LT(least, 0.25) << solid.index();
    EXPECT_LE(most, 1) << solid.index();
    EXPECT_GT(most, 0.75) << solid.index();
  }
}

/// Continuous at the borders of its lattice, in value and slope; a half on lattice points.
TEST(Solid, NoiseIsSmooth) {
  const SolidFunction f = solidFunction(SolidNoise{2, 1, 0.5, 3});
  EXPECT_DOUBLE_EQ(f({0, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(f({-4, 2, 6}), 0.5);
  constexpr double e = 1e-5;
  for (int k = -5; k < 5; ++k) {
    const Vec3 p(2 * k, 0.7 * k, 0.3);
    const Vec3 step(e, 0, 0);
    const double before = (f(p) - f(p - step)) / e;
    const double after = (f(p + step) - f(p)) / e;
    EXPECT_NEAR(before, after, 1e-3) << k;
  }
  // Another seed is another noise, and no symmetry is left in it.
  const SolidFunction other = solidFunction(SolidNoise{2, 1, 0.5, 4});
  double apart = 0;
  double mirrored = 0;
  for (const Vec3& p : somePoints(200)) {
    apart += std::abs(f(p) - other(p));
    mirrored += std::abs(f(p) - f({p.y, p.x, p.z}));
  }
  EXPECT_GT(apart / 200, 0.05);
  EXPECT_GT(mirrored / 200, 0.05);
}

TEST(Solid, OctavesAddWhatTheirFormulaSays) {
  const SolidFunction one = solidFunction(SolidNoise{1, 1, 0.5, 1});
  const SolidFunction two = solidFunction(SolidNoise{1, 2, 0.5, 1});
  // The second octave is half as long: where the first is the same a half on lattice points, what
  // is left is a third of the second, which is at most 0.52 √2 there.
  double most = 0;
  for (int i = -20; i < 20; ++i) {
    const Vec3 p(i, 2 * i + 1, 7 - i);
    EXPECT_DOUBLE_EQ(one(p), 0.5);
    most = std::max(most, std::abs(two(p) - 0.5));
  }
  EXPECT_GT(most, 0.02);
  EXPECT_LT(most, 1.0 / 6 * 1.1);
}

/// Each scale lies about its point, so a line from one scale to another passes a groove; without
/// jitter the points are the middles of cubes.
TEST(Solid, CellsWithoutJitterAreCubes) {
  const SolidFunction f = solidFunction(SolidCells{2, 0, 0.2, 1});
  for (const Vec3& cube : {Vec3(0), Vec3(4, -6, 10)}) {
    EXPECT_NEAR(f(cube + Vec3(1, 1, 1)), 1, 1e-6);
    EXPECT_NEAR(f(cube + Vec3(0, 1, 1)), 0, 1e-6);
    EXPECT_NEAR(f(cube + Vec3(1, 1, 2)), 0, 1e-6);
    // Along an axis at half a groove's width from the border: smoothstep(½), and the dome.
    EXPECT_NEAR(f(cube + Vec3(0.1, 1, 1)), 0.5 * (1 - 0.6 * 0.45 * 0.45), 1e-3);
  }
}

TEST(Solid, RipplesWithoutMeanderArePlanes) {
  const SolidFunction f = solidFunction(SolidRipples{4, 0.7, 0, {0, 3, 4}, 1});
  for (const Vec3& p : somePoints(100)) {
    EXPECT_NEAR(f(p), f(p + Vec3(1, 0, 0)), 1e-9);
    EXPECT_NEAR(f(p), f(p + Vec3(0, 4, -3)), 1e-9);
  }
  EXPECT_NEAR(f({0, 0, 0}), 0, 1e-9);
  EXPECT_NEAR(f(2.8 * Vec3(0, 0.6, 0.8)), 1, 1e-9);
}

TEST(Solid, RefusesParametersOutOfRange) {
  const auto messageFor = [](const SolidPattern& solid) {
    return messageOf<InputError>([&] { (void)solidFunction(solid); });
  };
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(messageFor(SolidNoise{bad}), StartsWith("period: "));
    EXPECT_THAT(messageFor(SolidCells{bad}), StartsWith("period: "));
    EXPECT_THAT(messageFor(SolidRipples{bad}), StartsWith("period: "));
    EXPECT_THAT(messageFor(SolidCells{1, 0.5, bad}), StartsWith("groove: "));
  }
  EXPECT_THAT(messageFor(SolidNoise{1, 0}), StartsWith("octaves: "));
  EXPECT_THAT(messageFor(SolidNoise{1, 2, 1.5}), StartsWith("gain: "));
  EXPECT_THAT(messageFor(SolidCells{1, 1.5}), StartsWith("jitter: "));
  EXPECT_THAT(messageFor(SolidRipples{1, 1.0}), StartsWith("windward: "));
  EXPECT_THAT(messageFor(SolidRipples{1, 0.7, 0, Vec3(0)}), StartsWith("direction: "));
}

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

/// Six texels by three, no two alike.
HeightField someImage() {
  std::vector<float> texels;
  for (int k = 0; k < 18; ++k) texels.push_back(static_cast<float>(0.05 * k + 0.01 * (k * k % 7)));
  return {6, 3, texels, Wrap::repeat};
}

/// A plane through the origin that faces an axis, its two sides along the next axes.
surface::LimitSurface planeFacing(int axis) {
  surface::Cage cage = surface::makePlane(6, 3, 4, 5);
  for (Vec3& p : cage.positions) {
    Vec3 turned(0);
    turned[(axis + 1) % 3] = p.x;
    turned[(axis + 2) % 3] = p.y;
    turned[axis] = p.z;
    p = turned;
  }
  return surface::LimitSurface(cage);
}

/// Texel i of a row that goes on, to both sides of 0, in mirror images.
int mirroredTexel(int i, int side) {
  const int within = ((i % (2 * side)) + 2 * side) % (2 * side);
  return within < side ? within : 2 * side - 1 - within;
}

TEST(Triplanar, OnAPlaneThatFacesAnAxisIsTheImage) {
  const HeightField image = someImage();
  for (int axis = 0; axis < 3; ++axis) {
    // Two images side by side and one above the other: the map's middle is the origin.
    const HeightField field =
        makeSolidMap(planeFacing(axis), 12, 6, triplanar(image, 3), 2, Wrap::clamp);
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 12; ++i) {
        const double expected = 2.0 * static_cast<double>(image.texel(mirroredTexel(i - 6, 6),
                                                                      mirroredTexel(j - 3, 3)));
        EXPECT_NEAR(field.texel(i, j), expected, 1e-6) << axis << " " << i << " " << j;
      }
    }
  }
}

TEST(Triplanar, BlendsByTheFourthPowersOfTheNormal) {
  const HeightField image = someImage();
  const SurfaceFunction f = triplanar(image, 6);
  const Vec3 place(0.7, 2.2, 1.4);
  const double x = image.at({place.y, place.z});
  const double y = image.at({place.z, place.x});
  const double z = image.at({place.x, place.y});
  EXPECT_NEAR(f(place, {1, 0, 0}), x, 1e-12);
  EXPECT_NEAR(f(place, {0, 0, -1}), z, 1e-12);
  EXPECT_NEAR(f(place, glm::normalize(Vec3(1, -1, 1))), (x + y + z) / 3, 1e-12);
  const double tilt = radians(30);
  EXPECT_NEAR(f(place, {std::sin(tilt), 0, std::cos(tilt)}), 0.1 * x + 0.9 * z, 1e-12);
  EXPECT_NEAR(f(place, Vec3(0)), (x + y + z) / 3, 1e-12);
  EXPECT_GT(std::abs(x - z), 0.1);
}

TEST(Triplanar, IsContinuousWhereTheImageEnds) {
  const SurfaceFunction f = triplanar(someImage(), 6);
  constexpr double e = 1e-9;
  for (const double side : {-12.0, -6.0, 0.0, 3.0, 6.0, 9.0, 12.0}) {
    for (const double other : {0.3, 1.1, 2.8}) {
      const Vec3 normal(0, 0, 1);
      EXPECT_NEAR(f({side - e, other, 0}, normal), f({side + e, other, 0}, normal), 1e-8);
      EXPECT_NEAR(f({other, side - e, 0}, normal), f({other, side + e, 0}, normal), 1e-8);
    }
  }
}

TEST(Triplanar, RefusesPeriodsOutOfRange) {
  for (const double bad : {0.0, -1.0, 1e10}) {
    EXPECT_THAT(messageOf<InputError>([&] { (void)triplanar(someImage(), bad); }),
                StartsWith("period: "));
  }
}

}  // namespace
}  // namespace gnomon::relief
