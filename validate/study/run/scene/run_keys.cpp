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

ContentKey fieldKey(const HeightField& field) {
  KeyBuilder key("heights");
  key.add("width", field.width()).add("height", field.height()).add("wrap", field.wrap());
  key.add("borderX", field.border().x).add("borderY", field.border().y);
  return key.add("texels", field.texels()).key();
}

ContentKey viewKey(const ViewSpec& view) {
  KeyBuilder key("view");
  key.add("kind", view.kind.index());
  addSettings(key, view.kind, Enters::everything);
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

}  // namespace

ContentKey shadersKey(const fs::path& shaders) {
  KeyBuilder key("shaders");
  for (const fs::path& file : shadersIn(shaders / "common")) {
    key.add("file", file.filename().string()).add("text", readFile(file));
  }
  return key.key();
}

ContentKey surfaceKey(const StudySpec& study) {
  KeyBuilder key("surface section");
  addSettings(key, study.surfaceSection, Enters::everything);
  return key.add("cage", cageKey(study.cage)).key();
}

ContentKey reliefKey(const StudySpec& study) {
  const Relief& relief = study.relief;
  KeyBuilder key("relief");
  ReliefSection section = study.reliefSection;
  addKeys(key, allKeysOf(section), Enters::everything);
  key.add("heights", fieldKey(relief.field)).add("space", relief.space);
  return key.add("repeats", std::vector<double>{relief.repeats.x, relief.repeats.y}).key();
}

ContentKey programKey() {
  KeyBuilder key("program");
  key.add("executable", keyOfBytes(readFile(ownFile())));
  return key.add("embree", MicroScene::embreeVersion())
      .add("openSubdiv", openSubdivVersion())
      .key();
}

ContentKey processorKey() {
  return KeyBuilder("processor")
      .add("name", processorName())
      .add("features", processorFeatures())
      .key();
}

ContentKey settingsKey(const BakeSpec& bake, Enters result) {
  KeyBuilder key("bake settings");
  addSettings(key, bake, result, 1);
  return key.key();
}

ContentKey bakeKey(const HeightField& field, const BakeSpec& bake) {
  KeyBuilder key("bake");
  key.add("field", fieldKey(field));
  return key.add("settings", settingsKey(bake, Enters::horizons)).key();
}

RunKeys::RunKeys(const StudySpec& study, const GlContext& gl, const fs::path& shaders)
    : study_(study), shaders_(shadersKey(shaders)) {
  KeyBuilder key("place");
  const GlDriver driver = gl.driver();
  key.add("renderer", driver.renderer).add("gl", driver.version);
  addSettings(key, StudyHeader(study), Enters::scene);
  place_ = key.add("surface", surfaceKey(study)).add("relief", reliefKey(study)).key();
}

ContentKey RunKeys::mesh(const MeshChoice& choice) const {
  KeyBuilder key("mesh");
  key.add("place", place_).add("kind", choice.kind);
  addSettings(key, choice.base, Enters::scene);
  return key.key();
}

ContentKey RunKeys::light(std::size_t index) const {
  KeyBuilder key("light");
  addSettings(key, sectionOf(study_.lights[index]), Enters::everything);
  return key.key();
}

ContentKey RunKeys::samples(const MeshChoice& choice, std::size_t view) const {
  KeyBuilder key("samples");
  key.add("mesh", mesh(choice)).add("shaders", shaders_);
  return key.add("view", viewKey(study_.views[view])).key();
}

ContentKey RunKeys::surface() const {
  KeyBuilder key("surface");
  key.add("place", place_);
  addSettings(key, study_.truth, Enters::scene, 1);
  if (study_.truth.uncertainty) {
    const MeshChoice standard{DrawnMesh::base, study_.base};
    for (std::size_t v = 0; v < study_.views.size(); ++v) key.add("view", samples(standard, v));
    for (std::size_t l = 0; l < study_.lights.size(); ++l) key.add("light", light(l));
  }
  return key.key();
}

ContentKey RunKeys::truth(const MeshChoice& choice, std::size_t view, std::size_t index) const {
  KeyBuilder key("truth");
  key.add("samples", samples(choice, view)).add("light", light(index));
  return key.add("surface", surface()).add("bake", settingsKey(study_.bake, Enters::search)).key();
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

ContentKey RunKeys::seenSurface(std::size_t view) const {
  KeyBuilder key("seen surface");
  return key.add("surface", surface()).add("view", viewKey(study_.views[view])).key();
}

ContentKey RunKeys::ellipses(const BakeSpec& bake, double texelsPerHeight) const {
  return KeyBuilder("ellipses")
      .add("bake", bakeKey(study_.relief.field, bake))
      .add("texelsPerHeight", texelsPerHeight)
      .key();
}

ContentKey RunKeys::surfaceAngles(const MeshChoice& choice, const BakeSpec& bake) const {
  KeyBuilder key("surface angles");
  key.add("surface", surface()).add("mesh", mesh(choice)).add("shaders", shaders_);
  return key.add("bake", settingsKey(bake, Enters::shotAngles)).key();
}

ContentKey RunKeys::method(const MethodSpec& spec, const Method& method) const {
  const MethodTables& tables = method.tables;
  KeyBuilder key("method");
  key.add("source", method.source.text).add("shaders", shaders_);
  addSettings(key, spec, Enters::answers);
  key.add("mesh", mesh(meshOf(spec, method)));
  for (const auto& [name, value] : spec.parameters) {
    key.add("parameter", name).add("value", value);
  }
  using enum Enters;
  const bool reads =
      tables.horizon || tables.distance || tables.angles || tables.surfaceAngles || tables.ellipse;
  const Enters read = reads           ? horizons | codes | flatAngles | shotAngles | search
                      : tables.height ? search
                                      : nothing;
  key.add("bake", settingsKey(spec.bake, answers | read));
  if (tables.surfaceAngles) {
    key.add("angles", surfaceAngles(meshOf(spec, method), spec.bake));
  }
  return key.key();
}

ContentKey RunKeys::program(const MethodSpec& spec, const Method& method) const {
  KeyBuilder key("program of a method");
  key.add("file", method.source.file).add("name", method.name);
  key.add("source", method.source.text).add("shaders", shaders_);
  key.add("wrap", study_.relief.field.wrap()).add("filter", spec.filter);
  for (const auto& [name, value] : spec.parameters) {
    key.add("parameter", name).add("value", value);
  }
  return key.key();
}

ContentKey RunKeys::shading(DrawnMesh mesh) const {
  KeyBuilder key("program of pictures");
  key.add("shaders", shaders_).add("wrap", study_.relief.field.wrap());
  return key.add("mesh", mesh).key();
}

ContentKey RunKeys::mask(const ContentKey& method, const MeshChoice& choice, std::size_t view,
                         std::size_t index) const {
  KeyBuilder key("mask");
  key.add("method", method).add("samples", samples(choice, view));
  return key.add("light", light(index)).key();
}

MeshChoice meshOf(const MethodSpec& spec, const Method& method) {
  return {method.mesh, spec.base};
}

}  // namespace gnomon
