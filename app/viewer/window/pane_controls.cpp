#include "viewer/window/pane_controls.h"

#include <fmt/core.h>
#include <imgui.h>

namespace gnomon::app {
namespace {

/// A line for a source. A method may have the name of another source: the kind tells them apart.
bool sourceEntry(ControlWidgets& widgets, const std::string& list, const PaneSource& source,
                 bool isChosen) {
  const std::string text = sourceText(source);
  ImGui::PushID(static_cast<int>(source.kind));
  const bool isPressed = widgets.entry(text, list + "." + text, isChosen);
  ImGui::PopID();
  return isPressed;
}

void chooseShown(PaneContent& content, const std::string& name,
                 const std::vector<PaneSource>& masks, ControlWidgets& widgets) {
  ImGui::SetNextItemWidth(154);
  if (!widgets.openList("##shown", name, sourceText(content.shown),
                        "What this pane shows: a method; `truth`, ray-traced; or `displaced`, the "
                        "surface with its real bumps, ray-traced")) {
    return;
  }
  std::vector<PaneSource> sources = masks;
  sources.push_back(displacedSurface);
  for (const PaneSource& source : sources) {
    if (sourceEntry(widgets, name, source, source == content.shown)) content.shown = source;
  }
  ImGui::EndCombo();
}

void chooseAgainst(PaneContent& content, const std::string& name,
                   const std::vector<PaneSource>& masks, ControlWidgets& widgets) {
  ImGui::SetNextItemWidth(-1);
  if (!widgets.openList("##against", name,
                        content.against ? sourceText(*content.against) : "nothing",
                        "What is subtracted: the pane then shows in colours where the two "
                        "disagree")) {
    return;
  }
  if (widgets.entry("nothing", name + ".nothing", !content.against)) content.against.reset();
  for (const PaneSource& source : masks) {
    if (sourceEntry(widgets, name, source, source == content.against)) content.against = source;
  }
  ImGui::EndCombo();
}

void paneChoice(ViewSession& session, std::size_t pane, ControlWidgets& widgets) {
  PaneContent& content = session.state().panes.at(pane);
  std::vector<PaneSource> masks = {tracedTruth};
  for (const std::string& label : session.labels()) masks.push_back(methodSource(label));
  const std::string name = fmt::format("pane.{}", pane);
  ImGui::PushID(static_cast<int>(pane));
  chooseShown(content, name + ".shown", masks, widgets);
  if (content.shown == displacedSurface) {
    content.against.reset();
  } else {
    ImGui::SameLine(0, 4);
    ImGui::TextUnformatted("\u2212");
    ImGui::SameLine(0, 4);
    chooseAgainst(content, name + ".against", masks, widgets);
  }
  ImGui::PopID();
}

}  // namespace

void drawPaneControls(ViewSession& session, ControlWidgets& widgets) {
  ViewState& state = session.state();
  widgets.heading("Panes, and what they show");
  for (const int count : {1, 2, 4}) {
    if (count > 1) ImGui::SameLine();
    if (widgets.radio(fmt::format("{}", count), fmt::format("panes.{}", count),
                      state.paneCount == count,
                      "Pictures beside each other, under one camera and "
                      "one light")) {
      state.paneCount = count;
    }
  }
  if (state.paneCount == 2) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-64);
    widgets.slider("divider", "wipe", state.wipe, 0, 1, "%.2f",
                   "Where the line between the two panes is: 0 at the left, 1 at the right");
  }
  for (int i = 0; i < state.paneCount; ++i) {
    paneChoice(session, static_cast<std::size_t>(i), widgets);
  }
}

void drawOverlayControls(ViewState& state, ControlWidgets& widgets) {
  widgets.heading("Show over the pictures");
  Overlays& overlays = state.overlays;
  widgets.checkbox("curvature##overlay", "overlay.curvature", overlays.curvature,
                   "How strongly the surface bends toward the light: green bends away, purple "
                   "bends inward");
  ImGui::SameLine();
  widgets.checkbox("directions##overlay", "overlay.directions", overlays.directions,
                   "Lines along which the surface bends most (red) and least (blue)");
  widgets.checkbox("cross-section##overlay", "overlay.section", overlays.section,
                   "The surface cut toward the light, through the pixel under the cursor");
  ImGui::SameLine();
  widgets.checkbox("pixel##overlay", "overlay.pixel", overlays.pixel,
                   "What every method says of the pixel under the cursor, and why it is lit or "
                   "not");
}

}  // namespace gnomon::app
