#include "viewer/window/status_file.h"

#include <nlohmann/json.hpp>

#include "common/files/atomic_file.h"
#include "report/json/json_values.h"

namespace gnomon::app {
namespace {

using nlohmann::json;

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

json workOf(const WorkStatus& work) {
  return {{"busy", work.busy}, {"stage", work.stage}, {"share", work.share}};
}

json screen(const ViewSession& session) {
  const ViewState& state = session.state();
  json panes = json::array();
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.paneCount); ++i) {
    panes.push_back(paneOf(session, i));
  }
  const Vec3& eye = state.camera.eye;
  return {{"complete", session.isComplete()},
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
          {"errors", session.errors()}};
}

}  // namespace

std::string screenJson(const ViewSession& session) {
  return report::jsonText(screen(session));
}

void StatusFile::write(const ViewSession& session, const ControlPlaces& places,
                       const PanelFacts& facts, const Notice& notice) {
  if (!path_) return;
  json status = screen(session);
  status["study"] = session.request().study.string();
  status["controls"] = places;
  status["notice"] = {{"text", notice.text}, {"is_error", notice.isError}};
  status["opening"] = facts.opening;
  status["can_undo"] = facts.canUndo;
  status["can_redo"] = facts.canRedo;
  status["playing"] = facts.path.isPlaying;
  status["recording"] = facts.path.isRecording;
  status["baking"] = workOf(session.baking());
  status["tracing"] = workOf(session.tracing());
  const std::string now = report::jsonText(status);
  if (now == last_) return;
  last_ = now;
  status["frames"] = {{"mean_ms", facts.frames.meanMilliseconds()},
                      {"longest_ms", facts.frames.longestMilliseconds()}};
  writeTextAtomically(*path_, report::jsonText(status));
}

}  // namespace gnomon::app
