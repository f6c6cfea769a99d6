#include "study/run/notices.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "compare/answer_metrics.h"
#include "horizon/search_radius.h"
#include "relief/relief.h"
#include "study/run/scene/run_keys.h"
#include "surface/closed_surface.h"
#include "surface/face_grids.h"
#include "truth/visibility_tracer.h"

namespace gnomon::study {
namespace {

/// The largest number of pieces that a base mesh may have.
constexpr int mostPieces = 1024;

/// The key that makes the truth finer, with a value that about halves its uncertainty or more.
std::string finerTruth(const StudySpec& study, const TruthRecord& truth) {
  constexpr double quickFactor = 4;
  const double factor = study.quick ? quickFactor : 1;
  const std::string change =
      fmt::format("truth.step = {:g} (now {:g})", truth.askedStepTexels / factor / 2,
                  truth.askedStepTexels / factor);
  return study.quick ? "Leave out --quick; or set " + change : "Set " + change;
}

/// One a light, over all views.
std::vector<LightCount> countsOf(const BaseCase& base, std::size_t lights) {
  std::vector<LightCount> counts(lights);
  for (const ViewCase& view : base.views) {
    for (std::size_t l = 0; l < lights; ++l) {
      const auto& samples = view.truths[l].mask.samples;
      const auto count = [&](Shade shade) {
        return static_cast<std::size_t>(std::count(samples.begin(), samples.end(), shade));
      };
      counts[l].lit += count(Shade::lit);
      counts[l].shadowed += count(Shade::shadowed);
      const auto& regions = view.truths[l].regions;
      counts[l].turned += static_cast<std::size_t>(
          std::count(regions.begin(), regions.end(), truth::Region::beyondTerminator));
    }
  }
  return counts;
}

/// Of a light's samples.
double shareOf(std::size_t some, const LightCount& count) {
  const std::size_t all = count.shadowed + count.lit;
  return all > 0 ? static_cast<double>(some) / static_cast<double>(all) : 0;
}

/// A share in percent, "2.53" or "0.00012".
std::string shareText(double share) {
  return fmt::format("{:.3g}", 100 * share);
}

/// "a"; of several "“a”, “b”", since labels may hold commas.
std::string labelsText(const std::vector<std::string>& labels) {
  if (labels.size() == 1) return labels.front();
  return fmt::format("“{}”", fmt::join(labels, "”, “"));
}

}  // namespace

std::optional<std::string> uncertaintyNotice(const StudySpec& study, const TruthRecord& truth) {
  if (truth.uncertainty <= mostUncertainty) return std::nullopt;
  return fmt::format(
      "The truth itself is uncertain by up to {:.2g} % of the samples, more than {:g} %: smaller "
      "errors and differences mean nothing. {}.",
      100 * truth.uncertainty, 100 * mostUncertainty, finerTruth(study, truth));
}

std::vector<std::string> lightNotices(const StudySpec& study, std::span<const LightCount> counts) {
  constexpr double nearlyAll = 0.999;
  std::vector<std::string> below;
  std::vector<std::string> dark;
  std::vector<std::string> bright;
  for (std::size_t l = 0; l < counts.size(); ++l) {
    const LightCount& count = counts[l];
    const double turned = shareOf(count.turned, count);
    const double shadowed = shareOf(count.shadowed, count);
    std::vector<std::string>* list = turned >= nearlyAll         ? &below
                                     : shadowed >= nearlyAll     ? &dark
                                     : shadowed <= 1 - nearlyAll ? &bright
                                                                 : nullptr;
    if (list != nullptr) list->push_back(study.lights.at(l).name);
  }
  std::vector<std::string> notices;
  const auto add = [&](const std::vector<std::string>& lights, const std::string& what,
                       const char* advice) {
    if (lights.empty()) return;
    notices.push_back(fmt::format("Under {} {}: figures there rank no method. {}.",
                                  labelsText(lights), what, advice));
  };
  const std::string most = fmt::format("at least {:g} % of the samples are", 100 * nearlyAll);
  add(below, "the whole surface is turned from the light, which is below its horizon",
      "Raise `light.elevation`");
  add(dark, most + " shadowed in the truth", "Raise `light.elevation`");
  add(bright, most + " lit in the truth", "Lower `light.elevation`, or raise `relief.height`");
  return notices;
}

std::optional<std::string> quickNotice(const StudySpec& study) {
  if (!study.quick) return std::nullopt;
  return "These figures are of the quick form, --quick: a quarter of the picture's width and "
         "height, a coarser truth, no frame times. They are not final: leave out --quick for "
         "figures to be used.";
}

std::optional<std::string> wrapNotice(const StudySpec& study,
                                      const surface::LimitSurface& surface) {
  const relief::HeightField& field = study.relief.field;
  const bool isBlind = field.wrap() == relief::Wrap::repeat && field.border() == relief::Border{} &&
                       study.radius.bound != horizon::RadiusBound::stated &&
                       !surface::isClosed(surface);
  if (!isBlind) return std::nullopt;
  relief::Relief clamped = study.relief;
  clamped.field =
      relief::HeightField(field.width(), field.height(), field.texels(), relief::Wrap::clamp)
          .withBorder(
              relief::borderOf(study.cage, surface, relief::Wrap::clamp, study.relief.repeats));
  std::vector<Vec3> lights;
  for (const Light& light : study.lights) lights.push_back(truth::lowestOfDisc(light));
  const double shorter = horizon::searchRadius(surface, clamped, lights).texels;
  constexpr double muchLonger = 2;
  if (!(study.radius.texels > muchLonger * shorter)) return std::nullopt;
  return fmt::format(
      "The map repeats past the border of an open surface, so that tables and marches search {:g} "
      "texels far; with relief.wrap = \"clamp\" {:g} suffice.",
      study.radius.texels, shorter);
}

std::optional<std::string> coarsePiecesNotice(const std::string& method, int pieces,
                                              double longestEdgeTexels, bool isOfLight) {
  const double longest = longestEdgeTexels / pieces;
  if (!(longest > longestPieceTexels)) return std::nullopt;
  const double enough = std::ceil(longestEdgeTexels - 1e-9);
  return fmt::format(
      "{}: the pieces of the displaced mesh{}, {} a side of each face, are up to {:.2g} texels "
      "long: too coarse for the map. {}.",
      method, isOfLight ? " that the light sees" : "", pieces, longest,
      enough <= mostPieces
          ? fmt::format("Set {} = {:.0f} for pieces of at most 1 texel",
                        isOfLight ? "parameters.light_pieces" : "base.subdivisions", enough)
          : fmt::format("Use a surface of more faces: at most {} pieces are possible", mostPieces));
}

std::optional<std::string> insideOutNotice(const surface::LimitSurface& surface,
                                           double shadowShare) {
  constexpr double nearlyAll = 0.99;
  if (!(shadowShare > nearlyAll) || !surface::isClosed(surface) ||
      surface::enclosedVolume(surface) >= 0) {
    return std::nullopt;
  }
  return fmt::format(
      "The surface is closed and turned inside out, and {:.4g} % of the samples are shadowed: its "
      "faces run clockwise seen from outside. Reverse the order of every face's corners.",
      100 * shadowShare);
}

std::optional<std::string> overlapNotice(const surface::TextureLayout& layout) {
  if (layout.isOneToOne) return std::nullopt;
  return fmt::format(
      "Charts of the texture overlap: {} % of the surface's area shares its texels with another "
      "part. Both parts have the same relief, and a map with one point of the surface a texel is "
      "right for one of them.",
      shareText(layout.sharedArea));
}

std::optional<std::string> otherChartNotice(std::span<const MethodRecord> methods) {
  std::vector<std::string> parts;
  for (const MethodRecord& method : methods) {
    if (method.otherChartShare.value_or(0) == 0) continue;
    parts.push_back(fmt::format("“{}” at {} % of the samples", method.label,
                                shareText(*method.otherChartShare)));
  }
  if (parts.empty()) return std::nullopt;
  return fmt::format(
      "Texels of another chart are left out of methods' maps of the surface, and they fall back to "
      "what they know without: {}.",
      fmt::join(parts, ", "));
}

std::optional<std::string> joinedNotice(const surface::Cage& cage) {
  const auto [vertices, apartEdges] = cage.joined;
  std::string text;
  if (vertices > 0) {
    text = fmt::format(
        "{} of the mesh file {} in the same place as another, where faces meet, and {} joined with "
        "it: the surface continues there.",
        vertices == 1 ? "1 vertex" : fmt::format("{} vertices", vertices),
        vertices == 1 ? "lies" : "lie", vertices == 1 ? "was" : "were");
  }
  if (apartEdges > 0) {
    text += fmt::format(
        "{}At {} {} of the mesh file the surface does not continue: more than two faces meet there "
        "that share no vertices, or two that run along it in the same direction.",
        text.empty() ? "" : " ", apartEdges, apartEdges == 1 ? "edge" : "edges");
  }
  return text.empty() ? std::nullopt : std::optional(text);
}

std::optional<std::string> outsideMapNotice(const StudySpec& study) {
  // Of a built-in shape the study itself says how much of it the map covers.
  if (study.cage.grid) return std::nullopt;
  const auto [all, outside] = facesOfMap(study.cage, study.relief);
  if (outside == 0) return std::nullopt;
  return fmt::format(
      "{} of {} faces have texture coordinates outside the map, where wrap = \"clamp\" only "
      "continues its border: no relief is there.",
      outside, all);
}

std::string givenNotice(const std::string& method) {
  return fmt::format(
      "{}: another program drew the masks. They have no frame time and no memory here, and the "
      "answer \"test\" is the picture.",
      method);
}

std::optional<std::string> invertedMasksNotice(const StudySpec& study, const MethodCase& method) {
  std::optional<std::string> first;
  std::size_t more = 0;
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    const ViewCase& view = method.base->views[v];
    for (std::size_t l = 0; l < study.lights.size(); ++l) {
      const GivenMask& given = maskOf(method.given, study, v, l);
      const truth::Truth& truth = view.truths[l];
      const Mask cut = truth.isSoft() ? cutInHalf(given.shares) : given.mask;
      if (!compare::answersAllOf(truth.mask, cut)) continue;  // is refused where it is measured
      auto notice = compare::invertedNotice(
          truth.isSoft() ? compare::commonPixels(given.shares, truth.visibility, nullptr)
                         : compare::commonPixels(given.mask, truth.mask, nullptr),
          view.weights);
      if (!notice) continue;
      if (first) {
        ++more;
      } else {
        first =
            fmt::format("{}: {}: {}", method.spec->label, given.path.filename().string(), *notice);
      }
    }
  }
  if (more > 0) *first += fmt::format(" {} more of its masks are so.", more);
  return first;
}

