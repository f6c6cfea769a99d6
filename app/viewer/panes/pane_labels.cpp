#include "viewer/panes/pane_labels.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "image/images.h"
#include "image/mask_picture.h"
#include "model/cross_section.h"
#include "render/gl_objects.h"
#include "report/text/number_text.h"
#include "viewer/panes/gui.h"

namespace gnomon::app {

namespace {

ImU32 colourOf(const image::Rgb& colour) {
  return IM_COL32(colour[0], colour[1], colour[2], 255);
}

float differenceLegendHeight() {
  return ImGui::GetTextLineHeight() + 10;
}

/// What the colours of a difference of masks mean.
void drawMaskLegend(ImDrawList& list, const PaneRectangle& pane, bool rightAligned) {
  constexpr std::array entries = {std::pair(image::DifferenceColours::falseShadow, "false shadow"),
                                  std::pair(image::DifferenceColours::falseLight, "false light")};
  constexpr float square = 11;
  float width = 8;
  for (const auto& [colour, text] : entries) width += square + 18 + ImGui::CalcTextSize(text).x;
  const float height = differenceLegendHeight();
  ImVec2 at = point(pane.corner +
                    Vec2(rightAligned ? pane.size.x - width - 10 : 10, pane.size.y - height - 10));
  list.AddRectFilled(at, ImVec2(at.x + width, at.y + height), ink::chip, 4);
  at = ImVec2(at.x + 8, at.y + 5);
  for (const auto& [colour, text] : entries) {
    list.AddRectFilled(ImVec2(at.x, at.y + 3), ImVec2(at.x + square, at.y + 3 + square),
                       colourOf(colour), 2);
    list.AddText(ImVec2(at.x + square + 5, at.y), ink::text, text);
    at.x += square + 18 + ImGui::CalcTextSize(text).x;
  }
}

/// The colours of ΔV from −1 to 1, over the greys of truths that it can be against.
image::Image shareScale(int steps) {
  Visibility candidate{steps, 1, {}};
  Visibility truth{steps, 1, {}};
  for (int i = 0; i < steps; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(steps - 1);
    candidate.shares.push_back(share);
    truth.shares.push_back(1 - share);
  }
  return image::shareDifferenceImage(candidate, truth);
}

/// The same of shares.
void drawShareLegend(ImDrawList& list, const PaneRectangle& pane, bool rightAligned) {
  constexpr int steps = 41;
  constexpr float step = 3;
  const char* below = "\u22121 false shadow";
  const char* above = "false light 1";
  const float side = std::max(ImGui::CalcTextSize(below).x, ImGui::CalcTextSize(above).x) + 6;
  const float width = 2 * side + steps * step + 16;
  const float height = differenceLegendHeight();
  const ImVec2 begin = point(
      pane.corner + Vec2(rightAligned ? pane.size.x - width - 10 : 10, pane.size.y - height - 10));
  list.AddRectFilled(begin, ImVec2(begin.x + width, begin.y + height), ink::chip, 4);
  list.AddText(ImVec2(begin.x + 8 + side - 6 - ImGui::CalcTextSize(below).x, begin.y + 5),
               ink::text, below);
  const image::Image scale = shareScale(steps);
  for (int i = 0; i < steps; ++i) {
    const float x = begin.x + 8 + side + static_cast<float>(i) * step;
    const auto* rgb = &scale.rgb[3 * static_cast<std::size_t>(i)];
    list.AddRectFilled(ImVec2(x, begin.y + 7), ImVec2(x + step, begin.y + height - 7),
                       colourOf({rgb[0], rgb[1], rgb[2]}));
  }
  list.AddText(ImVec2(begin.x + 8 + side + steps * step + 6, begin.y + 5), ink::text, above);
}

}  // namespace

void drawDifferenceLegend(ImDrawList& list, const PaneRectangle& pane, bool isSoft,
                          bool rightAligned) {
  (isSoft ? drawShareLegend : drawMaskLegend)(list, pane, rightAligned);
}

void drawCurvatureLegend(ImDrawList& list, const PaneRectangle& pictures, double largest) {
  constexpr float width = 200;
  constexpr float bar = 10;
  const float height = 2 * ImGui::GetTextLineHeight() + bar + 18;
  const ImVec2 begin =
      point(pictures.corner + Vec2((pictures.size.x - width) / 2,
                                   pictures.size.y - height - differenceLegendHeight() - 20));
  list.AddRectFilled(begin, ImVec2(begin.x + width, begin.y + height), ink::chip, 4);
  list.AddText(ImVec2(begin.x + 8, begin.y + 4), ink::text, "curvature toward the light, 1/unit");
  constexpr int steps = 46;
  const float top = begin.y + ImGui::GetTextLineHeight() + 9;
  for (int i = 0; i < steps; ++i) {
    const double value = largest * (2.0 * i / (steps - 1) - 1);
    const float x = begin.x + 8 + static_cast<float>(i) * 4;
    list.AddRectFilled(ImVec2(x, top), ImVec2(x + 4, top + bar),
                       colourOf(curvatureColour(value, largest)));
  }
  const float below = top + bar + 2;
  const std::string high = fmt::format("{:+.3g}", largest);
  list.AddText(ImVec2(begin.x + 8, below), ink::faint, fmt::format("{:+.3g}", -largest).c_str());
  list.AddText(ImVec2(begin.x + 8 + steps * 2 - 4, below), ink::faint, "0");
  list.AddText(ImVec2(begin.x + width - 8 - ImGui::CalcTextSize(high.c_str()).x, below), ink::faint,
               high.c_str());
}

namespace {

ImTextureID textureOf(GLuint name) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the interface passes names of textures so
  return reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(name));
}

