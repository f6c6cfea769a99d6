#include "viewer/window/study_controls.h"

#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace gnomon::app {
namespace {

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

void parameter(const std::string& label, const std::string& name,
               const render::MethodParameter& about, double standard,
               std::map<std::string, double>& changed, ControlWidgets& widgets) {
  const std::string place = fmt::format("{}.{}", label, name);
  double value = changed.contains(name) ? changed.at(name) : standard;
  if (about.kind == render::ParameterKind::flag) {
    bool isOn = value != 0;
    if (widgets.checkbox(name.c_str(), place, isOn, about.about.c_str())) {
      changed[name] = isOn ? 1 : 0;
    }
    return;
  }
  const double range = about.maximum - about.minimum;
  const bool isInt = about.kind == render::ParameterKind::whole;
  const bool isWhole = isInt || (range >= 16 && std::floor(standard) == standard);
  if (widgets.slider(name.c_str(), place, value, about.minimum, about.maximum,
                     isWhole ? "%.0f" : formatFor(range).c_str(), about.about.c_str())) {
    changed[name] = isInt ? std::round(value) : value;
  }
}

}  // namespace

void drawProgress(const WorkStatus& work, const char* idle) {
  if (work.busy) {
    const std::string text = fmt::format("{} {:.0f} %", work.stage, 100 * work.share);
    ImGui::ProgressBar(static_cast<float>(work.share), ImVec2(-1, 0), text.c_str());
  } else {
    ImGui::ProgressBar(0, ImVec2(-1, 0), idle);
  }
}

void drawSurfaceControls(ViewSession& session, ControlWidgets& widgets) {
  StudyChanges& changes = session.state().changes;
  const StudyNumbers& numbers = session.numbers();
  widgets.heading("Surface");
  if (numbers.height) {
    double height = changes.height.value_or(*numbers.height);
    const auto [low, high] = rangeAround(*numbers.height);
    if (widgets.slider("bump height", "relief.height", height, low, high,
                       formatFor(high - low).c_str(),
                       "How high the bumps are for the full white of the height map")) {
      changes.height = height;
    }
  }
  if (numbers.curvature) {
    double curvature = changes.curvature.value_or(*numbers.curvature);
    const double high = 2 * *numbers.curvature;
    if (widgets.slider("curvature", "surface.curvature", curvature, high / 100, high,
                       formatFor(high).c_str(),
                       "Of the sphere or cylinder: 1 divided by its radius")) {
      changes.curvature = curvature;
    }
  }
  int subdivisions = changes.subdivisions.value_or(session.opened().base.subdivisions);
  if (widgets.slider("mesh pieces", "base.subdivisions", subdivisions, 1, 8,
                     "Pieces per side into which each face is cut for the mesh that methods "
                     "draw")) {
    changes.subdivisions = subdivisions;
  }
}

void drawTableControls(ViewSession& session, ControlWidgets& widgets) {
  BakeChange& bake = session.state().changes.bake;
  const study::BakeSpec& opened = session.opened().bake;
  widgets.heading("Horizon tables, which many methods read");
  int azimuths = bake.azimuths.value_or(opened.settings.azimuths);
  if (widgets.slider("azimuths", "bake.azimuths", azimuths, 1, 128,
                     "In how many directions around a texel its horizon is stored")) {
    bake.azimuths = azimuths;
  }
  // The key counts texels of the map before it was resampled.
  const double openedRadius = opened.settings.radiusTexels / session.opened().relief.resample;
  double radius = bake.radius.value_or(openedRadius);
  if (widgets.slider("search radius", "bake.radius", radius, 1, 2 * openedRadius, "%.0f texels",
                     "How far from a texel its horizon is searched: bumps farther away are not "
                     "seen")) {
    bake.radius = radius;
  }
  const int bits = bake.bits.value_or(static_cast<int>(opened.bits));
  for (const int choice : {8, 16, 32}) {
    if (choice > 8) ImGui::SameLine();
    if (widgets.radio(fmt::format("{}", choice), fmt::format("bake.bits.{}", choice),
                      bits == choice, "Bits in which every value of the tables is stored")) {
      bake.bits = choice;
    }
  }
  ImGui::SameLine();
  ImGui::TextUnformatted("bits per value");
  drawProgress(session.baking(), "the tables are ready");
  widgets.note("baking", "New tables are computed in the background; until then the old ones stay");
}

void drawParameterControls(ViewSession& session, ControlWidgets& widgets) {
  if (!session.hasScene()) return;
  auto& changes = session.state().changes.methods;
  for (const auto& [label, method] : session.scene()->methods) {
    if (method->method.parameters.empty()) continue;
    widgets.heading(label.c_str());
    ImGui::PushID(label.c_str());
    const auto& own = method->spec.parameters;
    for (const auto& [name, about] : method->method.parameters) {
      parameter(label, name, about, own.contains(name) ? own.at(name) : about.defaultValue,
                changes[label].parameters, widgets);
    }
    ImGui::PopID();
  }
  std::erase_if(changes, [](const auto& change) { return change.second.parameters.empty(); });
}

}  // namespace gnomon::app
