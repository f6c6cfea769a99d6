#include "viewer/window/controls.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/panes/gui.h"
#include "viewer/panes/pane_labels.h"

namespace gnomon::app {
namespace {

void heading(const char* text) {
  ImGui::Dummy(ImVec2(0, 2));
  ImGui::PushStyleColor(ImGuiCol_Text, ink::faint);
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
}

void faintText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ink::faint);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

void progressBar(const WorkStatus& work, const char* idle) {
  if (work.busy) {
    const std::string text = fmt::format("{} {:.0f} %", work.stage, 100 * work.share);
    ImGui::ProgressBar(static_cast<float>(work.share), ImVec2(-1, 0), text.c_str());
  } else {
    ImGui::ProgressBar(0, ImVec2(-1, 0), idle);
  }
}

/// Twice what the file has, on its side of zero.
std::pair<double, double> rangeAround(double value) {
  const double reach = value == 0 ? 1 : 2 * std::abs(value);
  return value < 0 ? std::pair(-reach, 0.0) : std::pair(0.0, reach);
}

/// Decimals that show a hundredth of a range.
std::string formatFor(double range) {
  const int decimals =
      std::clamp(3 - static_cast<int>(std::floor(std::log10(std::max(range, 1e-9)))), 0, 8);
  return fmt::format("%.{}f", decimals);
}

}  // namespace

void ControlPanel::note(const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 high = ImGui::GetItemRectMax();
  places_[name] = {static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(high.x),
                   static_cast<int>(high.y)};
}

bool ControlPanel::openList(const char* label, const std::string& name, const std::string& shown) {
  const bool isOpen = ImGui::BeginCombo(label, shown.c_str(), ImGuiComboFlags_HeightLarge);
  note(name);
  if (isOpen && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
    ImGui::CloseCurrentPopup();
  }
  return isOpen;
}

std::optional<std::size_t> ControlPanel::list(const char* label, const std::string& name,
                                              const std::vector<std::string>& entries,
                                              std::optional<std::size_t> chosen) {
  std::optional<std::size_t> pressed;
  if (!openList(label, name, chosen ? entries.at(*chosen) : "other")) return pressed;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(entries[i].c_str(), i == chosen)) pressed = i;
    note(fmt::format("{}.{}", name, i));
    ImGui::PopID();
  }
  ImGui::EndCombo();
  return pressed;
}

bool ControlPanel::slider(const char* label, const std::string& name, double& value, double low,
                          double high, const char* format) {
  const bool changed = ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format,
                                           ImGuiSliderFlags_AlwaysClamp);
  note(name);
  return changed;
}

bool ControlPanel::slider(const char* label, const std::string& name, int& value, int low,
                          int high) {
  const bool changed =
      ImGui::SliderInt(label, &value, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
  note(name);
  return changed;
}

void ControlPanel::paneChoice(ViewSession& session, std::size_t pane) {
  PaneContent& content = session.state().panes.at(pane);
  std::vector<PaneSource> masks = {tracedTruth};
  for (const std::string& label : session.labels()) masks.push_back(methodSource(label));
  ImGui::PushID(static_cast<int>(pane));
  // A method may have the name of another source: the kind tells them apart.
  const auto entry = [&](const std::string& list, const PaneSource& source, bool isChosen) {
    const std::string text = sourceText(source);
    ImGui::PushID(static_cast<int>(source.kind));
    const bool pressed = ImGui::Selectable(text.c_str(), isChosen);
    note(list + "." + text);
    ImGui::PopID();
    return pressed;
  };
  const std::string name = fmt::format("pane.{}", pane);
  ImGui::SetNextItemWidth(154);
  if (openList("##shown", name + ".shown", sourceText(content.shown))) {
    std::vector<PaneSource> sources = masks;
    sources.push_back(displacedSurface);
    for (const PaneSource& source : sources) {
      if (entry(name + ".shown", source, source == content.shown)) {
        content.shown = source;
      }
    }
    ImGui::EndCombo();
  }
  if (content.shown == displacedSurface) {
    content.against.reset();
  } else {
    ImGui::SameLine(0, 4);
    ImGui::TextUnformatted("\u2212");
    ImGui::SameLine(0, 4);
    ImGui::SetNextItemWidth(-1);
    if (openList("##against", name + ".against",
                 content.against ? sourceText(*content.against) : "nothing")) {
      if (ImGui::Selectable("nothing", !content.against)) content.against.reset();
      note(name + ".against.nothing");
      for (const PaneSource& source : masks) {
        if (entry(name + ".against", source, source == content.against)) {
          content.against = source;
        }
      }
      ImGui::EndCombo();
    }
  }
  ImGui::PopID();
}

void ControlPanel::panes(ViewSession& session) {
  ViewState& state = session.state();
  heading("Panes");
  for (const int count : {1, 2, 4}) {
    if (count > 1) ImGui::SameLine();
    if (ImGui::RadioButton(fmt::format("{}", count).c_str(), state.paneCount == count)) {
      state.paneCount = count;
    }
    note(fmt::format("panes.{}", count));
  }
  if (state.paneCount == 2) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-44);
    slider("wipe", "wipe", state.wipe, 0, 1, "%.2f");
  }
  for (int i = 0; i < state.paneCount; ++i) paneChoice(session, static_cast<std::size_t>(i));
}