/// A part of a picture, from one share of its width to another.
void drawPart(ImDrawList& list, const PaneRectangle& rectangle, const PanePicture& picture,
              double from, double to) {
  if (picture.texture == 0 || !(from < to)) return;
  const Vec2 begin = rectangle.corner + Vec2(from * rectangle.size.x, 0);
  const Vec2 end = rectangle.corner + Vec2(to * rectangle.size.x, rectangle.size.y);
  const float top = picture.topDown ? 0.0F : 1.0F;
  list.AddImage(textureOf(picture.texture), point(begin), point(end),
                ImVec2(static_cast<float>(from), top), ImVec2(static_cast<float>(to), 1 - top));
}

constexpr float chipPadding = 6;

float chipLineHeight() {
  return ImGui::GetTextLineHeight() + 2;
}

Vec2 chipSize(const std::vector<std::string>& lines) {
  float width = 0;
  for (const std::string& line : lines)
    width = std::max(width, ImGui::CalcTextSize(line.c_str()).x);
  return {width + 2 * chipPadding,
          chipLineHeight() * static_cast<float>(lines.size()) + 2 * chipPadding - 2};
}

void drawChip(ImDrawList& list, Vec2 corner, double widest, const std::vector<std::string>& lines,
              bool rightAligned, bool active) {
  const Vec2 whole = chipSize(lines);
  const ImVec2 size = point({std::min(whole.x, widest), whole.y});
  ImVec2 begin = point(corner);
  if (rightAligned) begin.x -= size.x;
  const ImVec2 end(begin.x + size.x, begin.y + size.y);
  list.AddRectFilled(begin, end, ink::chip, 4);
  if (active) list.AddRect(begin, end, ink::line, 4);
  list.PushClipRect(begin, end, true);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    list.AddText(ImVec2(begin.x + chipPadding,
                        begin.y + chipPadding + chipLineHeight() * static_cast<float>(i)),
                 i == 0 ? ink::text : ink::faint, lines[i].c_str());
  }
  list.PopClipRect();
}

std::vector<std::string> labelOf(const ViewSession& session, std::size_t pane, double width) {
  const PaneContent& content = session.state().panes.at(pane);
  const PanePicture& picture = session.pane(pane);
  std::vector<std::string> lines = {titleOf(content, session.state().light)};
  if (!picture.note.empty()) lines.push_back(picture.note);
  if (const auto& figures = picture.figures) {
    const std::string text = figuresText(*figures);
    const std::size_t cut = text.find(": ");
    const auto fits = [&](const std::string& line) {
      return ImGui::CalcTextSize(line.c_str()).x + 2 * chipPadding <= width;
    };
    // A narrow pane has room for the error alone.
    lines.push_back(fits(text) ? text : text.substr(0, cut));
    if (!fits(text) && fits(text.substr(cut + 2))) lines.push_back(text.substr(cut + 2));
  }
  if (picture.note.empty() && needsTruth(content) &&
      !(content.against && content.against->isMethod())) {
    const double share = session.tracedShare(pane);
    if (share < 1) lines.push_back(fmt::format("{:.0f} % of the samples traced", 100 * share));
  }
  return lines;
}

