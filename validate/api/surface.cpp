#include "gnomon/surface.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "api/inner/conversions.h"
#include "common/camera.h"
#include "common/error.h"
#include "render/gl_context.h"
#include "render/gpu_scene.h"
#include "render/passes/drawing.h"
#include "render/shader_files.h"
#include "study/spec/sections/bake_section.h"
#include "study/spec/sections/surface_section.h"
#include "study/spec/sections/view_section.h"
#include "surface/base_mesh.h"
#include "surface/cage/polygon_cage.h"
#include "surface/mesh_file.h"
#include "surface/sample_grid.h"

namespace gnomon {
inline namespace api {
namespace {

constexpr double mostSamples = 1 << 27;

Surface surfaceOf(surface::Cage cage) {
  return Surface(std::make_shared<const Surface::Data>(std::move(cage)));
}

surface::SubdivisionScheme schemeOf(bool triangles) {
  return triangles ? surface::SubdivisionScheme::loop : surface::SubdivisionScheme::catmullClark;
}

surface::SubdivisionScheme schemeNamed(std::string_view name) {
  study::SurfaceMesh mesh;
  study::readValues(toml::table{{"mesh", "file"}, {"scheme", name}}, "surface",
                    study::keysOf(mesh));
  return mesh.scheme;
}

template <std::size_t size>
std::vector<glm::vec<size, double>> vectorsOf(std::span<const double> numbers, const char* what) {
  if (numbers.size() % size != 0) {
    throw InputError(
        fmt::format("{}: {} numbers found, a multiple of {} expected", what, numbers.size(), size));
  }
  std::vector<glm::vec<size, double>> vectors(numbers.size() / size);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    vectors[i / size][static_cast<glm::length_t>(i % size)] = numbers[i];
  }
  return vectors;
}

surface::Cage polygonsOf(const surface::Cage& cage) {
  const std::vector<int> sizes(static_cast<std::size_t>(cage.faceCount()),
                               static_cast<int>(cage.faceSize()));
  return surface::makePolygonCage({.positions = cage.positions,
                                   .faceSizes = sizes,
                                   .faceVertices = cage.faceVertices,
                                   .uvs = cage.uvs,
                                   .faceUvs = cage.faceUvs},
                                  {});
}

surface::Cage cageOf(const ControlMesh& mesh) {
  surface::Cage cage;
  cage.scheme = schemeOf(mesh.triangles);
  cage.positions = vectorsOf<3>(mesh.positions, "positions");
  cage.uvs = vectorsOf<2>(mesh.uvs, "uvs");
  cage.faceVertices.assign(mesh.faces.begin(), mesh.faces.end());
  const std::span<const int> uvs = mesh.faceUvs.empty() ? mesh.faces : mesh.faceUvs;
  cage.faceUvs.assign(uvs.begin(), uvs.end());
  if (mesh.faces.size() % cage.faceSize() != 0 || uvs.size() != mesh.faces.size()) {
    throw InputError(
        fmt::format("faces: {} corners and {} texture corners found, as many of both and a "
                    "multiple of {} expected",
                    mesh.faces.size(), uvs.size(), cage.faceSize()));
  }
  if (mesh.polygons) return polygonsOf(cage);
  return cage;
}

toml::array arrayOf(std::span<const double> numbers) {
  toml::array array;
  for (const double number : numbers) array.push_back(number);
  return array;
}

/// Three numbers to a point; what is left over is refused as no point.
toml::array pointsOf(const std::vector<double>& numbers) {
  toml::array points;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    points.push_back(
        arrayOf(std::span(numbers).subspan(i, std::min<std::size_t>(3, numbers.size() - i))));
  }
  return points;
}

surface::Cage shapeOf(std::string_view shape, const ShapeKeys& keys) {
  toml::table table{{"shape", shape}};
  for (const auto& [key, numbers] : keys) {
    if (key == "points") {
      table.insert(key, pointsOf(numbers));
    } else if (key == "columns" && numbers.size() == 1 && std::trunc(numbers[0]) == numbers[0]) {
      table.insert(key, static_cast<std::int64_t>(numbers[0]));
    } else if (numbers.size() == 1) {
      table.insert(key, numbers[0]);
    } else {
      table.insert(key, arrayOf(numbers));
    }
  }
  const study::TomlReader section(table, std::string(shape), "");
  const study::SurfaceSection read = study::readSurfaceSection(section);
  section.finish();
  return study::cageOf(read, section, {});
}

void requireFew(double samples, const char* what) {
  if (samples <= mostSamples) return;
  throw InputError(
      fmt::format("{}: {} samples found, at most {} expected", what, samples, mostSamples));
}

surface::SampleGrid atlasGrid(const surface::LimitSurface& surface, int side) {
  study::ViewKind kind = study::AtlasSpec{};
  study::readValues(toml::table{{"samples", side}}, "atlas", study::keysOf(kind));
  requireFew(static_cast<double>(side) * side * surface.faceCount(), "atlas: samples");
  const render::RenderView view = render::atlasView(surface, side);
  surface::SampleGrid grid{view.width, view.height, {}};
  const auto middle = [side](int index) {
    return (static_cast<float>(index % side) + 0.5F) / static_cast<float>(side);
  };
  for (int y = view.height - 1; y >= 0; --y) {
    for (int x = 0; x < view.width; ++x) {
      const int face = y / side * view.atlasTiles.x + x / side;
      grid.samples.push_back(face < surface.faceCount()
                                 ? surface::SurfaceSample{face, middle(x), middle(y)}
                                 : surface::SurfaceSample{});
    }
  }
  return grid;
}

SurfaceSamples samplesOf(const surface::SampleGrid& grid, std::vector<double> weights) {
  SurfaceSamples samples{grid.width, grid.height, {}, std::move(weights)};
  samples.places.reserve(grid.samples.size());
  for (const surface::SurfaceSample& at : grid.samples)
    samples.places.push_back({at.face, at.s, at.t});
  return samples;
}

Camera cameraOf(const PinholeCamera& camera) {
  study::ViewKind kind = Camera{};
  study::readValues(toml::table{{"eye", arrayOf(camera.eye)},
                                {"target", arrayOf(camera.target)},
                                {"up", arrayOf(camera.up)},
                                {"fov", camera.fov},
                                {"width", camera.width},
                                {"height", camera.height}},
                    "camera", study::keysOf(kind));
  requireFew(static_cast<double>(camera.width) * camera.height, "camera");
  return std::get<Camera>(kind);
}

}  // namespace

