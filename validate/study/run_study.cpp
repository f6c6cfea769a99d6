#include "study/run_study.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include "compare/boundaries.h"
#include "compare/counts.h"
#include "study/cast_lengths.h"
#include "study/environment.h"
#include "study/ladder_stage.h"
#include "study/method_case.h"
#include "study/panel_pictures.h"
#include "study/refine_stage.h"
#include "study/run_scene.h"
#include "study/spread_stage.h"
#include "study/thresholds.h"
#include "study/truth_stage.h"
#include "truth/seam_crossing.h"

namespace gnomon {
namespace {

/// The order of a run's stages, and what passes from one to the next.
class StudyRun {
 public:
  StudyRun(const StudySpec& study, const GlContext& gl, RunWriter& writer,
           const StageProgress& progress)
      : study_(study),
        frameClock_(frameClockOf(gl.renderer())),
        clock_(progress),
        scene_(study, clock_),
        writer_(writer),
        pictures_(study, scene_.heights, scene_.shaders, writer, clock_) {
    record_ = startRecord(study, gl);
  }

  StudyRecord run() {
    prepareMethods();
    LadderStage ladders(scene_, writer_);
    traceTruth(ladders);
    compareMethods(ladders);
    record_.budgets = ladders.attribute(record_.truth);
    for (const MethodCase& method : methods_) record_.cost.push_back(costOf(method));
    record_.thresholds = judgeThresholds(study_.thresholds, record_.results);
    record_.timings = clock_.timings();
    return std::move(record_);
  }

 private:
  void prepareMethods() {
    // The study's own base is shown and traced even where every method draws another.
    scene_.standardBase();
    for (const MethodSpec& spec : study_.methods) {
      MethodCase prepared = prepareMethod(scene_, spec);
      requireView(prepared, study_);
      record_.methods.push_back(
          {spec.label, prepared.method.name, prepared.method.title, prepared.method.citation});
      methods_.push_back(std::move(prepared));
    }
  }

  void traceTruth(LadderStage& ladders) {
    {
      const TruthSurface made = makeTruthSurface(scene_);
      const TracedSurface& surface = *made.surface;
      record_.truth = recordOf(made, study_);
      for (const std::span<MethodCase> methods : {std::span(methods_), ladders.states()}) {
        shootTables(scene_, methods, surface.mesh, surface.scene);
      }
      record_.undefinedSamples = traceTruths(scene_, surface);
      pictures_.drawDisplaced(surface.mesh, surface.scene);
    }  // the fine mesh goes before the coarse one comes
    traceUncertainty(scene_, record_.truth);
  }

  /// Masks live for one view and light: that is all that a panel needs.
  void compareMethods(LadderStage& ladders) {
    for (std::size_t v = 0; v < study_.views.size(); ++v) {
      SpreadStage spread(scene_, methods_, v);
      for (std::size_t l = 0; l < study_.lights.size(); ++l) {
        const std::vector<std::optional<Mask>> masks = compareMethods(v, l);
        spread.measure(l, masks);
        if (v == ladders.view()) ladders.measure(l, masks);
        std::vector<PanelMask> shown;
        for (std::size_t m = 0; m < methods_.size(); ++m) {
          shown.push_back({methods_[m].base, masks[m] ? &*masks[m] : nullptr});
        }
        record_.panels.push_back(pictures_.draw(v, l, scene_.standardBase(), shown));
      }
      spread.report(record_);
    }
  }

  /// One mask a method, none where it has no answer in the view.
  std::vector<std::optional<Mask>> compareMethods(std::size_t view, std::size_t light) {
    std::vector<std::optional<Mask>> masks(methods_.size());
    std::map<const BaseCase*, LightField> fields;
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const MethodCase& method = methods_[m];
      if (!answersIn(method, study_.views[view])) continue;
      masks[m] = clock_.measure(
          "methods", [&](const Progress&) { return answerOf(scene_, method, view, light); });
      clock_.measure("compare", [&](const Progress&) {
        if (!fields.contains(method.base)) {
          fields.emplace(method.base, scene_.lightField(*method.base, view, light));
        }
        compare(method, view, light, *masks[m], fields.at(method.base));
      });
    }
    return masks;
  }

  void compare(const MethodCase& method, std::size_t view, std::size_t light, const Mask& mask,
               const LightField& field) {
    const ViewCase& seen = method.base->views[view];
    const Truth& truth = seen.truths[light];
    const auto add = [&](std::string_view region, std::span<const std::uint8_t> selected) {
      record_.results.push_back({method.spec->label, study_.lights[light].name,
                                 study_.views[view].name, std::string(region),
                                 countSamples(mask, truth.mask, seen.weights, selected)});
    };
    add("all", {});
    record_.results.back().lengths = castLengths(mask, truth, field);
    record_.results.back().boundaries = compareBoundaries(mask, truth.mask, seen.layout);
    std::vector<std::uint8_t> selected(mask.size());
    for (const Region region : reportedRegions) {
      std::transform(truth.regions.begin(), truth.regions.end(), selected.begin(),
                     [region](Region r) { return static_cast<std::uint8_t>(r == region); });
      add(regionName(region), selected);
    }
    add(seamRegion, truth.crossesSeam);
  }

  /// On the first camera view under the first light; without a camera view there is no frame time.
  [[nodiscard]] CostRecord costOf(const MethodCase& method) {
    constexpr int frames = 25;
    CostRecord cost;
    cost.method = method.spec->label;
    cost.polygons = method.base->gpu.triangleCount();
    cost.tableBytes = tableBytes(scene_, method);
    cost.passes = method.method.passes.count();
    if (method.method.tables.height) cost.heightBytes = scene_.heights.byteCount();
    const auto camera =
        std::find_if(study_.views.begin(), study_.views.end(),
                     [](const ViewSpec& v) { return std::holds_alternative<Camera>(v.kind); });
    if (camera != study_.views.end()) {
      const auto view = static_cast<std::size_t>(camera - study_.views.begin());
      cost.frameMs = clock_.measure("frame times", [&](const Progress&) {
        return method.pass.frameMilliseconds(method.base->views[view].view,
                                             scene_.drawing(*method.base, 0), method.tables, frames,
                                             frameClock_);
      });
    }
    return cost;
  }

  const StudySpec& study_;
  FrameClock frameClock_;
  StageClock clock_;
  RunScene scene_;
  RunWriter& writer_;
  PanelPictures pictures_;
  std::vector<MethodCase> methods_;
  StudyRecord record_;
};

}  // namespace

StudyRecord runStudy(const StudySpec& study, const GlContext& gl, RunWriter& writer,
                     const StageProgress& progress) {
  return StudyRun(study, gl, writer, progress).run();
}

}  // namespace gnomon