std::string percent(const compare::Metric& metric) {
  return report::percentText(metric.value) + " %";
}

/// "2.41 % wrong", "mean |ΔV| 2.41 %".
std::string errorText(const PaneFigures& figures) {
  const std::string error = percent(figures.errorRate);
  return figures.isSoft ? "mean |ΔV| " + error : error + " wrong";
}

/// The rectangle, dark on bright and bright on dark, with what it tells below it or, where there is
/// no room, in it.
void drawRectangle(ImDrawList& list, const PaneRectangle& pane, const ViewPart& part,
                   const std::vector<std::string>& lines) {
  const PaneRectangle place = placeOf(part, pane);
  const ImVec2 begin = point(place.corner);
  const ImVec2 end = point(place.corner + place.size);
  list.AddRect(begin, end, ink::chip, 0, 0, 4);
  list.AddRect(begin, end, ink::text, 0, 0, 1.5F);
  if (lines.empty()) return;
  const Vec2 size = chipSize(lines);
  const Vec2 paneEnd = pane.corner + pane.size;
  const double below = place.corner.y + place.size.y + 5;
  const bool fitsBelow = below + size.y <= paneEnd.y;
  const Vec2 corner(std::max(pane.corner.x, std::min(place.corner.x, paneEnd.x - size.x)),
                    fitsBelow ? below : paneEnd.y - size.y - 5);
  drawChip(list, corner, pane.size.x, lines, false, true);
}

