#include "viewer/window/controls.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/panes/gui.h"

namespace gnomon::app {

namespace {

// Panes

/// A line for a source. A method may have the name of another source: the kind tells them apart.
bool sourceEntry(const PaneSource& source, bool isChosen) {
  ImGui::PushID(static_cast<int>(source.kind));
  const bool isPressed = ImGui::Selectable(sourceText(source).c_str(), isChosen);
  ImGui::PopID();
  return isPressed;
}

void chooseShown(PaneContent& content, const std::vector<PaneSource>& masks) {
  ImGui::SetNextItemWidth(154);
  if (!widgets::openList("##shown", sourceText(content.shown),
                         "What this pane shows: a method; `truth`, ray-traced; or `displaced`, the "
                         "surface with its real bumps, ray-traced")) {
    return;
  }
  std::vector<PaneSource> sources = masks;
  sources.push_back(displacedSurface);
  for (const PaneSource& source : sources) {
    if (sourceEntry(source, source == content.shown)) content.shown = source;
  }
  ImGui::EndCombo();
}

void chooseAgainst(PaneContent& content, const std::vector<PaneSource>& masks) {
  ImGui::SetNextItemWidth(-1);
  if (!widgets::openList("##against", content.against ? sourceText(*content.against) : "nothing",
                         "What is subtracted: the pane then shows in colours where the two "
                         "disagree")) {
    return;
  }
  if (ImGui::Selectable("nothing", !content.against)) content.against.reset();
  for (const PaneSource& source : masks) {
    if (sourceEntry(source, source == content.against)) content.against = source;
  }
  ImGui::EndCombo();
}

void paneChoice(ViewSession& session, std::size_t pane) {
  PaneContent& content = session.state().panes.at(pane);
  std::vector<PaneSource> masks = {tracedTruth};
  for (const std::string& label : session.labels()) masks.push_back(methodSource(label));
  ImGui::PushID(static_cast<int>(pane));
  chooseShown(content, masks);
  if (content.shown == displacedSurface) {
    content.against.reset();
  } else {
    ImGui::SameLine(0, 4);
    ImGui::TextUnformatted("\u2212");
    ImGui::SameLine(0, 4);
    chooseAgainst(content, masks);
  }
  ImGui::PopID();
}

/// How many panes there are, and what each of them shows.
void paneControls(ViewSession& session) {
  ViewState& state = session.state();
  widgets::heading("Panes, and what they show");
  for (const int count : {1, 2, 4}) {
    if (count > 1) ImGui::SameLine();
    if (widgets::radio(fmt::format("{}", count), state.paneCount == count,
                       "Pictures beside each other, under one camera and one light")) {
      state.paneCount = count;
    }
  }
  if (state.paneCount == 2) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-64);
    widgets::slider("divider", state.wipe, 0, 1, "%.2f",
                    "Where the line between the two panes is: 0 at the left, 1 at the right");
  }
  for (int i = 0; i < state.paneCount; ++i) paneChoice(session, static_cast<std::size_t>(i));
}

/// What is drawn over the pictures.
void overlayControls(Overlays& overlays) {
  widgets::heading("Show over the pictures");
  widgets::checkbox("curvature##overlay", overlays.curvature,
                    "How strongly the surface bends toward the light: green bends away, purple "
                    "bends inward");
  ImGui::SameLine();
  widgets::checkbox("directions##overlay", overlays.directions,
                    "Lines along which the surface bends most (red) and least (blue)");
  widgets::checkbox("cross-section##overlay", overlays.section,
                    "The surface cut toward the light, through the pixel under the cursor");
  ImGui::SameLine();
  widgets::checkbox("pixel##overlay", overlays.pixel,
                    "What every method says of the pixel under the cursor, and why it is lit or "
                    "not");
}

// Camera and light

/// The study's cameras, where it has several.
void cameraControls(ViewSession& session) {
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
  const auto pressed = widgets::list("camera", names, chosen, "The cameras of the study");
  if (pressed) camera = cameras.at(*pressed);
}

/// The light: one of the study's, or any direction and size.
void lightControls(ViewSession& session) {
  LightAngles& light = session.state().light;
  const std::vector<Light>& lights = session.opened().lights;
  widgets::heading("Light, degrees");
  if (lights.size() > 1) {
    std::vector<std::string> names;
    std::optional<std::size_t> chosen;
    for (const Light& one : lights) {
      if (one.angles == light) chosen = names.size();
      names.push_back(one.name);
    }
    const auto pressed = widgets::list("light", names, chosen, "The lights of the study");
    if (pressed) light = lights.at(*pressed).angles;
  }
  widgets::slider("azimuth", light.azimuth, 0, 360, "%.1f",
                  "From where the light comes: 0 along x, 90 along y");
  widgets::slider("elevation", light.elevation, -10, 90, "%.1f",
                  "How high the light stands: 0 at the ground, 90 straight above");
  widgets::slider(
      "radius", light.radius, 0, study::largestLightRadius, "%.3f",
      "Size of the light as it is seen from the surface: 0 is a point with hard shadows; "
      "more is a disc with soft shadows");
  ImGui::SameLine();
  if (ImGui::SmallButton("sun")) light.radius = study::sunRadius;
  widgets::hintOf("As large as the sun is in the sky: 0.266°");
}

