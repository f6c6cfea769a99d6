#include "study/run/scene/run_keys.h"

#include <vector>

#include "common/files/atomic_file.h"
#include "common/system/own_files.h"
#include "render/shader_files.h"
#include "study/run/scene/environment.h"
#include "surface/limit_surface.h"
#include "truth/micro_scene.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

std::span<const double> numbersOf(const std::vector<Vec3>& points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {reinterpret_cast<const double*>(points.data()), 3 * points.size()};
}

std::span<const double> numbersOf(const std::vector<Vec2>& points) {
  static_assert(sizeof(Vec2) == 2 * sizeof(double));
  return {reinterpret_cast<const double*>(points.data()), 2 * points.size()};
}

void add(KeyBuilder& key, const char* name, const Vec3& point) {
  key.add(name, std::vector<double>{point.x, point.y, point.z});
}

ContentKey fieldKey(const HeightField& field) {
  KeyBuilder key("heights");
  key.add("width", field.width()).add("height", field.height()).add("wrap", field.wrap());
  key.add("borderX", field.border().x).add("borderY", field.border().y);
  return key.add("texels", field.texels()).key();
}

ContentKey viewKey(const ViewSpec& view) {
  KeyBuilder key("view");
  if (const auto* camera = std::get_if<Camera>(&view.kind)) {
    add(key, "eye", camera->eye);
    add(key, "target", camera->target);
    add(key, "up", camera->up);
    key.add("fov", camera->verticalFov);
    key.add("width", camera->width).add("height", camera->height);
  } else {
    key.add("samples", std::get<AtlasSpec>(view.kind).samplesPerSide);
  }
  return key.key();
}

void add(KeyBuilder& key, const BakeSettings& settings) {
  key.add("azimuths", settings.azimuths).add("radius", settings.radiusTexels);
}

}  // namespace

ContentKey shadersKey(const fs::path& shaders) {
  KeyBuilder key("shaders");
  for (const fs::path& file : shadersIn(shaders / "common")) {
    key.add("file", file.filename().string()).add("text", readFile(file));
  }
  return key.key();
}

ContentKey cageKey(const Cage& cage) {
  KeyBuilder key("cage");
  key.add("positions", numbersOf(cage.positions));
  key.add("faceVertices", cage.faceVertices);
  key.add("uvs", numbersOf(cage.uvs));
  key.add("faceUvs", cage.faceUvs);
  for (const Crease& crease : cage.creases) {
    key.add("crease", std::vector<int>(crease.vertices.begin(), crease.vertices.end()));
    key.add("sharpness", crease.sharpness);
  }
  for (const SharpVertex& sharp : cage.sharpVertices) {
    key.add("sharpVertex", sharp.vertex).add("sharpness", sharp.sharpness);
  }
  key.add("border", cage.border).add("scheme", cage.scheme);
  if (cage.grid) key.add("columns", cage.grid->columns).add("rows", cage.grid->rows);
  return key.key();
}

ContentKey reliefKey(const Relief& relief) {
  KeyBuilder key("relief");
  key.add("heights", fieldKey(relief.field)).add("space", relief.space);
  return key.add("repeats", std::vector<double>{relief.repeats.x, relief.repeats.y}).key();
}

ContentKey programKey() {
  KeyBuilder key("program");
  key.add("executable", keyOfBytes(readFile(ownFile())));
  key.add("embree", MicroScene::embreeVersion()).add("openSubdiv", openSubdivVersion());
  return key.add("cpu", processorName()).key();
}

ContentKey bakeKey(const HeightField& field, const BakeSettings& settings) {
  KeyBuilder key("bake");
  key.add("field", fieldKey(field));
  add(key, settings);
  return key.key();
}

RunKeys::RunKeys(const StudySpec& study, const GlContext& gl, const fs::path& shaders)
    : study_(study), shaders_(shadersKey(shaders)) {
  KeyBuilder key("place");
  const GlDriver driver = gl.driver();
  key.add("renderer", driver.renderer).add("gl", driver.version).add("cage", cageKey(study.cage));
  place_ = key.add("relief", reliefKey(study.relief)).key();
}

ContentKey RunKeys::mesh(const MeshChoice& choice) const {
  KeyBuilder key("mesh");
  key.add("place", place_).add("kind", choice.kind);
  return key.add("subdivisions", choice.subdivisions).add("curvature", choice.curvature).key();
}

