#include "study/run/scene/run_keys.h"

#include <vector>

#include "common/files/atomic_file.h"
#include "common/system/own_files.h"
#include "render/shader_files.h"
#include "study/run/scene/environment.h"
#include "surface/limit_surface.h"
#include "truth/micro_scene.h"

namespace gnomon::study {

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

cache::ContentKey fieldKey(const relief::HeightField& field) {
  cache::KeyBuilder key("heights");
  key.add("width", field.width()).add("height", field.height()).add("wrap", field.wrap());
  key.add("borderX", field.border().x).add("borderY", field.border().y);
  return key.add("texels", field.texels()).key();
}

cache::ContentKey viewKey(const ViewSpec& view) {
  cache::KeyBuilder key("view");
  key.add("kind", view.kind.index());
  addSettings(key, view.kind, Enters::everything);
  return key.key();
}

cache::ContentKey cageKey(const surface::Cage& cage) {
  cache::KeyBuilder key("cage");
  key.add("positions", numbersOf(cage.positions));
  key.add("faceVertices", cage.faceVertices);
  key.add("uvs", numbersOf(cage.uvs));
  key.add("faceUvs", cage.faceUvs);
  for (const surface::Crease& crease : cage.creases) {
    key.add("crease", std::vector<int>(crease.vertices.begin(), crease.vertices.end()));
    key.add("sharpness", crease.sharpness);
  }
  for (const surface::SharpVertex& sharp : cage.sharpVertices) {
    key.add("sharpVertex", sharp.vertex).add("sharpness", sharp.sharpness);
  }
  key.add("border", cage.border).add("scheme", cage.scheme);
  for (const std::string& name : cage.partNames) key.add("part", name);
  if (!cage.faceParts.empty()) key.add("faceParts", cage.faceParts);
  if (!cage.directions.empty()) {
    key.add("directions", numbersOf(cage.directions)).add("normals", numbersOf(cage.normals));
    key.add("faceNormals", cage.faceNormals);
  }
  if (cage.grid) key.add("columns", cage.grid->columns).add("rows", cage.grid->rows);
  return key.key();
}

/// The settings of a bake that what a method declares depends on.
Enters tablesReadBy(const render::MethodTables& tables) {
  using enum Enters;
  const bool reads =
      tables.horizon || tables.distance || tables.angles || tables.surfaceAngles || tables.ellipse;
  return reads           ? horizons | codes | flatAngles | shotAngles | search
         : tables.height ? search
                         : nothing;
}

}  // namespace

cache::ContentKey shadersKey(const fs::path& shaders) {
  cache::KeyBuilder key("shaders");
  for (const fs::path& file : render::shadersIn(shaders / "common")) {
    key.add("file", file.filename().string()).add("text", readFile(file));
  }
  return key.key();
}

cache::ContentKey methodFilesKey(const render::Method& method) {
  cache::KeyBuilder key("files of a method");
  key.add("source", method.source.text);
  for (const render::ShaderPiece& include : method.includes) key.add("include", include.text);
  for (const render::MethodTexture& texture : method.textures) {
    key.add("texture", texture.name).add("bytes", cache::keyOfBytes(readFile(texture.file)));
  }
  return key.key();
}

cache::ContentKey surfaceKey(const StudySpec& study) {
  cache::KeyBuilder key("surface section");
  addSettings(key, study.surfaceSection, Enters::everything);
  return key.add("cage", cageKey(study.cage)).key();
}

cache::ContentKey reliefKey(const StudySpec& study) {
  const relief::Relief& relief = study.relief;
  cache::KeyBuilder key("relief");
  ReliefSection section = study.reliefSection;
  addKeys(key, allKeysOf(section), Enters::everything);
  key.add("heights", fieldKey(relief.field)).add("space", relief.space);
  return key.add("repeats", std::vector<double>{relief.repeats.x, relief.repeats.y}).key();
}

