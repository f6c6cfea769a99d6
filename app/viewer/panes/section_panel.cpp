#include "viewer/panes/section_panel.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "truth/visibility_tracer.h"
#include "viewer/panes/gui.h"

namespace gnomon::app {
namespace {

constexpr ImU32 reliefColour = IM_COL32(120, 98, 70, 255);
constexpr ImU32 reliefFill = IM_COL32(214, 198, 176, 255);
constexpr ImU32 groundColour = IM_COL32(120, 124, 132, 255);
constexpr ImU32 rayColour = IM_COL32(224, 160, 0, 255);
constexpr ImU32 discColour = IM_COL32(250, 196, 40, 110);
constexpr ImU32 flatColour = IM_COL32(26, 110, 220, 255);
constexpr ImU32 correctedColour = IM_COL32(208, 70, 0, 255);
constexpr ImU32 truthColour = IM_COL32(20, 130, 70, 255);

/// A plot in world units of the section's plane, the same scale on both axes.
class Plot {
 public:
  Plot(ImDrawList& list, ImVec2 begin, ImVec2 end, Vec2 low, Vec2 high)
      : list_(list), begin_(begin), end_(end) {
    const Vec2 room(end.x - begin.x, end.y - begin.y);
    const Vec2 span = glm::max(high - low, Vec2(1e-9));
    scale_ = std::min(room.x / span.x, room.y / span.y);
    const Vec2 middle = (low + high) / 2.0;
    offset_ = Vec2(begin.x, begin.y) + room / 2.0 - Vec2(scale_, -scale_) * middle;
  }

  [[nodiscard]] ImVec2 at(Vec2 place) const {
    const Vec2 pixel = offset_ + Vec2(scale_, -scale_) * place;
    return {static_cast<float>(pixel.x), static_cast<float>(pixel.y)};
  }
  void curve(const std::vector<Vec2>& points, ImU32 colour, float width) const {
    std::vector<ImVec2> pixels;
    pixels.reserve(points.size());
    for (const Vec2& place : points) pixels.push_back(at(place));
    list_.AddPolyline(pixels.data(), static_cast<int>(pixels.size()), colour, 0, width);
  }
  /// Fills between a curve and the plot's lower border.
  void fill(const std::vector<Vec2>& points, ImU32 colour) const {
    // Smoothed edges would show as seams between the pieces.
    const ImDrawListFlags flags = list_.Flags;
    list_.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const ImVec2 a = at(points[i - 1]);
      const ImVec2 b = at(points[i]);
      list_.AddQuadFilled(a, b, ImVec2(b.x, end_.y), ImVec2(a.x, end_.y), colour);
    }
    list_.Flags = flags;
  }
  /// A ray that starts at a place and leaves the plot.
  void ray(Vec2 from, Vec2 direction, ImU32 colour, float width) const {
    const double length = 2 * Vec2(end_.x - begin_.x, end_.y - begin_.y).x / scale_;
    list_.AddLine(at(from), at(from + length * glm::normalize(direction)), colour, width);
  }
  /// What lies between two rays from a place.
  void wedge(Vec2 from, Vec2 one, Vec2 other, ImU32 colour) const {
    const double length = 2 * Vec2(end_.x - begin_.x, end_.y - begin_.y).x / scale_;
    list_.AddTriangleFilled(at(from), at(from + length * one), at(from + length * other), colour);
  }
  void dot(Vec2 place, ImU32 colour, float radius = 4) const {
    list_.AddCircleFilled(at(place), radius, colour);
  }

