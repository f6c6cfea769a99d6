#include "export/export_json.h"

#include "common/files/input_file.h"
#include "export/truth_files.h"
#include "render/gpu_scene.h"
#include "report/json/json_values.h"

namespace gnomon::exporting {

namespace {

constexpr double degreesPerRadian = 180 / pi;

report::Json conventionsJson() {
  return {
      {"question",
       "For every pixel of a sample map: is the displaced point lit? It is where its facet faces "
       "the light (facet . direction > 0) and a ray from the point toward the light meets no other "
       "part of the displaced surface. ray_lift is how far off the facet the truth's rays start."},
      {"world",
       "Right-handed, in the study's world units. Directions and normals are unit vectors, a "
       "light's direction points toward it. Triangles run counter-clockwise seen from outside."},
      {"pictures",
       "Row 0 is the top. Masks: 255 lit, 0 shadowed, 128 no sample. Regions of interest: 255 "
       "where "
       "the truth has an answer. Sample maps: see channels; samples_npy holds them as (height, "
       "width, channel) in channel_order, samples_layers as layers of X, Y, Z: place (face, s, t), "
       "texel (x, y, weight), base, normal, point, facet."},
      {"drawn",
       "What the camera's own primary rays meet: point and facet of the displaced surface at the "
       "pixel's centre, 0 where there is nothing, and whether that point is lit, of a disc the "
       "share "
       "that it sees. Other points than the samples; no score is made of them. Their uncertainty "
       "is that of these points: the pixels that change at half the truth's resolution."},
      {"matrices",
       "Row by row, for column vectors: clip = projection view (x, y, z, 1). The camera looks "
       "along "
       "-z with +y up; clip depth runs from -1 to 1. The centre of column c, row r lies at clip x "
       "= "
       "2 (c + 0.5) / width - 1, y = 1 - 2 (r + 0.5) / height, both over w."},
      {"atlas",
       "Faces are square tiles, in columns from the left and rows from the bottom: face f is in "
       "column f mod columns, row f div columns; s runs to the right, t upward. weight is the "
       "world "
       "area that a sample stands for."},
      {"height_map",
       "h(x, y), in texels, is the bilinear interpolant of the texels of heights.exr, whose "
       "centres "
       "lie at + 0.5, y upward: the picture's first row is the largest v. (x, y) = uv "
       "texels_per_uv; "
       "outside the map by wrap. The displaced point is D = P + a h n, n the limit surface's "
       "normal, of polygons (scheme none) the direction that all corners at a place share; "
       "a = 1 for height_space world, a = |P_x x P_y|^(1/2) for texture, with P_x, P_y the world "
       "length per texel."},
      {"tables",
       "Channel horizon.M: the largest slope (h(p + r e) - h(p)) / r over 0 < r <= radius_texels "
       "toward azimuth 2 pi M / azimuths in the texture's plane; distance.M: the smallest r that "
       "attains it, 0 for the limit r -> 0. 8 and 16 bits are codes: value = low + code (high - "
       "low) "
       "/ (2^bits - 1)."}};
}

report::Json channelsJson() {
  return {{"face, s, t", "the sample: face of the cage and parameters on it; face -1 is no sample"},
          {"texel.X, .Y", "texture coordinates in texels"},
          {"base.X, .Y, .Z", "P, the point of the undisplaced surface"},
          {"normal.X, .Y, .Z", "n, the normal there; of polygons that of shading"},
          {"point.X, .Y, .Z", "the displaced point, where the truth's shadow ray starts"},
          {"facet.X, .Y, .Z", "normal of the truth's facet that holds it"},
          {"weight", "of the sample in an atlas; 1 in a camera's view"}};
}

report::Json vectorJson(const Vec3& v) {
  return {v.x, v.y, v.z};
}

report::Json matrixJson(const glm::dmat4& matrix) {
  report::Json rows = report::Json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back({matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]});
  }
  return rows;
}

report::Json cameraJson(const Camera& camera, const surface::BaseMesh& mesh) {
  const render::CameraMatrices matrices = render::cameraMatrices(camera, mesh);
  return {{"eye", vectorJson(camera.eye)},
          {"target", vectorJson(camera.target)},
          {"up", vectorJson(camera.up)},
          {"vertical_fov_degrees", degreesPerRadian * camera.verticalFov},
          {"view", matrixJson(matrices.view)},
          {"projection", matrixJson(matrices.projection)}};
}

