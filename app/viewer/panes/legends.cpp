#include "viewer/panes/legends.h"

#include <fmt/core.h>

#include <array>
#include <utility>

#include "image/images.h"
#include "image/share_picture.h"
#include "model/field_lines.h"
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

}  // namespace gnomon::app
