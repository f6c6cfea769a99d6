#include "viewer/window/controls.h"

#include <fmt/core.h>
#include <imgui.h>

#include "viewer/panes/gui.h"
#include "viewer/window/pane_controls.h"
#include "viewer/window/study_controls.h"

namespace gnomon::app {

/// A list of studies, and a field for the path of another one.
Actions ControlPanel::study(const ViewSession& session, const PanelFacts& facts) {
  Actions actions;
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(session.opened().title.c_str());
  ImGui::PopTextWrapPos();
  if (!facts.opening.empty()) {
    widgets_.faintText(fmt::format("Reading {} …", facts.opening));
    return actions;
  }
  const std::filesystem::path& open = session.request().study;
  ImGui::SetNextItemWidth(-1);
  if (widgets_.openList("##study", "study", open.filename().string(),
                        "The studies of this folder and of the command line")) {
    for (const std::filesystem::path& study : facts.studies) {
      const std::string text = study.string();
      if (widgets_.entry(text, "study." + study.filename().string(), study == open)) {
        actions.open = study;
      }
    }
    ImGui::EndCombo();
  }
  ImGui::SetNextItemWidth(-1);
  if (facts.asksForPath) ImGui::SetKeyboardFocusHere();
  const bool isEntered = widgets_.field("study.path", path_, "path of another study, then Enter",
                                        "Opens any study file in this window");
  if (isEntered && !path_.empty()) actions.open = path_;
  return actions;
}

Actions ControlPanel::steps(const PanelFacts& facts) {
  Actions actions;
  const auto step = [&](const char* label, const char* name, bool isThere, const char* hint) {
    ImGui::BeginDisabled(!isThere);
    const bool isPressed = widgets_.button(label, name, hint);
    ImGui::EndDisabled();
    return isPressed && isThere;
  };
  actions.undo = step("undo", "undo", facts.canUndo,
                      "Takes back the last change of light, camera, panes or sliders");
  ImGui::SameLine();
  actions.redo = step("redo", "redo", facts.canRedo, "Does again what was taken back");
  return actions;
}

Actions ControlPanel::saving() {
  Actions actions;
  ImGui::AlignTextToFramePadding();
  widgets_.faintText("Save");
  ImGui::SameLine();
  actions.saveStudy = widgets_.button(
      "study", "save.study",
      "A study file of what is on the screen: `gnomon run` of it gives the same figures");
  ImGui::SameLine();
  actions.savePicture =
      widgets_.button("picture", "save.screenshot", "The content of this window as a PNG file");
  ImGui::SameLine();
  actions.saveMasks = widgets_.button("masks", "save.masks",
                                      "What each pane says of every pixel, lit or in shadow, as a "
                                      "PNG file");
  ImGui::SameLine();
  widgets_.faintText("? keys");
  return actions;
}

void ControlPanel::truth(const ViewSession& session) {
  drawProgress(session.tracing(),
               session.isComplete() ? "truth: every pixel is traced" : "truth: waiting");
  widgets_.note("tracing",
                "The truth is ray-traced in the background. The errors in the panes count the "
                "pixels that are traced so far");
}

Actions ControlPanel::draw(ViewSession& session, const PaneRectangle& place,
                           const PanelFacts& facts) {
  const bool isRecording = facts.path.isRecording;
  widgets_.begin(!isRecording);
  ImGui::SetNextWindowPos(point(place.corner));
  ImGui::SetNextWindowSize(point(place.size));
  ImGui::Begin("controls", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushItemWidth(-100);
  Actions actions;
  ImGui::BeginDisabled(isRecording);
  actions += study(session, facts);
  actions += steps(facts);
  drawPaneControls(session, widgets_);
  drawCameraControls(session, widgets_);
  drawLightControls(session, widgets_);
  ImGui::EndDisabled();
  actions += drawPathControls(session, facts.path, widgets_);
  ImGui::BeginDisabled(isRecording);
  drawSurfaceControls(session, widgets_);
  drawTableControls(session, widgets_);
  drawOverlayControls(session.state(), widgets_);
  truth(session);
  actions += saving();
  drawParameterControls(session, widgets_);
  ImGui::EndDisabled();
  if (facts.frames.longestMilliseconds() > 0) {
    widgets_.faintText(fmt::format("last picture drawn in {:.0f} ms, slowest {:.0f} ms",
                                   facts.frames.lastMilliseconds(),
                                   facts.frames.longestMilliseconds()));
  }
  ImGui::PopItemWidth();
  ImGui::End();
  return actions;
}

}  // namespace gnomon::app
