#include "viewer/window/light_controls.h"

#include <imgui.h>

#include <algorithm>

namespace gnomon::app {

void drawCameraControls(ViewSession& session, ControlWidgets& widgets) {
  Camera& camera = session.state().camera;
  std::vector<std::string> names;
  std::vector<Camera> cameras;
  std::optional<std::size_t> chosen;
  for (const study::ViewSpec& view : session.opened().views) {
    const Camera* own = study::cameraOf(view);
    if (own == nullptr) continue;
    cameras.push_back(*own);
    // In the panes' size.
    cameras.back().width = camera.width;
    cameras.back().height = camera.height;
    if (sameCamera(cameras.back(), camera)) chosen = names.size();
    names.push_back(view.name);
  }
  if (names.size() < 2) return;
  const auto pressed = widgets.list("camera", "view", names, chosen, "The cameras of the study");
  if (pressed) camera = cameras.at(*pressed);
}

void drawLightControls(ViewSession& session, ControlWidgets& widgets) {
  LightAngles& light = session.state().light;
  const std::vector<study::LightSpec>& lights = session.opened().lights;
  widgets.heading("Light, degrees");
  if (lights.size() > 1) {
    std::vector<std::string> names;
    std::optional<std::size_t> chosen;
    for (const study::LightSpec& one : lights) {
      if (lightAngles(one) == light) chosen = names.size();
      names.push_back(one.name);
    }
    const auto pressed = widgets.list("light", "light", names, chosen, "The lights of the study");
    if (pressed) light = lightAngles(lights.at(*pressed));
  }
  widgets.slider("azimuth", "light.azimuth", light.azimuth, 0, 360, "%.1f",
                 "From where the light comes: 0 along x, 90 along y");
  widgets.slider("elevation", "light.elevation", light.elevation, -10, 90, "%.1f",
                 "How high the light stands: 0 at the ground, 90 straight above");
  widgets.slider(
      "radius", "light.radius", light.radius, 0, study::largestLightRadius, "%.3f",
      "Size of the light as it is seen from the surface: 0 is a point with hard shadows; "
      "more is a disc with soft shadows");
  ImGui::SameLine();
  if (ImGui::SmallButton("sun")) light.radius = study::sunRadius;
  widgets.note("light.sun", "As large as the sun is in the sky: 0.266°");
}

namespace {

void choosePath(LightPath& path, const LightAngles& light, ControlWidgets& widgets) {
  if (widgets.button("start here", "path.start", "The path starts at the light as it is now")) {
    const LightAngles end{path.toAzimuth, path.toElevation, 0};
    path.fromAzimuth = light.azimuth;
    path.fromElevation = light.elevation;
    path = withEnd(path, end);
  }
  ImGui::SameLine();
  if (widgets.button("end here", "path.end",
                     "The path ends at the light as it is now, by the shorter way")) {
    path = withEnd(path, light);
  }
  ImGui::SameLine();
  if (widgets.button("around", "path.around", "Once around, from the light as it is now")) {
    path = turnFrom(light, path.frames);
  }
  widgets.faintText(pathText(path));
  constexpr int mostInSlider = 240;
  widgets.slider("frames", "path.frames", path.frames, 1, std::max(mostInSlider, path.frames),
                 "Pictures along the path: 12 are shown a second");
}

}  // namespace

Actions drawPathControls(ViewSession& session, const PathStatus& status, ControlWidgets& widgets) {
  Actions actions;
  const bool isOpen =
      widgets.section("Light path", "path", "Moves the light, and records what the panes show");
  if (!isOpen) return actions;
  ImGui::BeginDisabled(status.isRecording);
  choosePath(session.state().path, session.state().light, widgets);
  actions.play = widgets.button(status.isPlaying ? "stop" : "play", "path.play",
                                "Moves the light along the path");
  ImGui::EndDisabled();
  ImGui::SameLine();
  actions.record = widgets.button(
      status.isRecording ? "stop recording" : "record", "path.record",
      "Saves the panes at every frame of the path as PNG files, each with every pixel of the truth "
      "traced, and where ffmpeg is installed a film of them, light.webm");
  ImGui::SameLine();
  widgets.faintText(status.note);
  return actions;
}

}  // namespace gnomon::app
