#include "viewer/session/pixel_probe.h"

#include <fmt/core.h>

#include <string_view>

#include "model/cross_section.h"
#include "truth/shadow_tracer.h"
#include "truth/surface_paths.h"

namespace gnomon::app {
namespace {

std::string answerText(const Mask& mask, std::size_t i) {
  if (!isAnswer(mask.samples[i])) return "?";
  return mask.samples[i] == Shade::lit ? "lit" : "in shadow";
}

std::string answerText(const Visibility& map, std::size_t i) {
  return isAnswer(map.shares[i]) ? fmt::format("V = {:.3f}", map.shares[i]) : "?";
}

/// What it means that a sample lies in a region.
std::string_view meaningOf(truth::Region region) {
  switch (region) {
    case truth::Region::none:
      return "";
    case truth::Region::lit:
      return "the light reaches it";
    case truth::Region::attached:
      return "its own slope faces away from the light";
    case truth::Region::cast:
      return "a bump nearby is in the way";
    case truth::Region::distant:
      return "a bump beyond the search radius is in the way";
    case truth::Region::beyondTerminator:
      return "the smooth surface faces away from the light";
    case truth::Region::global:
      return "another part of the body is in the way";
  }
  return "";
}

double degreesOfSlope(double slope) {
  return CrossSection::angle(slope) * 180 / pi;
}

/// Each source that a pane shows or compares, once, and last the truth.
std::vector<PaneSource> sourcesOf(const ViewState& state) {
  std::vector<PaneSource> sources;
  for (const std::string& label : shownMethods(state)) sources.push_back(methodSource(label));
  sources.push_back(tracedTruth);
  return sources;
}

}  // namespace

truth::Region PixelProbe::regionOf(const ViewSession& session,
                                   const surface::SurfaceSample& sample) {
  const SceneData& scene = *session.scene();
  const TracedMesh* traced = session.traced();
  if (traced == nullptr) return truth::Region::none;
  const relief::Relief& relief = scene.study->relief;
  const truth::TraceSettings light{makeLight(session.state().light)};
  const surface::SampleGrid one{1, 1, {sample}};
  truth::Truth truth =
      truth::traceShadows(*scene.surface, relief, traced->mesh, traced->scene, one, light);
  if (truth::isCastShadow(truth.regions.front())) {
    if (!paths_ || pathsOf_ != scene.keys.surface) paths_.emplace(*scene.surface);
    pathsOf_ = scene.keys.surface;
    truth::splitCastShadows(*scene.surface, relief, traced->mesh, traced->scene, *paths_,
                            {scene.study->bake.settings.radiusTexels}, one, {&light, 1},
                            {&truth, 1});
  }
  return truth.regions.front();
}

std::vector<std::string> PixelProbe::linesOf(ViewSession& session, ViewPixel pixel) {
  const surface::SampleGrid* samples = session.samples();
  const SceneData* scene = session.scene();
  const auto sample =
      samples != nullptr && scene != nullptr ? sampleUnder(*samples, pixel) : std::nullopt;
  if (!sample || sample->face >= scene->surface->faceCount()) return {};
  const auto place =
      static_cast<std::size_t>(pixel.row) * static_cast<std::size_t>(samples->width) +
      static_cast<std::size_t>(pixel.column);
  std::vector<std::string> lines;
  for (const PaneSource& source : sourcesOf(session.state())) {
    const Answers* found = session.answersOf({source});
    const std::string answer =
        found == nullptr
            ? "?"
            : std::visit([&](const auto& map) { return answerText(map, place); }, *found);
    lines.push_back(fmt::format("{}: {}", sourceText(source), answer));
  }
  const truth::Region region = regionOf(session, *sample);
  if (region != truth::Region::none) {
    lines.push_back(fmt::format("region {}: {}", truth::regionName(region), meaningOf(region)));
  }
  const auto section = crossSection(*scene->surface, scene->study->relief, *sample,
                                    makeLight(session.state().light).direction,
                                    {scene->study->bake.settings.radiusTexels, 0});
  if (!section) return lines;
  lines.push_back(fmt::format("horizon {:.1f}° over the surface, light {:.1f}°",
                              degreesOfSlope(section->here.flat.slope),
                              degreesOfSlope(section->lightSlope)));
  lines.push_back(fmt::format("height {:.3g}", section->here.lookups.height));
  return lines;
}

}  // namespace gnomon::app