cache::ContentKey programKey() {
  cache::KeyBuilder key("program");
  key.add("executable", cache::keyOfBytes(readFile(ownFile())));
  return key.add("embree", truth::MicroScene::embreeVersion())
      .add("openSubdiv", surface::openSubdivVersion())
      .key();
}

cache::ContentKey processorKey() {
  return cache::KeyBuilder("processor")
      .add("name", processorName())
      .add("features", processorFeatures())
      .key();
}

cache::ContentKey settingsKey(const BakeSpec& bake, Enters result) {
  cache::KeyBuilder key("bake settings");
  addSettings(key, bake, result, 1);
  return key.key();
}

cache::ContentKey bakeKey(const relief::HeightField& field, const BakeSpec& bake) {
  cache::KeyBuilder key("bake");
  key.add("field", fieldKey(field));
  return key.add("settings", settingsKey(bake, Enters::horizons)).key();
}

RunKeys::RunKeys(const StudySpec& study, const render::GlContext& gl, const fs::path& shaders)
    : study_(study), shaders_(shadersKey(shaders)) {
  cache::KeyBuilder drawnBy("driver");
  cache::KeyBuilder key("place");
  const render::GlDriver driver = gl.driver();
  driver_ = drawnBy.add("renderer", driver.renderer).add("gl", driver.version).key();
  key.add("driver", driver_);
  addSettings(key, static_cast<const StudyHeader&>(study), Enters::scene);
  place_ = key.add("surface", surfaceKey(study)).add("relief", reliefKey(study)).key();
}

cache::ContentKey RunKeys::mesh(const MeshChoice& choice) const {
  cache::KeyBuilder key("mesh");
  key.add("place", place_).add("kind", choice.kind);
  addSettings(key, choice.base, Enters::scene);
  return key.key();
}

cache::ContentKey RunKeys::light(std::size_t index) const {
  cache::KeyBuilder key("light");
  addSettings(key, sectionOf(study_.lights[index]), Enters::everything);
  return key.key();
}

cache::ContentKey RunKeys::samples(const MeshChoice& choice, std::size_t view) const {
  cache::KeyBuilder key("samples");
  key.add("mesh", mesh(choice)).add("shaders", shaders_);
  return key.add("view", viewKey(study_.views[view])).key();
}

cache::ContentKey RunKeys::surface() const {
  cache::KeyBuilder key("surface");
  key.add("place", place_);
  addSettings(key, study_.truth, Enters::scene, 1);
  return key.key();
}

cache::ContentKey RunKeys::truth(const MeshChoice& choice, std::size_t view,
                                 std::size_t index) const {
  cache::KeyBuilder key("truth");
  key.add("samples", samples(choice, view)).add("light", light(index));
  if (study_.lights[index].isSoft()) addSettings(key, study_.truth, Enters::shares, 1);
  return key.add("surface", surface()).add("bake", settingsKey(study_.bake, Enters::search)).key();
}

cache::ContentKey RunKeys::bins(const MeshChoice& choice, std::size_t view,
                                std::size_t index) const {
  return cache::KeyBuilder("bins")
      .add("samples", samples(choice, view))
      .add("light", light(index))
      .key();
}

cache::ContentKey RunKeys::layers(const MeshChoice& choice, std::size_t view,
                                  std::size_t index) const {
  return cache::KeyBuilder("layers")
      .add("samples", samples(choice, view))
      .add("light", light(index))
      .key();
}

cache::ContentKey RunKeys::dark(const MeshChoice& choice, std::size_t view) const {
  return cache::KeyBuilder("dark").add("samples", samples(choice, view)).key();
}

cache::ContentKey RunKeys::displacedPicture(std::size_t view, std::size_t index) const {
  cache::KeyBuilder key("displaced picture");
  key.add("surface", surface()).add("light", light(index));
  return key.add("view", viewKey(study_.views[view])).key();
}

cache::ContentKey RunKeys::seenSurface(std::size_t view) const {
  cache::KeyBuilder key("seen surface");
  return key.add("surface", surface()).add("view", viewKey(study_.views[view])).key();
}