/// The study's cameras, where it has several; each in the panes' size.
void ControlPanel::view(ViewSession& session) {
  Camera& camera = session.state().camera;
  std::vector<std::string> names;
  std::vector<Camera> cameras;
  std::optional<std::size_t> chosen;
  for (const study::ViewSpec& view : session.opened().views) {
    const Camera* own = study::cameraOf(view);
    if (own == nullptr) continue;
    cameras.push_back(*own);
    cameras.back().width = camera.width;
    cameras.back().height = camera.height;
    if (sameCamera(cameras.back(), camera)) chosen = names.size();
    names.push_back(view.name);
  }
  if (names.size() < 2) return;
  if (const auto pressed = list("view", "view", names, chosen)) camera = cameras.at(*pressed);
}

void ControlPanel::light(ViewSession& session) {
  LightAngles& light = session.state().light;
  const std::vector<study::LightSpec>& lights = session.opened().lights;
  heading("Light, degrees");
  if (lights.size() > 1) {
    std::vector<std::string> names;
    std::optional<std::size_t> chosen;
    for (const study::LightSpec& one : lights) {
      if (lightAngles(one) == light) chosen = names.size();
      names.push_back(one.name);
    }
    if (const auto pressed = list("light", "light", names, chosen)) {
      light = lightAngles(lights.at(*pressed));
    }
  }
  slider("azimuth", "light.azimuth", light.azimuth, 0, 360, "%.1f");
  slider("elevation", "light.elevation", light.elevation, -10, 90, "%.1f");
  slider("radius", "light.radius", light.radius, 0, study::largestLightRadius, "%.3f");
  ImGui::SameLine();
  if (ImGui::SmallButton("sun")) light.radius = study::sunRadius;
  note("light.sun");
}

void ControlPanel::surface(ViewSession& session) {
  StudyChanges& changes = session.state().changes;
  const StudyNumbers& numbers = session.numbers();
  heading("Surface and base mesh");
  if (numbers.height) {
    double height = changes.height.value_or(*numbers.height);
    const auto [low, high] = rangeAround(*numbers.height);
    if (slider("bump height", "relief.height", height, low, high, formatFor(high - low).c_str())) {
      changes.height = height;
    }
  }
  if (numbers.curvature) {
    double curvature = changes.curvature.value_or(*numbers.curvature);
    const double high = 2 * *numbers.curvature;
    if (slider("curvature", "surface.curvature", curvature, high / 100, high,
               formatFor(high).c_str())) {
      changes.curvature = curvature;
    }
  }
  int subdivisions = changes.subdivisions.value_or(session.opened().base.subdivisions);
  if (slider("tessellation", "base.subdivisions", subdivisions, 1, 8)) {
    changes.subdivisions = subdivisions;
  }
}

void ControlPanel::tables(ViewSession& session) {
  BakeChange& bake = session.state().changes.bake;
  const study::BakeSpec& opened = session.opened().bake;
  heading("Tables");
  int azimuths = bake.azimuths.value_or(opened.settings.azimuths);
  if (slider("azimuths", "bake.azimuths", azimuths, 1, 128)) bake.azimuths = azimuths;
  // The key counts texels of the map before it was resampled.
  const double openedRadius = opened.settings.radiusTexels / session.opened().relief.resample;
  double radius = bake.radius.value_or(openedRadius);
  if (slider("radius, texels", "bake.radius", radius, 1, 2 * openedRadius, "%.0f")) {
    bake.radius = radius;
  }
  const int bits = bake.bits.value_or(static_cast<int>(opened.bits));
  for (const int choice : {8, 16, 32}) {
    if (choice > 8) ImGui::SameLine();
    if (ImGui::RadioButton(fmt::format("{}", choice).c_str(), bits == choice)) bake.bits = choice;
    note(fmt::format("bake.bits.{}", choice));
  }
  ImGui::SameLine();
  ImGui::TextUnformatted("bits");
  progressBar(session.baking(), "tables are ready");
  note("baking");
}

