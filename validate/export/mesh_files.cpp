#include "export/mesh_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "common/files/atomic_file.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "export/truth_files.h"
#include "truth/displaced_picture.h"
#include "truth/shadow_tracer.h"
#include "truth/visibility_tracer.h"

namespace gnomon::exporting {

namespace {

static_assert(sizeof(glm::vec3) == 12, "a vertex of the PLY is three floats and nothing else");

std::string plyHeader(const displaced::WeldedMesh& mesh, const std::string& comment) {
  const char* order = std::endian::native == std::endian::little ? "little" : "big";
  return fmt::format(
      "ply\nformat binary_{}_endian 1.0\ncomment {}\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      order, comment, mesh.vertices.size(), mesh.triangleCount());
}

/// The face records: a count of 3 and three indices, 13 bytes without padding.
std::string faceBytes(const displaced::WeldedMesh& mesh, std::size_t first, std::size_t count) {
  constexpr std::size_t indexBytes = 3 * sizeof(std::uint32_t);
  std::string bytes(count * (1 + indexBytes), '\3');
  for (std::size_t face = 0; face < count; ++face) {
    std::memcpy(&bytes[face * (1 + indexBytes) + 1], &mesh.triangles[3 * (first + face)],
                indexBytes);
  }
  return bytes;
}

}  // namespace

void writePly(const std::filesystem::path& path, const displaced::WeldedMesh& mesh,
              const std::string& comment) {
  writeAtomically(path, [&](int file) {
    writeAll(file, plyHeader(mesh, comment));
    writeAll(file, {reinterpret_cast<const char*>(mesh.vertices.data()),
                    mesh.vertices.size() * sizeof(glm::vec3)});
    constexpr std::size_t atOnce = 1 << 16;
    for (std::size_t first = 0; first < mesh.triangleCount(); first += atOnce) {
      writeAll(file, faceBytes(mesh, first, std::min(atOnce, mesh.triangleCount() - first)));
    }
  });
}

void writeObj(const std::filesystem::path& path, const surface::BaseMesh& mesh, Vec2 texelsPerUv,
              const std::string& comment) {
  constexpr double bytesPerVertex = 160;
  constexpr double bytesPerTriangle = 80;
  requireMemory(bytesPerVertex * static_cast<double>(mesh.vertices.size()) +
                    bytesPerTriangle * static_cast<double>(mesh.triangleCount()),
                path.string());
  std::string text = fmt::format("# {}\n", comment);
  const auto shortest = [](double value) { return static_cast<float>(value); };
  const auto append = [&](const char* key, const Vec3& v) {
    text += fmt::format("{} {} {} {}\n", key, shortest(v.x), shortest(v.y), shortest(v.z));
  };
  for (const surface::BaseVertex& vertex : mesh.vertices) {
    const Vec2 uv = vertex.frame.texel / texelsPerUv;
    append("v", vertex.frame.position);
    text += fmt::format("vt {} {}\n", shortest(uv.x), shortest(uv.y));
    append("vn", vertex.frame.normal);
  }
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
    text += fmt::format("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", mesh.triangles[k] + 1,
                        mesh.triangles[k + 1] + 1, mesh.triangles[k + 2] + 1);
  }
  writeTextAtomically(path, text);
}

namespace {

image::ChannelImage mapOf(const truth::SeenSurface& seen, const Vec3& centre) {
  image::ChannelImage map{seen.width,
                          seen.height,
                          {"point.X", "point.Y", "point.Z", "facet.X", "facet.Y", "facet.Z"},
                          {}};
  map.values.reserve(6 * seen.points.size());
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const truth::SeenSurface::Point& seenPoint = seen.points[i];
    const Vec3 point = seenPoint.isThere ? seenPoint.facet.point + centre : Vec3(0);
    const Vec3 normal = seenPoint.isThere ? seenPoint.facet.normal : Vec3(0);
    for (const Vec3& vector : {point, normal}) {
      for (int k = 0; k < 3; ++k) map.values.push_back(static_cast<float>(vector[k]));
    }
  }
  return map;
}

/// @param light  as displacedPicture
Mask maskOf(const truth::SeenSurface& seen, const std::vector<float>& light) {
  Mask mask{seen.width, seen.height, std::vector<Shade>(light.size())};
  std::transform(light.begin(), light.end(), mask.samples.begin(), [](float value) {
    return value < 0 ? Shade::none : value > 0 ? Shade::lit : Shade::shadowed;
  });
  return mask;
}

/// @param directions  toward the disc of a light that has one
truth::Truth truthOf(const truth::SeenSurface& seen, const truth::MicroScene& scene,
                     const Light& light, int directions) {
  truth::Truth found;
  found.mask = maskOf(seen, truth::displacedPicture(seen, scene, light.direction));
  if (light.isSoft()) {
    found.answerBy(truth::traceVisibility(seen, scene, found.mask, {light, directions}));
  }
  return found;
}

}  // namespace