cache::ContentKey RunKeys::ellipses(const BakeSpec& bake, double texelsPerHeight) const {
  return cache::KeyBuilder("ellipses")
      .add("bake", bakeKey(study_.relief.field, bake))
      .add("texelsPerHeight", texelsPerHeight)
      .key();
}

cache::ContentKey RunKeys::surfaceAngles(const MeshChoice& choice, const BakeSpec& bake) const {
  cache::KeyBuilder key("surface angles");
  key.add("surface", surface()).add("mesh", mesh(choice)).add("shaders", shaders_);
  return key.add("bake", settingsKey(bake, Enters::shotAngles)).key();
}

cache::ContentKey RunKeys::methodBakes(const MethodSpec& spec, const render::Method& method,
                                       const std::map<std::string, double>& parameters,
                                       double texelsPerHeight) const {
  cache::KeyBuilder key("bakes of a method");
  key.add("driver", driver_).add("shaders", shaders_);
  key.add("files", methodFilesKey(method)).add("filter", spec.filter);
  for (const auto& [name, value] : parameters) key.add("parameter", name).add("value", value);
  key.add("heights", fieldKey(study_.relief.field)).add("space", study_.relief.space);
  key.add("texelsPerHeight", texelsPerHeight);
  key.add("bake", settingsKey(spec.bake, tablesReadBy(method.tables)));
  if (method.tables.surfaceAngles) {
    key.add("angles", surfaceAngles(meshOf(spec, method), spec.bake));
  }
  return key.key();
}

cache::ContentKey RunKeys::method(const MethodSpec& spec, const render::Method& method) const {
  cache::KeyBuilder key("method");
  key.add("files", methodFilesKey(method)).add("shaders", shaders_);
  addSettings(key, spec, Enters::answers);
  key.add("mesh", mesh(meshOf(spec, method)));
  if (const auto light = lightMeshOf(spec, method)) key.add("light mesh", mesh(*light));
  for (const auto& [name, value] : spec.parameters) {
    key.add("parameter", name).add("value", value);
  }
  key.add("bake", settingsKey(spec.bake, Enters::answers | tablesReadBy(method.tables)));
  if (method.tables.surfaceAngles) {
    key.add("angles", surfaceAngles(meshOf(spec, method), spec.bake));
  }
  return key.key();
}

cache::ContentKey RunKeys::program(const MethodSpec& spec, const render::Method& method) const {
  cache::KeyBuilder key("program of a method");
  key.add("file", method.source.file).add("name", method.name);
  key.add("files", methodFilesKey(method)).add("shaders", shaders_);
  key.add("wrap", study_.relief.field.wrap()).add("filter", spec.filter);
  if (spec.disc) key.add("disc", spec.disc);
  if (method.isOnPolygons) key.add("polygons", true);
  for (const auto& [name, value] : spec.parameters) {
    key.add("parameter", name).add("value", value);
  }
  return key.key();
}

cache::ContentKey RunKeys::shading(render::DrawnMesh mesh) const {
  cache::KeyBuilder key("program of pictures");
  key.add("shaders", shaders_).add("wrap", study_.relief.field.wrap());
  return key.add("mesh", mesh).key();
}

cache::ContentKey RunKeys::mask(const cache::ContentKey& method, const MeshChoice& choice,
                                std::size_t view, std::size_t index) const {
  cache::KeyBuilder key("mask");
  key.add("method", method).add("samples", samples(choice, view));
  return key.add("light", light(index)).key();
}

MeshChoice meshOf(const MethodSpec& spec, const render::Method& method) {
  return {method.mesh, spec.base};
}

std::optional<MeshChoice> lightMeshOf(const MethodSpec& spec, const render::Method& method) {
  if (!method.lightMesh) return std::nullopt;
  MeshChoice choice{*method.lightMesh, spec.base};
  choice.base.subdivisions = render::lightPieces(method, spec.parameters);
  return choice;
}

}  // namespace gnomon::study
