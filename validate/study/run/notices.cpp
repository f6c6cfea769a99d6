#include "study/run/notices.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "compare/mask_checks.h"
#include "compare/mask_metrics.h"
#include "surface/closed_surface.h"
#include "surface/face_texels.h"

namespace gnomon::study {
namespace {

/// The largest number of pieces that a base mesh may have.
constexpr int mostPieces = 1024;

/// The key that makes the truth finer, with a value that about halves its uncertainty or more.
std::string finerTruth(const StudySpec& study, const TruthRecord& truth) {
  constexpr double quickFactor = 4;  // on both keys
  const double factor = study.quick ? quickFactor : 1;
  const std::string change =
      study.truth.uncertainty
          ? fmt::format("truth.uncertainty = {:g} (now {:g})", mostUncertainty,
                        *study.truth.uncertainty / factor)
          : fmt::format("truth.step = {:g} (now {:g})", truth.askedStepTexels / factor / 2,
                        truth.askedStepTexels / factor);
  return study.quick ? "Leave out --quick; or set " + change : "Set " + change;
}

/// Of the samples of all views and lights that have an answer.
double shadowShare(const BaseCase& base) {
  std::size_t shadowed = 0;
  std::size_t lit = 0;
  for (const ViewCase& view : base.views) {
    for (const truth::Truth& truth : view.truths) {
      const auto& samples = truth.mask.samples;
      shadowed +=
          static_cast<std::size_t>(std::count(samples.begin(), samples.end(), Shade::shadowed));
      lit += static_cast<std::size_t>(std::count(samples.begin(), samples.end(), Shade::lit));
    }
  }
  const std::size_t all = shadowed + lit;
  return all > 0 ? static_cast<double>(shadowed) / static_cast<double>(all) : 0;
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

std::optional<std::string> coarsePiecesNotice(const std::string& method, int pieces,
                                              double longestEdgeTexels) {
  const double longest = longestEdgeTexels / pieces;
  if (!(longest > longestPieceTexels)) return std::nullopt;
  const double enough = std::ceil(longestEdgeTexels - 1e-9);
  return fmt::format(
      "{}: the pieces of the displaced mesh, {} a side of each face, are up to {:.2g} texels long: "
      "too coarse for the map. {}.",
      method, pieces, longest,
      enough <= mostPieces
          ? fmt::format("Set base.subdivisions = {:.0f} for pieces of at most 1 texel", enough)
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
  const auto isSoft = [](const LightSpec& light) { return light.isSoft(); };
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
  add(insideOutNotice(scene.surface, shadowShare(scene.standardBase())));
  add(uncertaintyNotice(scene.study, truth));
  add(softNotice(scene.study));
  add(overlapNotice(*scene.layout));
  std::vector<std::string> given;
  std::map<int, std::vector<std::string>> ofPieces;  // labels by the pieces of their mesh
  std::optional<double> longestEdge;
  for (const MethodCase& method : methods) {
    if (method.isGiven()) {
      given.push_back(method.spec->label);
      add(invertedMasksNotice(scene.study, method));
    }
    add(cameraNotice(scene.study, method.spec->label, method.method));
    const MeshChoice& mesh = method.base->choice;
    if (mesh.kind != render::DrawnMesh::displaced) continue;
    if (!longestEdge) {
      // A resampled map is the same relief: its features are as wide as the texels before.
      const relief::Relief& relief = scene.study.relief;
      longestEdge =
          surface::longestEdgeTexels(scene.surface, relief.texelsPerUv()) / relief.resample;
    }
    ofPieces[mesh.base.subdivisions].push_back(method.spec->label);
  }
  if (!given.empty()) add(givenNotice(labelsText(given)));
  for (const auto& [pieces, labels] : ofPieces) {
    add(coarsePiecesNotice(labelsText(labels), pieces, *longestEdge));
  }
  return notices;
}

}  // namespace gnomon::study
