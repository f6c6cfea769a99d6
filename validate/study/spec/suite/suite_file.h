#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/random_stream.h"
#include "common/vec.h"
#include "study/spec/toml_reader.h"

namespace gnomon::study {

/// A number with four significant digits, as they are written in decimals. Its text is the same on
/// every machine unless the number lies within rounding of the middle between two of them.
double roundedNumber(double value);

/// What a number of a suite is drawn from: a list of values, each as probable as the others, so
/// that a draw is one whole number. In the file:
///   { from = 5, to = 75, step = 0.5 }  from, from + step, … to; of six decimals at most
///   { log = [0.05, 0.8] }              1,025 values in geometric progression, each a roundedNumber
///   { among = [8, 12, 16] }            these
///   3                                  this
/// Every value is the same on every machine: it is made with +, ×, / and square roots alone.
class Distribution {
 public:
  explicit Distribution(std::vector<double> values) : values_(std::move(values)) {}

  /// One of the values. Takes one number of the stream, even where there is but one value.
  [[nodiscard]] double draw(RandomStream& random) const;
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

 private:
  std::vector<double> values_;  ///< at least one
};

/// Reads a key's distribution.
/// @param range  of every value
/// @throws InputError as TomlReader
Distribution readDistribution(const TomlReader& section, std::string_view key,
                              NumberRange range = anyNumber);

/// Sine and cosine of an angle in degrees, the same bits on every machine: by their series, with +
/// and × alone. Err by less than 1e-15. A library's own may differ in the last bit.
struct SineCosine {
  double sine, cosine;
};
SineCosine sineCosine(double degrees);

/// The unit vector at an elevation over the xy plane and an azimuth from +x about +z, degrees.
Vec3 exactDirection(double elevation, double azimuth);

/// The file of a suite, as scenes/suite/suite-1.toml: what its scenes are drawn from. Its comments
/// and docs/suite.md say what every key means. Lengths on open patches and on the torus are texels,
/// and a texel is one world unit.

/// What surfaces a relief may lie on.
enum class SurfaceClass {
  open,    ///< a patch with a border
  torus,   ///< closed both ways, and so is the map
  body,    ///< a closed mesh with seams
  shared,  ///< a mesh some of whose texels belong to two places
};

enum class SurfaceKind { plane, cylinder, sphere, insideSphere, torus, bezier, bSpline, mesh };

/// `[[surface]]`
struct SuiteSurface {
  SurfaceKind kind = SurfaceKind::plane;
  std::string name;  ///< of the kind, or the mesh's
  int weight = 1;
  Distribution turn{{90}};  ///< arcs: degrees that the surface turns by along its longer side
  Distribution bend{{0}};   ///< bezier, b-spline: control points stray so far, over the mean side
  Distribution sway{{0}};   ///< and sideways, over their distance
  // of a mesh
  std::string file;            ///< relative to the folder above the suite's own
  std::string wrap = "clamp";  ///< "repeat" where the one chart closes on itself
  Vec3 target{0};              ///< middle of its bounding sphere
  double radius = 1;
  double texel = 1;     ///< world units: mean side of a texel of a map of 1,000 × 1,000
  double face = 1;      ///< mean side of a face, over the side of the map
  bool shared = false;  ///< whether texels belong to two places
};

SurfaceClass classOf(const SuiteSurface& surface);

/// `[[relief]]`
struct SuiteRelief {
  std::string form;  ///< pattern, solid or image
  std::string name;  ///< of the pattern or solid, or the image's file
  int weight = 1;
  std::vector<SurfaceClass> on;
  Distribution height{{0}};  ///< over the feature
  Vec2 shadow{0};  ///< least and most length of a bump's shadow on a plane, over the feature
  bool wholePeriods = false;  ///< on the torus: whether features must fit a whole number of times
  bool seeded = false;
  std::map<std::string, Distribution> lengths;  ///< keys of [relief], times the feature
  std::map<std::string, Distribution> shares;   ///< keys of [relief], as they are
  std::optional<glm::ivec2> texels;             ///< of an image
  std::optional<double> feature;                ///< of an image, texels
};

struct SuiteSpec {
  std::filesystem::path file;
  std::string name;
  int tries = 1000;  ///< after so many scenes against a limit the file is refused
  std::vector<SuiteSurface> surfaces;
  std::vector<SuiteRelief> reliefs;

  // [map]
  Distribution side{{256}}, bodySide{{512}}, feature{{16}}, bodyFeature{{0.1}};
  double fewestFeatures = 4, fewestTexels = 6;
  // [curvature]
  double leastCurvature = 0, mostCurvature = 1;  ///< largest |κ| × height
  // [light]
  Distribution lightElevation{{30}}, lightAzimuth{{0}}, bodyLightElevation{{30}};
  double aboveRim = 5;
  double leastFromCamera = 20, mostFromCamera = 110;  ///< degrees, of bodies
  std::optional<Distribution> lightRadius;  ///< degrees, of the light's disc; none: a point
  // [view]
  int cameraWeight = 2, atlasWeight = 1;
  Distribution cameraElevation{{60}}, cameraAzimuth{{0}}, bodyCameraElevation{{0}};
  int pixels = 320, atlasSamples = 100000;
  double fov = 30, margin = 1.05;
  // [rules]
  double texelsPerFace = 8, radiansPerFace = 0.1, triangles = 4e6;
  int azimuths = 32, bits = 8, frames = 3;
};

/// Reads and checks the file of a suite. One with `like = "suite-1.toml"` under `[suite]` has only
/// its own name there, and `[light] radius`: all else is drawn as for that suite.
/// @throws InputError naming file, line, key, what was found and what was expected
SuiteSpec readSuite(const std::filesystem::path& file);

/// The suite that comes with the program: scenes/suite/suite-1.toml beside its shaders.
std::filesystem::path standardSuiteFile();

}  // namespace gnomon::study