int Surface::faceCount() const {
  return data_->limit.faceCount();
}

Surface makeSurface(const ControlMesh& mesh) {
  return translated([&] { return surfaceOf(cageOf(mesh)); });
}

Surface readSurface(const std::filesystem::path& file, std::string_view scheme) {
  return translated([&] { return surfaceOf(surface::readMeshFile(file, schemeNamed(scheme))); });
}

Surface makeShape(std::string_view shape, const ShapeKeys& keys) {
  return translated([&] { return surfaceOf(shapeOf(shape, keys)); });
}

SurfaceSamples atlasSamples(const Surface& surface, int samples) {
  return translated([&] {
    const surface::LimitSurface& limit = surface.data().limit;
    const surface::SampleGrid grid = atlasGrid(limit, samples);
    return samplesOf(grid, surface::sampleAreas(limit, grid, samples));
  });
}

SurfaceSamples cameraSamples(const Surface& surface, const PinholeCamera& camera,
                             int subdivisions) {
  return translated([&] {
    const Camera checked = cameraOf(camera);
    study::BaseSpec base;
    study::readValues(toml::table{{"subdivisions", subdivisions}}, "camera", study::keysOf(base));
    // The samples do not depend on the map.
    const surface::BaseMesh mesh =
        surface::makeBaseMesh(surface.data().limit, Vec2(1), subdivisions);
    const render::RenderView view = render::cameraView(checked, mesh);
    return onOwnThread([&] {
      const render::GlContext gl;
      return samplesOf(
          render::SamplesPass(render::shaderFolder()).render(view, render::GpuMesh(mesh)), {});
    });
  });
}

}  // namespace api
}  // namespace gnomon
