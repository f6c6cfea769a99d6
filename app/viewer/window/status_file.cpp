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

json paneOf(const ViewSession& session, std::size_t index) {
  const PanePicture& picture = session.pane(index);
  json pane = {{"shows", contentText(session.state().panes.at(index))},
               {"note", picture.note},
               {"traced_share", session.tracedShare(index)}};
  if (const auto& figures = picture.figures) {
    pane["error_rate"] = valueOf(figures->errorRate);
    pane["false_shadow"] = valueOf(figures->falseShadow);
    pane["false_light"] = valueOf(figures->falseLight);
    pane["iou"] = valueOf(figures->iou);
  }
  return pane;
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
                       const FrameLog& frames, const std::string& said) {
  if (!path_) return;
  json status = screen(session);
  status["controls"] = places;
  status["said"] = said;
  status["baking"] = workOf(session.baking());
  status["tracing"] = workOf(session.tracing());
  const std::string now = report::jsonText(status);
  if (now == last_) return;
  last_ = now;
  status["frames"] = {{"mean_ms", frames.meanMilliseconds()},
                      {"longest_ms", frames.longestMilliseconds()}};
  writeTextAtomically(*path_, report::jsonText(status));
}

}  // namespace gnomon::app