void ControlPanel::parameters(ViewSession& session) {
  if (!session.hasScene()) return;
  for (const auto& [label, method] : session.scene()->methods) {
    if (method->method.parameters.empty()) continue;
    heading(label.c_str());
    ImGui::PushID(label.c_str());
    for (const auto& [name, parameter] : method->method.parameters) {
      const auto& own = method->spec.parameters;
      const double standard = own.contains(name) ? own.at(name) : parameter.defaultValue;
      auto& changed = session.state().changes.methods[label].parameters;
      double value = changed.contains(name) ? changed.at(name) : standard;
      if (parameter.kind == render::ParameterKind::flag) {
        bool isOn = value != 0;
        if (ImGui::Checkbox(name.c_str(), &isOn)) changed[name] = isOn ? 1 : 0;
        note(fmt::format("{}.{}", label, name));
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", parameter.about.c_str());
        continue;
      }
      const double range = parameter.maximum - parameter.minimum;
      const bool isInt = parameter.kind == render::ParameterKind::whole;
      const bool whole = isInt || (range >= 16 && std::floor(standard) == standard);
      if (slider(name.c_str(), fmt::format("{}.{}", label, name), value, parameter.minimum,
                 parameter.maximum, whole ? "%.0f" : formatFor(range).c_str())) {
        changed[name] = isInt ? std::round(value) : value;
      }
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", parameter.about.c_str());
    }
    ImGui::PopID();
  }
  std::erase_if(session.state().changes.methods,
                [](const auto& change) { return change.second.parameters.empty(); });
}

void ControlPanel::overlays(ViewState& state) {
  heading("Overlays");
  Overlays& overlays = state.overlays;
  for (const auto& [name, isOn] : {std::pair("curvature", &overlays.curvature),
                                   {"directions", &overlays.directions},
                                   {"section", &overlays.section},
                                   {"pixel", &overlays.pixel}}) {
    if (isOn != &overlays.curvature && isOn != &overlays.pixel) ImGui::SameLine();
    ImGui::Checkbox(fmt::format("{}##overlay", name).c_str(), isOn);
    note(fmt::format("overlay.{}", name));
  }
}

SaveActions ControlPanel::saving(const std::string& said) {
  SaveActions actions;
  heading("Save");
  for (const auto& [name, isPressed] : {std::pair("study", &actions.study),
                                        {"screenshot", &actions.screenshot},
                                        {"masks", &actions.masks}}) {
    *isPressed = ImGui::Button(name);
    note(fmt::format("save.{}", name));
    ImGui::SameLine();
  }
  faintText("? keys");
  if (!said.empty()) faintText(said);
  return actions;
}

void ControlPanel::status(const ViewSession& session, const FrameLog& frames) {
  heading("Truth");
  progressBar(session.tracing(), session.isComplete() ? "traced to the last sample" : "waiting");
  note("tracing");
  if (frames.longestMilliseconds() == 0) return;
  faintText(fmt::format("frame {:.0f} ms, longest {:.0f} ms", frames.lastMilliseconds(),
                        frames.longestMilliseconds()));
}

SaveActions ControlPanel::draw(ViewSession& session, const PaneRectangle& place,
                               const FrameLog& frames, const std::string& said) {
  places_.clear();
  ImGui::SetNextWindowPos(point(place.corner));
  ImGui::SetNextWindowSize(point(place.size));
  ImGui::Begin("controls", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushItemWidth(-100);
  ImGui::TextWrapped("%s", session.opened().title.c_str());
  panes(session);
  view(session);
  light(session);
  surface(session);
  tables(session);
  overlays(session.state());
  status(session, frames);
  const SaveActions actions = saving(said);
  parameters(session);
  ImGui::PopItemWidth();
  ImGui::End();
  return actions;
}

void drawErrors(const ViewSession& session, const WindowLayout& layout) {
  const std::vector<std::string> errors = session.errors();
  if (errors.empty()) return;
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const float width = static_cast<float>(layout.pictures.size.x) - 40;
  float height = 12;
  for (const std::string& error : errors) {
    height += ImGui::CalcTextSize(error.c_str(), nullptr, false, width - 24).y + 4;
  }
  const ImVec2 begin =
      point(layout.pictures.corner + layout.pictures.size / 2.0 - Vec2(width, height) / 2.0);
  const ImVec2 end(begin.x + width, begin.y + height);
  list.AddRectFilled(begin, end, IM_COL32(255, 240, 238, 242), 5);
  list.AddRect(begin, end, ink::alarm, 5);
  float y = begin.y + 8;
  for (const std::string& error : errors) {
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), ImVec2(begin.x + 12, y), ink::alarm,
                 error.c_str(), nullptr, width - 24);
    y += ImGui::CalcTextSize(error.c_str(), nullptr, false, width - 24).y + 4;
  }
}

void drawWaiting(const ViewSession& session, const WindowLayout& layout) {
  if (session.hasScene()) return;
  const WorkStatus work = session.baking();
  const std::string text =
      work.stage.empty() ? "Starting" : fmt::format("{} {:.0f} %", work.stage, 100 * work.share);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 middle = point(layout.pictures.corner + layout.pictures.size / 2.0);
  ImGui::GetBackgroundDrawList()->AddText(ImVec2(middle.x - size.x / 2, middle.y), ink::faint,
                                          text.c_str());
}

}  // namespace gnomon::app