std::optional<std::string> softNotice(const StudySpec& study) {
  const auto isSoft = [](const Light& light) { return light.isSoft(); };
  const auto first = std::find_if(study.lights.begin(), study.lights.end(), isSoft);
  if (first == study.lights.end()) return std::nullopt;
  const bool areAll = std::all_of(study.lights.begin(), study.lights.end(), isSoft);
  return fmt::format(
      "{}: each sample is compared by V, the share of the disc that it sees, traced toward {} "
      "directions. There an error of 1 % means that V is off by 0.01 on average; false shadow is V "
      "too small, false light V too large. Boundaries and lengths are those of both maps cut at "
      "V < 0.5.",
      areAll ? "The lights are discs" : "Some of the lights are discs", study.truth.directions);
}

std::optional<std::string> cameraNotice(const StudySpec& study, const std::string& label,
                                        const render::Method& method) {
  // Of shadow volumes the table of views says enough.
  if (!method.needsCamera() || method.passes.shadowVolumes) return std::nullopt;
  std::vector<std::string> atlases;
  for (const ViewSpec& view : study.views) {
    if (cameraOf(view) == nullptr) atlases.push_back(fmt::format("\"{}\"", view.name));
  }
  if (atlases.empty()) return std::nullopt;
  return fmt::format("{} {}: it is left out of {}.", label, cameraReason(method),
                     fmt::join(atlases, ", "));
}