/// What the rectangle tells of the pane; of two panes, which share one picture, of both.
std::vector<std::string> rectangleLines(const ViewSession& session, std::size_t pane) {
  const ViewState& state = session.state();
  std::vector<std::string> lines;
  const bool isShared = state.paneCount == 2;
  for (std::size_t i = isShared ? 0 : pane; i <= (isShared ? 1 : pane); ++i) {
    const auto& figures = session.pane(i).partFigures;
    if (!figures) continue;
    if (isShared) lines.push_back(titleOf(state.panes.at(i), LightAngles{}));
    for (std::string& line : rectangleText(*figures)) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

void drawPixelText(ViewSession& session, PixelProbe& probe, const WindowLayout& layout,
                   Vec2 cursor) {
  const int pane = paneUnder(layout, cursor, session.state().wipe);
  if (pane < 0) return;
  const Camera& camera = session.state().camera;
  const auto pixel = pixelUnder(cursor, layout.panes.at(static_cast<std::size_t>(pane)),
                                camera.width, camera.height);
  if (!pixel) return;
  const std::vector<std::string> lines = probe.linesOf(session, *pixel);
  if (lines.empty()) return;
  const Vec2 size = chipSize(lines);
  const Vec2 end = layout.pictures.corner + layout.pictures.size;
  constexpr double gap = 14;
  const bool fitsBelow = cursor.y + gap + size.y < end.y;
  const Vec2 corner(std::max(layout.pictures.corner.x, std::min(cursor.x + gap, end.x - size.x)),
                    cursor.y + (fitsBelow ? gap : -gap - size.y));
  drawChip(*ImGui::GetForegroundDrawList(), corner, layout.pictures.size.x, lines, false, true);
}

std::string titleOf(const PaneContent& content, const LightAngles& light) {
  if (content.shown == displacedSurface) return "displaced surface, ray-traced";
  std::string title = sourceText(content.shown);
  if (content.against) title += fmt::format(" \u2212 {}", sourceText(*content.against));
  return light.radius > 0 ? title + ", share V of the light that is seen" : title;
}

std::string figuresText(const PaneFigures& figures) {
  return fmt::format("{}: {} false shadow, {} false light; shadow overlap (IoU) {}",
                     errorText(figures), percent(figures.falseShadow), percent(figures.falseLight),
                     report::correlationText(figures.iou.value));
}

std::vector<std::string> rectangleText(const PaneFigures& figures) {
  if (figures.samples == 0) return {"no traced sample in the rectangle"};
  const std::string samples = fmt::format("{} samples", report::groupedText(figures.samples));
  std::vector<std::string> lines = {
      figures.isSoft ? fmt::format("{}, {}", samples, errorText(figures))
                     : fmt::format("{}, {} wrong: {}", samples,
                                   report::groupedText(static_cast<std::uint64_t>(figures.wrong)),
                                   percent(figures.errorRate)),
      fmt::format("{} false shadow, {} false light", percent(figures.falseShadow),
                  percent(figures.falseLight))};
  if (figures.tracedShare < 1) {
    lines.push_back(fmt::format("{:.0f} % of the samples traced", 100 * figures.tracedShare));
  }
  return lines;
}

void PaneView::upload(const CurvaturePicture& picture) {
  if (width_ != picture.image.width || height_ != picture.image.height) {
    width_ = picture.image.width;
    height_ = picture.image.height;
    curvature_ = render::gl::makeTexture(GL_TEXTURE_2D, GL_RGBA8, {width_, height_}, GL_NEAREST);
  }
  constexpr std::uint8_t opacity = 165;
  std::vector<std::uint8_t> rgba(4 * picture.defined.size());
  for (std::size_t i = 0; i < picture.defined.size(); ++i) {
    std::copy_n(&picture.image.rgb[3 * i], 3, &rgba[4 * i]);
    rgba[4 * i + 3] = picture.defined[i] != 0 ? opacity : 0;
  }
  render::gl::fill(curvature_, {width_, height_}, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

void PaneView::draw(const ViewSession& session, const WindowLayout& layout, int activePane) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ViewState& state = session.state();
  const bool wipes = state.paneCount == 2;
  const auto curvature = state.overlays.curvature ? session.curvature() : nullptr;
  if (curvature != nullptr && curvature != std::exchange(shown_, curvature)) upload(*curvature);
  if (state.paneCount == 4) {  // what shows between them
    list.AddRectFilled(point(layout.pictures.corner),
                       point(layout.pictures.corner + layout.pictures.size), ink::line);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.paneCount); ++i) {
    const PaneRectangle& pane = layout.panes.at(i);
    const double from = wipes && i == 1 ? state.wipe : 0;
    const double to = wipes && i == 0 ? state.wipe : 1;
    drawPart(list, pane, session.pane(i), from, to);
    if (curvature != nullptr) {
      drawPart(list, pane, {curvature_.name(), true, {}, {}}, from, to);
    }
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.paneCount); ++i) {
    const PaneRectangle& pane = layout.panes.at(i);
    const bool right = wipes && i == 1;
    const double room = (wipes ? pane.size.x / 2 : pane.size.x) - 20;
    drawChip(list, pane.corner + Vec2(right ? pane.size.x - 10 : 10, 10), room,
             labelOf(session, i, room), right,
             state.paneCount > 1 && static_cast<int>(i) == activePane);
    if (state.panes.at(i).isDifference()) {
      drawDifferenceLegend(list, pane, state.light.radius > 0, right);
    }
  }
  if (wipes) {
    const Vec2 top = layout.pictures.corner + Vec2(state.wipe * layout.pictures.size.x, 0);
    list.AddLine(point(top), point(top + Vec2(0, layout.pictures.size.y)), ink::text, 2);
    list.AddCircleFilled(point(top + Vec2(0, layout.pictures.size.y / 2)), 9, ink::chip);
    list.AddCircle(point(top + Vec2(0, layout.pictures.size.y / 2)), 9, ink::text, 0, 2);
  }
  for (std::size_t i = 0; state.part && i < static_cast<std::size_t>(state.paneCount); ++i) {
    if (wipes && i == 1) break;
    drawRectangle(list, layout.panes.at(i), *state.part, rectangleLines(session, i));
  }
  if (curvature != nullptr) drawCurvatureLegend(list, layout.pictures, curvature->largest);
}

}  // namespace gnomon::app