/// Of a view without a camera: a tile a face, as far as it has tiles.
report::Json tilesJson(const render::RenderView& view) {
  return {{"samples_per_side", view.width / std::max(1, view.atlasTiles.x)},
          {"columns", view.atlasTiles.x},
          {"rows", view.atlasTiles.y}};
}

void addMap(report::Json& json, const std::string& file) {
  json["samples"] = file;
  json["samples_npy"] = npyName(file);
  json["samples_layers"] = layersName(file);
}

/// One light of the masks of a view.
report::Json maskJson(const Light& light, const std::string& maskFile, const std::string& shareFile,
                      double uncertainty) {
  report::Json json = {{"light", light.name},
                       {"truth", maskFile},
                       {"uncertainty", report::jsonNumber(uncertainty, "views.masks.uncertainty")}};
  if (light.isSoft()) json["shares"] = shareFile;
  return json;
}

report::Json drawnJson(const study::RunScene& scene, const std::vector<double>& uncertainties,
                       const study::CaseNames& names, std::size_t view) {
  report::Json json = report::Json::object();
  addMap(json, drawnMapFile(names, view));
  report::Json masks = report::Json::array();
  for (std::size_t l = 0; l < scene.study.lights.size(); ++l) {
    masks.push_back(maskJson(scene.study.lights[l], drawnMaskFile(names, view, l),
                             drawnShareFile(names, view, l), uncertainties.at(l)));
  }
  json["masks"] = std::move(masks);
  return json;
}

report::Json viewJson(study::RunScene& scene, const study::StudyRecord& record,
                      const std::vector<double>& drawnUncertainties, const study::CaseNames& names,
                      std::size_t index) {
  const study::BaseCase& base = scene.standardBase();
  const study::ViewSpec& spec = scene.study.views[index];
  const render::RenderView& view = base.views[index].view;
  report::Json json = {{"name", spec.name}, {"width", view.width}, {"height", view.height}};
  const std::string type(study::viewKindNames.at(spec.kind.index()));
  json["type"] = type;
  const Camera* camera = cameraOf(spec);
  json[type] = camera ? cameraJson(*camera, base.drawn.get()->mesh) : tilesJson(view);
  addMap(json, sampleMapFile(names, index));
  json["roi"] = roiFile(names, index);
  report::Json masks = report::Json::array();
  const std::size_t lights = scene.study.lights.size();
  for (std::size_t l = 0; l < lights; ++l) {
    masks.push_back(maskJson(scene.study.lights[l], truthMaskFile(names, index, l),
                             truthShareFile(names, index, l),
                             record.truth.flips.at(index * lights + l).flipRate));
  }
  json["masks"] = std::move(masks);
  json["drawn"] = camera ? drawnJson(scene, drawnUncertainties, names, index) : report::Json();
  return json;
}

report::Json lightJson(const Light& light) {
  report::Json json = {{"name", light.name},
                       {"azimuth_degrees", light.angles.azimuth},
                       {"elevation_degrees", light.angles.elevation},
                       {"direction", vectorJson(light.direction)}};
  if (light.isSoft()) json["radius_degrees"] = light.angles.radius;
  return json;
}

report::Json heightsJson(const relief::Relief& relief) {
  const relief::HeightField& field = relief.field;
  const Vec2 texelsPerUv = relief.texelsPerUv();
  return {{"file", "heights.exr"},
          {"channel", "height"},
          {"width", field.width()},
          {"height", field.height()},
          {"minimum", field.minimum()},
          {"maximum", field.maximum()},
          {"height_space", relief.space == relief::HeightSpace::world ? "world" : "texture"},
          {"wrap", field.wrap() == relief::Wrap::repeat ? "repeat" : "clamp"},
          {"repeats", {relief.repeats.x, relief.repeats.y}},
          {"texels_per_uv", {texelsPerUv.x, texelsPerUv.y}}};
}

report::Json rangeJson(const horizon::StoredTable& table) {
  return {{"low", table.low}, {"high", table.high}};
}

report::Json tablesJson(const horizon::StoredHorizons& tables) {
  return {{"file", "tables.exr"},
          {"azimuths", tables.layers},
          {"radius_texels", tables.radiusTexels},
          {"bits", static_cast<int>(tables.horizon.bits)},
          {"horizon", rangeJson(tables.horizon)},
          {"distance", rangeJson(tables.distance)}};
}

