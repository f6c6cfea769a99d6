#include "viewer/window/saved_view.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "common/lists.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "model/saved_study.h"
#include "report/json/json_values.h"
#include "study/spec/sections/study_files.h"

namespace gnomon::app {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr int mostViews = 100000;

/// The first number that no file of the folder bears.
fs::path freePath(const ViewSession& session, const std::string& stem, const std::string& ending) {
  const fs::path folder = session.request().out / session.opened().name / "view";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(fmt::format("{}: {}", folder.string(), error.message()));
  for (int number = 1; number < mostViews; ++number) {
    fs::path path = folder / fmt::format("{}-{}{}", stem, number, ending);
    if (!isThere(path)) return path;
  }
  throw InputError(fmt::format("{}: no free name for another view", folder.string()));
}

json valueOf(const compare::Metric& metric) {
  return metric.value ? json(*metric.value) : json(nullptr);
}

json figuresOf(const PaneFigures& figures) {
  return {{"error_rate", valueOf(figures.errorRate)},
          {"false_shadow", valueOf(figures.falseShadow)},
          {"false_light", valueOf(figures.falseLight)},
          {"iou", valueOf(figures.iou)}};
}

json paneOf(const ViewSession& session, std::size_t index) {
  const PanePicture& picture = session.pane(index);
  json pane = {{"shows", contentText(session.state().panes.at(index))},
               {"note", picture.note},
               {"traced_share", session.tracedShare(index)}};
  if (const auto& figures = picture.figures) pane.update(figuresOf(*figures));
  if (const auto& figures = picture.partFigures) {
    pane["rectangle"] = figuresOf(*figures);
    pane["rectangle"]["samples"] = figures->samples;
    pane["rectangle"]["wrong"] = figures->wrong;
    pane["rectangle"]["traced_share"] = figures->tracedShare;
  }
  return pane;
}

json rectangleOf(const std::optional<ViewPart>& part) {
  return part ? json{part->left, part->top, part->right, part->bottom} : json(nullptr);
}

}  // namespace

std::string screenJson(const ViewSession& session) {
  const ViewState& state = session.state();
  json panes = json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.paneCount); ++i) {
    panes.push_back(paneOf(session, i));
  }
  const Vec3& eye = state.camera.eye;
  return report::jsonText({{"complete", session.isComplete()},
                           {"panes", panes},
                           {"wipe", state.wipe},
                           {"rectangle", rectangleOf(state.part)},
                           {"light",
                            {{"azimuth", state.light.azimuth},
                             {"elevation", state.light.elevation},
                             {"radius", state.light.radius}}},
                           {"camera",
                            {{"eye", {eye.x, eye.y, eye.z}},
                             {"width", state.camera.width},
                             {"height", state.camera.height}}},
                           {"overlays",
                            {{"curvature", state.overlays.curvature},
                             {"directions", state.overlays.directions},
                             {"section", state.overlays.section},
                             {"pixel", state.overlays.pixel}}},
                           {"panel", state.panel},
                           {"help", state.help},
                           {"errors", session.errors()}});
}

std::string saveStudyView(const ViewSession& session) {
  const fs::path path = freePath(session, "view", ".toml");
  StudyState state;
  state.file = session.request().study;
  state.options = session.shownOptions();
  state.methods = shownMethods(session.state());
  if (state.methods.empty()) state.methods = {session.labels().front()};
  state.camera = session.state().camera;
  state.light = session.state().light;
  saveStudy(state, path);
  fs::path figures = path;
  figures.replace_extension(".json");
  writeTextAtomically(figures, screenJson(session));
  return fmt::format("saved {}", path.string());
}

std::string savePicture(const ViewSession& session, const image::Image& picture) {
  const fs::path path = freePath(session, "view", ".png");
  image::writePng(path, picture);
  return fmt::format("saved {}", path.string());
}

std::string saveMasks(ViewSession& session) {
  std::string said;
  for (std::size_t i = 0; i < static_cast<std::size_t>(session.state().paneCount); ++i) {
    const Answers* answers = session.answersOf(session.state().panes.at(i));
    if (answers == nullptr) continue;
    const std::string shown = sourceText(session.state().panes.at(i).shown);
    const fs::path path =
        freePath(session, "view", fmt::format("_{}.png", study::fileNames({shown}).front()));
    writeTextAtomically(
        path,
        std::visit(Overloaded{[](const Mask& mask) { return image::pngOf(image::maskImage(mask)); },
                              [](const Visibility& map) { return image::sharePng(map); }},
                   *answers));
    said += fmt::format("{}saved {}", said.empty() ? "" : "\n", path.string());
  }
  return said.empty() ? "no pane shows a mask" : said;
}

}  // namespace gnomon::app