// Numbers of the study

/// A bar that shows how far a computation is.
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

/// The sliders of the bumps and of the meshes.
void surfaceControls(ViewSession& session) {
  StudyChanges& changes = session.state().changes;
  const StudyNumbers& numbers = session.numbers();
  widgets::heading("Surface");
  if (numbers.height) {
    double height = changes.height.value_or(*numbers.height);
    const auto [low, high] = rangeAround(*numbers.height);
    if (widgets::slider("bump height", height, low, high, formatFor(high - low).c_str(),
                        "How high the bumps are for the full white of the height map")) {
      changes.height = height;
    }
  }
  if (numbers.curvature) {
    double curvature = changes.curvature.value_or(*numbers.curvature);
    const double high = 2 * *numbers.curvature;
    if (widgets::slider("curvature", curvature, high / 100, high, formatFor(high).c_str(),
                        "Of the sphere or cylinder: 1 divided by its radius")) {
      changes.curvature = curvature;
    }
  }
  int subdivisions = changes.subdivisions.value_or(session.opened().base.subdivisions);
  if (widgets::slider("mesh pieces", subdivisions, 1, 8,
                      "Pieces per side into which each face is cut for the mesh that methods "
                      "draw")) {
    changes.subdivisions = subdivisions;
  }
}

/// The sliders of the tables that methods read, and how far their bake is.
void tableControls(ViewSession& session) {
  BakeChange& bake = session.state().changes.bake;
  const study::BakeSpec& opened = session.opened().bake;
  widgets::heading("Horizon tables, which many methods read");
  int azimuths = bake.azimuths.value_or(opened.settings.azimuths);
  if (widgets::slider("azimuths", azimuths, 1, 128,
                      "In how many directions around a texel its horizon is stored")) {
    bake.azimuths = azimuths;
  }
  // The key counts texels of the map before it was resampled.
  const double openedRadius = opened.settings.radiusTexels / session.opened().relief.resample;
  double radius = bake.radius.value_or(openedRadius);
  if (widgets::slider("search radius", radius, 1, 2 * openedRadius, "%.0f texels",
                      "How far from a texel its horizon is searched: bumps farther away are not "
                      "seen")) {
    bake.radius = radius;
  }
  const int bits = bake.bits.value_or(static_cast<int>(opened.bits));
  for (const int choice : {8, 16, 32}) {
    if (choice > 8) ImGui::SameLine();
    if (widgets::radio(fmt::format("{}", choice), bits == choice,
                       "Bits in which every value of the tables is stored")) {
      bake.bits = choice;
    }
  }
  ImGui::SameLine();
  ImGui::TextUnformatted("bits per value");
  progressBar(session.baking(), "the tables are ready");
  widgets::hintOf("New tables are computed in the background; until then the old ones stay");
}

void parameter(const std::string& name, const render::MethodParameter& about, double standard,
               std::map<std::string, double>& changed) {
  double value = changed.contains(name) ? changed.at(name) : standard;
  if (about.kind == render::ParameterKind::flag) {
    bool isOn = value != 0;
    if (widgets::checkbox(name.c_str(), isOn, about.about.c_str())) changed[name] = isOn ? 1 : 0;
    return;
  }
  const double range = about.maximum - about.minimum;
  const bool isInt = about.kind == render::ParameterKind::whole;
  const bool isWhole = isInt || (range >= 16 && std::floor(standard) == standard);
  if (widgets::slider(name.c_str(), value, about.minimum, about.maximum,
                      isWhole ? "%.0f" : formatFor(range).c_str(), about.about.c_str())) {
    changed[name] = isInt ? std::round(value) : value;
  }
}

/// The parameters of the methods that are shown.
void parameterControls(ViewSession& session) {
  if (!session.hasScene()) return;
  auto& changes = session.state().changes.methods;
  for (const auto& [label, method] : session.scene()->methods) {
    if (method->method.parameters.empty()) continue;
    widgets::heading(label.c_str());
    ImGui::PushID(label.c_str());
    const auto& own = method->spec.parameters;
    for (const auto& [name, about] : method->method.parameters) {
      parameter(name, about, own.contains(name) ? own.at(name) : about.defaultValue,
                changes[label].parameters);
    }
    ImGui::PopID();
  }
  std::erase_if(changes, [](const auto& change) { return change.second.parameters.empty(); });
}

