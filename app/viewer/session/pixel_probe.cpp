#include "viewer/session/pixel_probe.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "model/cross_section.h"
#include "truth/global_occluder.h"
#include "truth/shadow_tracer.h"

namespace gnomon::app {
namespace {

std::string answerText(const Mask& mask, std::size_t i) {
  if (!isAnswer(mask.samples[i])) return "?";
  return mask.samples[i] == Shade::lit ? "lit" : "shadow";
}

std::string answerText(const Visibility& map, std::size_t i) {
  return isAnswer(map.shares[i]) ? fmt::format("V {:.3f}", map.shares[i]) : "?";
}

/// Each source that a pane shows or compares, once, and last the truth.
std::vector<PaneSource> sourcesOf(const ViewState& state) {
  std::vector<PaneSource> sources;
  for (const std::string& label : shownMethods(state)) sources.push_back(methodSource(label));
  sources.push_back(tracedTruth);
  return sources;
}

}  // namespace

std::string PixelProbe::regionOf(const ViewSession& session, const surface::SurfaceSample& sample) {
  const SceneData& scene = *session.scene();
  const TracedMesh* traced = session.traced();
  if (traced == nullptr) return "";
  const relief::Relief& relief = scene.study->relief;
  const truth::TraceSettings light{lightSpec(session.state().light).direction(),
                                   scene.study->bake.settings.radiusTexels,
                                   truth::standardRayOffset};
  const surface::SampleGrid one{1, 1, {sample}};
  truth::Truth truth =
      truth::traceShadows(*scene.surface, relief, traced->mesh, traced->scene, one, light);
  if (truth::isCastShadow(truth.regions.front())) {
    if (!paths_ || pathsOf_ != scene.keys.surface) paths_.emplace(*scene.surface);
    pathsOf_ = scene.keys.surface;
    truth::markGlobal(*scene.surface, relief, traced->mesh, traced->scene, *paths_,
                      scene.study->cage.limitFaceParts(), one, {&light, 1}, {&truth, 1});
  }
  return fmt::format(": {}", truth::regionName(truth.regions.front()));
}

std::string PixelProbe::textOf(ViewSession& session, ViewPixel pixel) {
  const surface::SampleGrid* samples = session.samples();
  const SceneData* scene = session.scene();
  const auto sample =
      samples != nullptr && scene != nullptr ? sampleUnder(*samples, pixel) : std::nullopt;
  if (!sample || sample->face >= scene->surface->faceCount()) return "";
  const auto place =
      static_cast<std::size_t>(pixel.row) * static_cast<std::size_t>(samples->width) +
      static_cast<std::size_t>(pixel.column);
  std::vector<std::string> answers;
  for (const PaneSource& source : sourcesOf(session.state())) {
    const Answers* found = session.answersOf({source});
    const std::string answer =
        found == nullptr
            ? "?"
            : std::visit([&](const auto& map) { return answerText(map, place); }, *found);
    answers.push_back(fmt::format("{} {}", sourceText(source), answer));
  }
  std::string text = fmt::format("{}{}", fmt::join(answers, ", "), regionOf(session, *sample));
  const auto section = crossSection(*scene->surface, scene->study->relief, *sample,
                                    lightSpec(session.state().light).direction(),
                                    {scene->study->bake.settings.radiusTexels, 0});
  if (!section) return text;
  return text + fmt::format("; horizon slope {:.3f}, height {:.3g}", section->here.flat.slope,
                            section->here.lookups.height);
}

}  // namespace gnomon::app