 private:
  ImDrawList& list_;
  ImVec2 begin_, end_;
  double scale_ = 1;
  Vec2 offset_{0, 0};
};

/// Figure 1: the flat relief along the light.
std::vector<Vec2> flatRelief(const CrossSection& section) {
  std::vector<Vec2> points;
  points.reserve(section.profile.points.size());
  for (const horizon::ProfilePoint& place : section.profile.points) {
    points.emplace_back(place.distance * section.worldPerTexel,
                        place.height * section.worldPerHeight);
  }
  return points;
}

/// The part of a curve that is worth showing: somewhat beyond all that happens on it.
double reachOf(const CrossSection& section, const std::optional<truth::Occluder>& occluder) {
  double reach =
      std::max(section.horizon.distance * section.worldPerTexel, 12 * section.worldPerTexel);
  if (occluder && !occluder->attached) {
    reach = std::max(reach, section.inPlane(occluder->point).x);
  }
  return 1.6 * reach;
}

std::vector<Vec2> upTo(const std::vector<Vec2>& points, double reach) {
  std::vector<Vec2> kept;
  for (const Vec2& place : points) {
    if (place.x <= reach) kept.push_back(place);
  }
  return kept;
}

std::pair<Vec2, Vec2> boundsOf(const std::vector<Vec2>& points, Vec2 eye) {
  Vec2 low = eye;
  Vec2 high = eye;
  for (const Vec2& place : points) {
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  const double margin = 0.12 * std::max(high.x - low.x, high.y - low.y);
  return {low - Vec2(0, margin), high + Vec2(0, margin)};
}

std::string degrees(double slope) {
  if (std::isinf(slope) && slope < 0) return "none";
  return fmt::format("{:.1f}°", CrossSection::angle(slope) * 180 / pi);
}

/// What a formula says: of a light's disc the share that is seen.
std::string verdict(const CrossSection& section, bool shadowed, double share) {
  if (section.lightRadius > 0) return fmt::format("V = {:.3f}", share);
  return shadowed ? "in shadow" : "lit";
}

/// The light's rays: of a disc its lowest and highest, and what lies between them.
void drawLight(const Plot& plot, const CrossSection& section, Vec2 eye) {
  if (section.lightRadius > 0) {
    plot.wedge(eye, section.lowestRay, section.highestRay, discColour);
    plot.ray(eye, section.lowestRay, rayColour, 1);
    plot.ray(eye, section.highestRay, rayColour, 1);
  } else {
    plot.ray(eye, section.lightDirection, rayColour, 2);
  }
}

std::string lightText(const CrossSection& section) {
  std::string centre = fmt::format("light {}", degrees(section.lightSlope));
  if (!(section.lightRadius > 0)) return centre;
  return fmt::format("{} ± {:.4g}°", centre, section.lightRadius * 180 / pi);
}

/// A figure with its title (the number alone where there is no room for more): the relief as it
/// lies in the figure, what `draw` puts on its plot, and the shaded point.
template <typename Draw>
void drawFigure(ImDrawList& list, ImVec2 begin, ImVec2 end, const std::string& title,
                const std::vector<Vec2>& relief, Vec2 eye, const Draw& draw) {
  const bool fits = ImGui::CalcTextSize(title.c_str()).x <= end.x - begin.x - 2;
  list.AddText(ImVec2(begin.x + 2, begin.y - 23), ink::text,
               fits ? title.c_str() : title.substr(0, title.find(':')).c_str());
  const auto [low, high] = boundsOf(relief, eye);
  list.PushClipRect(begin, end, true);
  const Plot plot(list, begin, end, low, high);
  plot.fill(relief, reliefFill);
  plot.curve(relief, reliefColour, 1.5F);
  draw(plot);
  plot.dot(eye, ink::text);
  list.PopClipRect();
}

struct Entry {
  ImU32 colour;  ///< 0 for what is not drawn
  std::string text;
};

void drawEntries(ImDrawList& list, ImVec2 at, const std::vector<Entry>& entries) {
  const float line = ImGui::GetTextLineHeight() + 3;
  for (const Entry& entry : entries) {
    if (entry.colour != 0) {
      list.AddRectFilled(ImVec2(at.x, at.y + 5), ImVec2(at.x + 12, at.y + 9), entry.colour);
    }
    list.AddText(ImVec2(at.x + 18, at.y - 1), ink::text, entry.text.c_str());
    at.y += line;
  }
}

/// V at one sample by all of the study's directions.
double shareAt(const TracedMesh& traced, const surface::SurfaceSample& sample, const Light& light,
               const study::StudySpec& study) {
  constexpr bool isAdaptive = false;
  return static_cast<double>(
      truth::traceVisibility(traced.mesh, traced.scene, {1, 1, {sample}}, {1, 1, {Shade::lit}},
                             {light, study.truth.directions, truth::standardRayOffset, isAdaptive})
          .shares.front());
}

}  // namespace

void SectionPanel::find(const ViewSession& session, const WindowLayout& layout, Vec2 cursor) {
  const surface::SampleGrid* samples = session.samples();
  const SceneData* scene = session.scene();
  if (samples == nullptr || scene == nullptr) return;
  Key key = key_;
  key.serial = session.serial();
  const TracedMesh* traced = session.traced();
  key.traced = traced != nullptr ? std::optional(traced->key) : std::nullopt;
  const int pane = paneUnder(layout, cursor, session.state().wipe);
  if (pane >= 0) {
    const auto pixel = pixelUnder(cursor, layout.panes.at(static_cast<std::size_t>(pane)),
                                  samples->width, samples->height);
    const auto sample = pixel ? sampleUnder(*samples, *pixel) : std::nullopt;
    if (sample) {
      key.face = sample->face;
      key.s = sample->s;
      key.t = sample->t;
      pixel_ = cursor;
    }
  }
  if (key == key_ || key.face < 0) return;
  if (key.face >= scene->surface->faceCount()) return;
  key_ = key;
  const surface::SurfaceSample sample{key.face, key.s, key.t};
  const Light spec = makeLight(session.state().light);
  const Vec3 light = spec.direction;
  const double radius = scene->study->bake.settings.radiusTexels;
  std::optional<SectionTables> tables;
  for (const auto& [label, method] : scene->methods) {
    if (!method->tables || tables) continue;
    const TableImage& image = method->tables->horizon;
    tables.emplace(SectionTables{image.values, method->tables->distance.values, image.shape});
  }
  section_ = crossSection(*scene->surface, scene->study->relief, sample, light,
                          {radius, 8, spec.radius}, tables ? &*tables : nullptr);
  occluder_.reset();
  if (traced != nullptr) {
    occluder_ = truth::firstOccluder(*scene->surface, scene->study->relief, traced->mesh,
                                     traced->scene, {sample, light, truth::standardRayOffset});
    if (spec.isSoft()) tracedShare_ = shareAt(*traced, sample, spec, *scene->study);
  }
}

void SectionPanel::draw(const ViewSession& session, const WindowLayout& layout, Vec2 cursor) {
  find(session, layout, cursor);
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const float left = static_cast<float>(layout.section.corner.x);
  const float upper = static_cast<float>(layout.section.corner.y);
  const float room = static_cast<float>(layout.section.size.x);
  const float width = std::min(room, 900.0F);
  const ImVec2 begin(left + (room - width) / 2, upper);
  const ImVec2 end(begin.x + width, upper + static_cast<float>(layout.section.size.y));
  list.AddRectFilled(ImVec2(left, upper), ImVec2(left + room, end.y), IM_COL32(255, 255, 255, 255));
  list.AddLine(ImVec2(left, upper), ImVec2(left + room, upper), ink::line);
  if (!section_) {
    list.AddText(ImVec2(begin.x + 14, begin.y + 12), ink::faint,
                 "Cross-section: move the cursor over the surface");
    return;
  }
  const CrossSection& section = *section_;
  list.AddCircle(ImVec2(static_cast<float>(pixel_.x), static_cast<float>(pixel_.y)), 6, ink::text,
                 0, 2);
  const float column = (width - 262) / 2;
  const float top = begin.y + 32;
  const float bottom = end.y - 12;
  const double reach = reachOf(section, occluder_);
  const auto& corrected = section.fromTables ? *section.fromTables : section.here;
  const auto slopeRay = [](double slope) { return Vec2(1, slope); };

  const Vec2 flatEye(0, section.here.lookups.height);
  drawFigure(list, ImVec2(begin.x + 12, top), ImVec2(begin.x + column, bottom),
             "Figure 1: the relief laid flat", upTo(flatRelief(section), reach), flatEye,
             [&](const Plot& plot) {
               drawLight(plot, section, flatEye);
               plot.ray(flatEye, slopeRay(section.here.flat.slope), flatColour, 1.5F);
               const double arc = section.horizon.distance * section.worldPerTexel;
               plot.dot(flatEye + arc * Vec2(1, section.here.lookups.slope), flatColour);
             });
  const double best = std::max(corrected.smallAngle.slope, corrected.bare.slope);
  drawFigure(list, ImVec2(begin.x + column + 12, top), ImVec2(begin.x + 2 * column, bottom),
             "Figure 2: bent onto the osculating circle", upTo(section.bentRelief, reach),
             section.eye, [&](const Plot& plot) {
               plot.curve(upTo(section.bentGround, reach), groundColour, 1);
               drawLight(plot, section, section.eye);
               plot.ray(section.eye, slopeRay(section.here.flat.slope), flatColour, 1);
               if (std::isfinite(best)) {
                 plot.ray(section.eye, slopeRay(best), correctedColour, 1.5F);
               }
               plot.dot(section.horizonPoint, flatColour);
               if (occluder_ && !occluder_->attached) {
                 plot.dot(section.inPlane(occluder_->point), truthColour);
               }
             });

  const std::string truth = !session.traced() ? "truth: not traced yet"
                            : section.lightRadius > 0
                                ? fmt::format("truth: V = {:.3f}", tracedShare_)
                            : !occluder_          ? "truth: lit"
                            : occluder_->attached ? "truth: in shadow by its own slope"
                                                  : "truth: in shadow of the green dot";
  drawEntries(list, ImVec2(begin.x + 2 * column + 18, top),
              {{rayColour, lightText(section)},
               {flatColour,
                fmt::format("flat horizon {}: {}", degrees(section.here.flat.slope),
                            verdict(section, section.here.flat.shadowed, section.here.flat.share))},
               {correctedColour,
                fmt::format("onoue-2004 {}: {}", degrees(best),
                            verdict(section, corrected.onoue2004, corrected.onoue2004Share))},
               {0, fmt::format("its formulas (2) {}, (3) {}", degrees(corrected.smallAngle.slope),
                               degrees(corrected.bare.slope))},
               {0, fmt::format("exact formula {}: {}", degrees(corrected.exact.slope),
                               verdict(section, corrected.onoueExact, corrected.onoueExactShare))},
               {truthColour, truth}});
  const ImVec2 notes(begin.x + 2 * column + 18, bottom - 3 * (ImGui::GetTextLineHeight() + 3));
  list.AddText(
      notes, ink::faint,
      fmt::format("curvature κ {:+.4g}, height h {:.3g}\nhorizon point d = {:.3g} texels away\n{}",
                  section.curvature, section.here.lookups.height, section.horizon.distance,
                  section.fromTables ? "horizon read from the tables" : "horizon computed exactly")
          .c_str());
}

}  // namespace gnomon::app