// Files

Actions saving() {
  Actions actions;
  ImGui::AlignTextToFramePadding();
  widgets::faintText("Save");
  ImGui::SameLine();
  actions.saveStudy = widgets::button(
      "study", "A study file of what is on the screen: `gnomon run` of it gives the same figures");
  ImGui::SameLine();
  actions.savePicture = widgets::button("picture", "The content of this window as a PNG file");
  ImGui::SameLine();
  actions.saveMasks = widgets::button(
      "masks", "What each pane says of every pixel, lit or in shadow, as a PNG file");
  ImGui::SameLine();
  widgets::faintText("? keys");
  return actions;
}

}  // namespace

void FrameLog::end(bool drawn) {
  const double spent = std::chrono::duration<double, std::milli>(Clock::now() - begin_).count();
  longest_ = std::max(longest_, spent);
  if (!drawn) return;
  last_ = spent;
  total_ += spent;
  ++count_;
}

std::string FrameLog::text() const {
  if (count_ == 0) return "frames: none drawn";
  const double mean = total_ / static_cast<double>(count_);
  return fmt::format("frames: {} drawn, mean {:.1f} ms ({:.0f} a second), longest of all {:.1f} ms",
                     count_, mean, 1000 / mean, longest_);
}

Actions drawControls(ViewSession& session, const PaneRectangle& place, const FrameLog& frames) {
  ImGui::SetNextWindowPos(point(place.corner));
  ImGui::SetNextWindowSize(point(place.size));
  ImGui::Begin("controls", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushItemWidth(-100);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(session.opened().title.c_str());
  ImGui::PopTextWrapPos();
  paneControls(session);
  cameraControls(session);
  lightControls(session);
  surfaceControls(session);
  tableControls(session);
  overlayControls(session.state().overlays);
  progressBar(session.tracing(),
              session.isComplete() ? "truth: every pixel is traced" : "truth: waiting");
  widgets::hintOf(
      "The truth is ray-traced in the background. The errors in the panes count the pixels that "
      "are traced so far");
  const Actions actions = saving();
  parameterControls(session);
  if (frames.longestMilliseconds() > 0) {
    widgets::faintText(fmt::format("last picture drawn in {:.0f} ms, slowest {:.0f} ms",
                                   frames.lastMilliseconds(), frames.longestMilliseconds()));
  }
  ImGui::PopItemWidth();
  ImGui::End();
  return actions;
}

}  // namespace gnomon::app

namespace gnomon::app::widgets {

void heading(const char* text) {
  ImGui::Dummy(ImVec2(0, 2));
  ImGui::PushStyleColor(ImGuiCol_Text, ink::faint);
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
}

void faintText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ink::faint);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void hintOf(const char* hint) {
  if (!ImGui::IsItemHovered()) return;
  constexpr float widest = 340;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(widest);
  ImGui::TextUnformatted(hint);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool button(const char* label, const char* hint) {
  const bool isPressed = ImGui::Button(label);
  hintOf(hint);
  return isPressed;
}

bool checkbox(const char* label, bool& value, const char* hint) {
  const bool isChanged = ImGui::Checkbox(label, &value);
  hintOf(hint);
  return isChanged;
}

bool radio(const std::string& label, bool isChosen, const char* hint) {
  const bool isPressed = ImGui::RadioButton(label.c_str(), isChosen);
  hintOf(hint);
  return isPressed;
}

bool slider(const char* label, double& value, double low, double high, const char* format,
            const char* hint) {
  const bool isChanged = ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high,
                                             format, ImGuiSliderFlags_AlwaysClamp);
  hintOf(hint);
  return isChanged;
}

bool slider(const char* label, int& value, int low, int high, const char* hint) {
  const bool isChanged =
      ImGui::SliderInt(label, &value, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
  hintOf(hint);
  return isChanged;
}

bool openList(const char* label, const std::string& shown, const char* hint) {
  const bool isOpen = ImGui::BeginCombo(label, shown.c_str(), ImGuiComboFlags_HeightLarge);
  if (!isOpen) {
    hintOf(hint);
  } else if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
    ImGui::CloseCurrentPopup();
  }
  return isOpen;
}

std::optional<std::size_t> list(const char* label, const std::vector<std::string>& entries,
                                std::optional<std::size_t> chosen, const char* hint) {
  std::optional<std::size_t> pressed;
  if (!openList(label, chosen ? entries.at(*chosen) : "other", hint)) return pressed;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(entries[i].c_str(), i == chosen)) pressed = i;
    ImGui::PopID();
  }
  ImGui::EndCombo();
  return pressed;
}

}  // namespace gnomon::app::widgets
