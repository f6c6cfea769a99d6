#pragma once

#include <string>
#include <variant>
#include <vector>

#include "common/camera.h"
#include "common/light.h"
#include "common/lists.h"
#include "compare/metric.h"
#include "relief/relief.h"
#include "render/check/pass_check.h"
#include "render/gpu_scene.h"
#include "study/spec/sections/study_key.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"

namespace gnomon::study {

/// The sun's angular radius as seen from the Earth, degrees: mean over the year.
constexpr double sunRadius = 0.266;
/// The largest angular radius of a light, degrees.
constexpr double largestLightRadius = 10;

/// `[[light]]` as the file has it: one light, or every elevation with every azimuth.
struct LightSection {
  std::vector<double> elevations;      ///< degrees
  std::vector<double> azimuths = {0};  ///< degrees
  std::string name;
  double radius = 0;  ///< degrees
  bool sun = false;
};

inline StudyKeys keysOf(LightSection& light) {
  return {
      studyKey("elevation", NumberOrList{&light.elevations}, "degrees over the xy plane", {-90, 90},
               required),
      studyKey("azimuth", NumberOrList{&light.azimuths}, "degrees from +x about +z", {-360, 360}),
      studyKey("name", &light.name, "of a light that stands alone", {},
               "`\"elevation 24° azimuth 165°\"`", Enters::nothing),
      studyKey("radius", Unusual{&light.radius},
               "degrees: angular radius of the light's disc, for soft shadows; 0 is a point",
               {0, largestLightRadius}),
      studyKey("sun", Unusual{&light.sun}, "in place of `radius`: that of the sun, 0.266°")};
}

/// The lights of a section, in the order of azimuths, and of elevations under each.
/// @throws InputError as TomlReader, for a name of several lights and for two radii too
std::vector<Light> readLights(const TomlReader& section);

/// One light as a section of its own.
LightSection sectionOf(const Light& light);

/// `[[view]]`: which samples of the surface are compared. Each kind is a type, told by its `type`;
/// what differs between kinds is behind std::visit here and in `ViewMap`, so that the compiler
/// names each place that does not know a new kind.

/// A regular grid over every face's parameters.
struct AtlasSpec {
  int samplesPerSide = 1;  ///< of every face
};

using ViewKind = std::variant<Camera, AtlasSpec>;
constexpr std::array<std::string_view, 2> viewKindNames = {"camera", "atlas"};

struct ViewSpec {
  std::string name;
  ViewKind kind;
};

inline StudyKeys keysOf(ViewKind& kind) {
  constexpr int mostPixelsASide = 16384;
  constexpr int mostSamplesASide = 4096;
  using Keys = StudyKeys;
  return std::visit(
      Overloaded{
          [](Camera& camera) -> Keys {
            return {studyKey("eye", numbers(camera.eye), "where the camera is", {}, required),
                    studyKey("target", numbers(camera.target), "the point in the picture's middle"),
                    studyKey("up", numbers(camera.up), "upward in the picture"),
                    studyKey("fov", degrees(camera.verticalFov), "degrees: full vertical angle",
                             {0.1, 170}),
                    studyKey("width", &camera.width, "pixels", {1, mostPixelsASide}, required),
                    studyKey("height", &camera.height, "pixels", {1, mostPixelsASide}, required)};
          },
          [](AtlasSpec& atlas) -> Keys {
            return {studyKey("samples", &atlas.samplesPerSide,
                             "along a face's side; an odd number keeps them off micro-edges",
                             {1, mostSamplesASide}, required)};
          }},
      kind);
}

/// The keys that all kinds have.
inline StudyKeys keysOf(ViewSpec& view) {
  return {studyKey("name", &view.name, "of the view", {}, "its `type`", Enters::nothing)};
}

/// Reads a `[[view]]`.
/// @param quick  whether the study has the quick form: a quarter of the side
/// @throws InputError as TomlReader
ViewSpec readView(const TomlReader& section, bool quick);

/// The section as a table of the file.
toml::table tableOf(ViewSpec view);

/// The largest picture that the view's full form may have: in pixels, or in texels of the map and
/// samples.
compare::PictureExtent fullExtent(const ViewSpec& view, bool quick, Vec2 texelsPerUv, int faces);

/// What a kind of view can and cannot do.
struct ViewTraits {
  /// The view's camera; null where its samples are no pixels of one. Only camera views count shadow
  /// volumes, show the displaced surface and time frames.
  const Camera* camera;
  bool hasFixedSamples;          ///< whatever mesh is drawn, the samples are the same
  render::PassKind samplesPass;  ///< by which the driver renders the samples
};
ViewTraits traitsOf(const ViewSpec& view);

inline const Camera* cameraOf(const ViewSpec& view) {
  return traitsOf(view).camera;
}
inline bool hasFixedSamples(const ViewSpec& view) {
  return traitsOf(view).hasFixedSamples;
}

/// The view's picture without its projection: its size in samples.
render::RenderView pictureSize(const ViewSpec& view, const surface::LimitSurface& surface);

/// The view of a mesh, to draw.
/// @throws InputError as cameraView
render::RenderView renderView(const ViewSpec& view, const surface::LimitSurface& surface,
                              const surface::BaseMesh& mesh);

/// The world area of each sample, or nothing where every sample counts the same.
std::vector<double> sampleWeights(const ViewSpec& view, const surface::LimitSurface& surface,
                                  const surface::SampleGrid& samples);

}  // namespace gnomon::study