ContentKey RunKeys::light(std::size_t index) const {
  KeyBuilder key("light");
  add(key, "direction", study_.lights[index].direction());
  return key.key();
}

ContentKey RunKeys::samples(const MeshChoice& choice, std::size_t view) const {
  KeyBuilder key("samples");
  key.add("mesh", mesh(choice)).add("shaders", shaders_);
  return key.add("view", viewKey(study_.views[view])).key();
}

ContentKey RunKeys::surface() const {
  KeyBuilder key("surface");
  key.add("place", place_).add("leastTriangles", study_.truth.leastTriangles);
  if (study_.truth.stepTexels) key.add("step", *study_.truth.stepTexels);
  if (study_.truthUncertainty) {
    key.add("uncertainty", *study_.truthUncertainty);
    const MeshChoice standard{DrawnMesh::base, study_.baseSubdivisions, study_.baseCurvature};
    for (std::size_t v = 0; v < study_.views.size(); ++v) key.add("view", samples(standard, v));
    for (std::size_t l = 0; l < study_.lights.size(); ++l) key.add("light", light(l));
  }
  return key.key();
}

ContentKey RunKeys::truth(const MeshChoice& choice, std::size_t view, std::size_t index) const {
  KeyBuilder key("truth");
  key.add("samples", samples(choice, view)).add("light", light(index));
  key.add("surface", surface());
  return key.add("radius", study_.bake.settings.radiusTexels).key();
}

ContentKey RunKeys::bins(const MeshChoice& choice, std::size_t view, std::size_t index) const {
  return KeyBuilder("bins").add("samples", samples(choice, view)).add("light", light(index)).key();
}

ContentKey RunKeys::layers(const MeshChoice& choice, std::size_t view, std::size_t index) const {
  return KeyBuilder("layers")
      .add("samples", samples(choice, view))
      .add("light", light(index))
      .key();
}

ContentKey RunKeys::displacedPicture(std::size_t view, std::size_t index) const {
  KeyBuilder key("displaced picture");
  key.add("surface", surface()).add("light", light(index));
  return key.add("view", viewKey(study_.views[view])).key();
}

ContentKey RunKeys::ellipses(const BakeSpec& bake, double texelsPerHeight) const {
  return KeyBuilder("ellipses")
      .add("bake", bakeKey(study_.relief.field, bake.settings))
      .add("texelsPerHeight", texelsPerHeight)
      .key();
}

ContentKey RunKeys::surfaceAngles(const MeshChoice& choice, const BakeSpec& bake) const {
  KeyBuilder key("surface angles");
  key.add("surface", surface()).add("mesh", mesh(choice)).add("shaders", shaders_);
  return key.add("azimuths", bake.settings.azimuths).add("limit", bake.angleLimit).key();
}

ContentKey RunKeys::method(const MethodSpec& spec, const Method& method) const {
  const MethodTables& tables = method.tables;
  KeyBuilder key("method");
  key.add("source", method.source.text).add("shaders", shaders_).add("filter", spec.filter);
  key.add("mesh", mesh(meshOf(spec, method)));
  for (const auto& [name, value] : spec.parameters) {
    key.add("parameter", name).add("value", value);
  }
  const bool reads =
      tables.horizon || tables.distance || tables.angles || tables.surfaceAngles || tables.ellipse;
  if (tables.height) key.add("searchRadius", spec.bake.settings.radiusTexels);
  if (reads) {
    add(key, spec.bake.settings);
    key.add("bits", spec.bake.bits).add("limit", spec.bake.angleLimit);
  }
  if (tables.surfaceAngles) {
    key.add("angles", surfaceAngles(meshOf(spec, method), spec.bake));
  }
  return key.key();
}

ContentKey RunKeys::mask(const ContentKey& method, const MeshChoice& choice, std::size_t view,
                         std::size_t index) const {
  KeyBuilder key("mask");
  key.add("method", method).add("samples", samples(choice, view));
  return key.add("light", light(index)).key();
}

MeshChoice meshOf(const MethodSpec& spec, const Method& method) {
  return {method.mesh, spec.baseSubdivisions, spec.baseCurvature};
}

}  // namespace gnomon