std::string drawnMapFile(const study::CaseNames& names, std::size_t view) {
  return fmt::format("drawn/samples/{}.exr", names.views[view]);
}

std::string drawnMaskFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("drawn/masks/{}_{}_truth.png", names.views[view], names.lights[light]);
}

std::string drawnShareFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("drawn/shares/{}_{}_truth.exr", names.views[view], names.lights[light]);
}

DrawnTruths writeDrawnMesh(report::RunFolder& folder, const study::RunScene& scene,
                           const study::TracedSurface& surface) {
  const study::StudySpec& study = scene.study;
  const study::CaseNames names = study::caseNames(study);
  DrawnTruths drawn(study.views.size());
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    const Camera* camera = cameraOf(study.views[v]);
    if (camera == nullptr) continue;
    const truth::SeenSurface seen = truth::seenSurface(surface.mesh, surface.scene, *camera);
    writeSampleMap(folder, drawnMapFile(names, v), mapOf(seen, surface.mesh.centre()));
    for (std::size_t l = 0; l < study.lights.size(); ++l) {
      drawn[v].push_back(truthOf(seen, surface.scene, study.lights[l], study.truth.directions));
      writeTruthMask(folder, drawn[v].back(), drawnMaskFile(names, v, l),
                     drawnShareFile(names, v, l));
    }
  }
  return drawn;
}

std::vector<std::vector<double>> drawnUncertainties(const study::RunScene& scene,
                                                    const study::TracedSurface& coarse,
                                                    const DrawnTruths& drawn) {
  const study::StudySpec& study = scene.study;
  std::vector<std::vector<double>> uncertainties(study.views.size());
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    const Camera* camera = cameraOf(study.views[v]);
    if (camera == nullptr) continue;
    truth::SeenSurface seen = truth::seenSurface(coarse.mesh, coarse.scene, *camera);
    seen.rayOffset /= 2;
    for (std::size_t l = 0; l < study.lights.size(); ++l) {
      const truth::Truth other =
          truthOf(seen, coarse.scene, study.lights[l], study.truth.directions / 2);
      uncertainties[v].push_back(truth::uncertaintyOf(drawn[v][l], other));
    }
  }
  return uncertainties;
}

namespace {

/// Over some samples: sums in place of means.
struct Sums {
  std::size_t samples = 0;
  double largest = 0, sum = 0, largestTexels = 0, sumTexels = 0;

  void add(double world, double texels) {
    ++samples;
    largest = std::max(largest, world);
    sum += world;
    largestTexels = std::max(largestTexels, texels);
    sumTexels += texels;
  }
  void add(const Sums& other) {
    samples += other.samples;
    largest = std::max(largest, other.largest);
    sum += other.sum;
    largestTexels = std::max(largestTexels, other.largestTexels);
    sumTexels += other.sumTexels;
  }
};

}  // namespace

MeshDistance meshDistance(study::RunScene& scene, const truth::MicroMesh& truth,
                          const displaced::WeldedMesh& exported, int pieces) {
  Sums all;
  for (const study::ViewCase& view : scene.standardBase().views) {
    const surface::SampleGrid& grid = view.samples;
    const auto width = static_cast<std::size_t>(grid.width);
    std::vector<Sums> rows(static_cast<std::size_t>(grid.height));
    parallelFor(0, rows.size(), [&](std::size_t row) {
      truth::SamplePlacer placer(scene.surface, scene.study.relief.texelsPerUv(), truth);
      for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
        const truth::SamplePlace place = placer.place(grid.samples[i]);
        if (!place.defined) continue;
        const Vec3 other =
            displaced::pointOn(exported, pieces, place.sample.face, place.sample.s, place.sample.t);
        const double world = glm::length(place.facet.point + truth.centre() - other);
        const double texel = std::sqrt(glm::length(glm::cross(place.frame.px, place.frame.py)));
        rows[row].add(world, world / texel);
      }
    });
    for (const Sums& row : rows) all.add(row);  // in one order: the same bits on any machine
  }
  const auto count = static_cast<double>(std::max<std::size_t>(all.samples, 1));
  return {all.samples, all.largest, all.sum / count, all.largestTexels, all.sumTexels / count};
}

}  // namespace gnomon::exporting