report::Json displacedJson(const ExportedMesh& mesh) {
  return {
      {"file", "displaced.ply"},
      {"subdivisions", mesh.subdivisions},
      {"vertices", mesh.vertices},
      {"triangles", mesh.triangles},
      {"closed", mesh.closed},
      {"distance",
       {{"samples", mesh.distance.samples},
        {"largest", report::jsonNumber(mesh.distance.largest, "distance.largest")},
        {"mean", report::jsonNumber(mesh.distance.mean, "distance.mean")},
        {"largest_texels",
         report::jsonNumber(mesh.distance.largestTexels, "distance.largest_texels")},
        {"mean_texels", report::jsonNumber(mesh.distance.meanTexels, "distance.mean_texels")}}}};
}

}  // namespace

std::string exportJson(study::RunScene& scene, const study::StudyRecord& record,
                       const ExportedMesh& mesh, const horizon::StoredHorizons& tables,
                       double rayLift, const std::vector<std::vector<double>>& drawnUncertainties) {
  const study::CaseNames names = study::caseNames(scene.study);
  report::Json views = report::Json::array();
  for (std::size_t v = 0; v < scene.study.views.size(); ++v) {
    views.push_back(viewJson(scene, record, drawnUncertainties.at(v), names, v));
  }
  const surface::BaseMesh& base = scene.standardBase().drawn.get()->mesh;
  const report::Json json = {{"schema", "gnomon-export/1"},
                             {"study", report::jsonStudy(record)},
                             {"environment", report::jsonEnvironment(record.environment)},
                             {"conventions", conventionsJson()},
                             {"displaced_mesh", displacedJson(mesh)},
                             {"base_mesh",
                              {{"file", "base.obj"},
                               {"subdivisions", scene.study.base.subdivisions},
                               {"vertices", base.vertices.size()},
                               {"triangles", base.triangleCount()}}},
                             {"height_map", heightsJson(scene.study.relief)},
                             {"tables", tablesJson(tables)},
                             {"lights", report::jsonList(scene.study.lights, lightJson)},
                             {"views", std::move(views)},
                             {"channels", channelsJson()},
                             {"channel_order", sampleChannels()},
                             {"ray_lift", report::jsonNumber(rayLift, "ray_lift")},
                             {"truth", report::jsonTruth(record.truth)},
                             {"undefined_samples", record.undefinedSamples}};
  return report::jsonText(json);
}

namespace fs = std::filesystem;

namespace {

/// What the masks of a view, or of its drawn mesh, state of a file.
std::optional<double> uncertaintyIn(const report::JsonReader& view, const fs::path& folder,
                                    const fs::path& file) {
  for (const report::JsonReader& entry : view.list("masks")) {
    const bool isIts = folder / entry.text("truth") == file ||
                       (entry.has("shares") && folder / entry.text("shares") == file);
    if (isIts && entry.has("uncertainty")) return entry.number("uncertainty");
  }
  return std::nullopt;
}

/// What an export states of a file; the folder is the export's.
std::optional<double> uncertaintyBy(const fs::path& index, const fs::path& file) {
  if (!isThere(index)) return std::nullopt;
  const report::Json json = report::readJson(index);
  const report::JsonReader root(json, index.string(), "");
  const fs::path folder = index.parent_path();
  for (const report::JsonReader& view : root.list("views")) {
    if (const auto found = uncertaintyIn(view, folder, file)) return found;
    if (view.text("type") != "camera") continue;
    if (const auto found = uncertaintyIn(view.object("drawn"), folder, file)) return found;
  }
  return std::nullopt;
}

}  // namespace

std::array<fs::path, 2> exportIndices(const fs::path& truthMask) {
  const fs::path folder = fs::absolute(truthMask).lexically_normal().parent_path().parent_path();
  return {folder / "export.json", folder.parent_path() / "export.json"};
}

std::optional<double> exportedUncertainty(const fs::path& truthMask) {
  const fs::path file = fs::absolute(truthMask).lexically_normal();
  for (const fs::path& index : exportIndices(truthMask)) {
    if (const auto found = uncertaintyBy(index, file)) return found;
  }
  return std::nullopt;
}

}  // namespace gnomon::exporting