std::vector<std::string> noticesOf(RunScene& scene, const TruthRecord& truth,
                                   std::span<const MethodCase> methods) {
  std::vector<std::string> notices;
  const auto add = [&](std::optional<std::string> notice) {
    if (notice) notices.push_back(std::move(*notice));
  };
  add(quickNotice(scene.study));
  const std::vector<LightCount> counts = countsOf(scene.standardBase(), scene.study.lights.size());
  LightCount all;
  for (const LightCount& count : counts) {
    all.lit += count.lit;
    all.shadowed += count.shadowed;
  }
  const std::optional<std::string> insideOut =
      insideOutNotice(scene.surface, shareOf(all.shadowed, all));
  add(insideOut);
  if (!insideOut) {
    for (std::string& notice : lightNotices(scene.study, counts)) add(std::move(notice));
  }
  add(wrapNotice(scene.study, scene.surface));
  add(joinedNotice(scene.study.cage));
  add(outsideMapNotice(scene.study));
  add(uncertaintyNotice(scene.study, truth));
  add(softNotice(scene.study));
  add(overlapNotice(*scene.layout));
  std::vector<std::string> given;
  // Labels by the pieces of their mesh, and whether the light alone sees it.
  std::map<std::pair<int, bool>, std::vector<std::string>> ofPieces;
  std::optional<double> longestEdge;
  for (const MethodCase& method : methods) {
    if (method.isGiven()) {
      given.push_back(method.spec->label);
      add(invertedMasksNotice(scene.study, method));
    }
    add(cameraNotice(scene.study, method.spec->label, method.method));
    const std::optional<MeshChoice> ofLight = lightMeshOf(*method.spec, method.method);
    const MeshChoice& mesh = ofLight ? *ofLight : method.base->choice;
    if (method.isGiven() || mesh.kind != render::DrawnMesh::displaced) continue;
    if (!longestEdge) {
      // A resampled map is the same relief: its features are as wide as the texels before.
      const relief::Relief& relief = scene.study.relief;
      longestEdge =
          surface::longestEdgeTexels(scene.surface, relief.texelsPerUv()) / relief.resample;
    }
    ofPieces[{mesh.base.subdivisions, ofLight.has_value()}].push_back(method.spec->label);
  }
  if (!given.empty()) add(givenNotice(labelsText(given)));
  for (const auto& [mesh, labels] : ofPieces) {
    add(coarsePiecesNotice(labelsText(labels), mesh.first, *longestEdge, mesh.second));
  }
  return notices;
}

}  // namespace gnomon::study
