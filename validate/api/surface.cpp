#include "gnomon/surface.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <string>

#include "api/inner/surface_data.h"
#include "api/inner/translated.h"
#include "common/camera.h"
#include "common/error.h"
#include "render/gl_context.h"
#include "render/passes/passes.h"
#include "render/shader_files.h"
#include "render/view.h"
#include "surface/base_mesh.h"
#include "surface/cage/shapes.h"
#include "surface/mesh_file.h"
#include "surface/sample_grid.h"

namespace gnomon {
inline namespace api {
namespace {

constexpr double mostSamples = 1 << 27;
constexpr int mostPixelsASide = 16384;

Surface surfaceOf(surface::Cage cage) {
  return Surface(std::make_shared<const Surface::Data>(std::move(cage)));
}

surface::SubdivisionScheme schemeOf(bool triangles) {
  return triangles ? surface::SubdivisionScheme::loop : surface::SubdivisionScheme::catmullClark;
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
  return cage;
}

surface::Cage shapeOf(std::string_view shape, const std::vector<double>& sizes, int columns,
                      int rows) {
  static const std::map<std::string_view, std::size_t> counts = {
      {"plane", 2}, {"cylinder", 3}, {"sphere", 3}, {"torus", 2}};
  const auto found = counts.find(shape);
  if (found == counts.end()) {
    throw InputError(fmt::format("shape \"{}\": plane, cylinder, sphere or torus expected", shape));
  }
  if (sizes.size() != found->second) {
    throw InputError(fmt::format("shape \"{}\": {} sizes found, {} expected", shape, sizes.size(),
                                 found->second));
  }
  if (shape == "plane") return surface::makePlane(sizes[0], sizes[1], columns, rows);
  if (shape == "torus") return surface::makeTorus(sizes[0], sizes[1], columns, rows);
  if (shape == "cylinder")
    return surface::makeCylinder(sizes[0], sizes[1], sizes[2], columns, rows);
  return surface::makeSphere(sizes[0], sizes[1], sizes[2], columns, rows);
}

surface::SampleGrid atlasGrid(const surface::LimitSurface& surface, int side) {
  if (side < 1 || !(static_cast<double>(side) * side * surface.faceCount() <= mostSamples)) {
    throw InputError(
        fmt::format("side: {} found, at least 1 and at most {} samples on {} faces "
                    "expected",
                    side, mostSamples, surface.faceCount()));
  }
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

Vec3 vectorOf(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

Camera cameraOf(const PinholeCamera& camera) {
  const auto isSide = [](int pixels) { return pixels >= 1 && pixels <= mostPixelsASide; };
  if (!isSide(camera.width) || !isSide(camera.height) ||
      !(static_cast<double>(camera.width) * camera.height <= mostSamples)) {
    throw InputError(fmt::format("camera: {} × {} pixels found, sides of 1 to {} expected",
                                 camera.width, camera.height, mostPixelsASide));
  }
  if (!(camera.verticalFov > 0 && camera.verticalFov < pi)) {
    throw InputError(
        fmt::format("camera: verticalFov {} found, 0 to π expected", camera.verticalFov));
  }
  for (const auto* vector : {&camera.eye, &camera.target, &camera.up}) {
    for (const double number : *vector) {
      if (std::isfinite(number)) continue;
      throw InputError(fmt::format("camera: {} found, a finite number expected", number));
    }
  }
  return {vectorOf(camera.eye), vectorOf(camera.target),
          vectorOf(camera.up),  camera.verticalFov,
          camera.width,         camera.height};
}

}  // namespace

int Surface::faceCount() const {
  return data_->limit.faceCount();
}

Surface makeSurface(const ControlMesh& mesh) {
  return translated([&] { return surfaceOf(cageOf(mesh)); });
}

Surface readSurface(const std::filesystem::path& file, bool triangles) {
  return translated([&] { return surfaceOf(surface::readMeshFile(file, schemeOf(triangles))); });
}

Surface makeShape(std::string_view shape, const std::vector<double>& sizes, int columns, int rows) {
  return translated([&] { return surfaceOf(shapeOf(shape, sizes, columns, rows)); });
}

SurfaceSamples atlasSamples(const Surface& surface, int side) {
  return translated([&] {
    const surface::LimitSurface& limit = surface.data().limit;
    const surface::SampleGrid grid = atlasGrid(limit, side);
    return samplesOf(grid, surface::sampleAreas(limit, grid, side));
  });
}

SurfaceSamples cameraSamples(const Surface& surface, const PinholeCamera& camera,
                             int subdivisions) {
  return translated([&] {
    const Camera checked = cameraOf(camera);
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
