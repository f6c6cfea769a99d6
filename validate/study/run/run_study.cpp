#include "study/run/run_study.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "horizon/horizon_bake.h"
#include "render/shader_files.h"
#include "study/judge/gates.h"
#include "study/run/method_trial.h"
#include "study/run/notices.h"
#include "study/run/scene/cached_fields.h"
#include "study/run/scene/method_case.h"
#include "study/run/scene/method_outcome.h"
#include "study/run/stages/budget.h"
#include "study/run/stages/confidence.h"
#include "study/run/stages/cost_stage.h"
#include "study/run/stages/panel_pictures.h"
#include "study/spec/method_changes.h"

namespace gnomon::study {

namespace {

/// What a run leaves in addition to its figures.
enum class Extras { nothing, memory, picturesAndCosts };

int framesOf(const StudySpec& study, Extras extras) {
  return extras == Extras::picturesAndCosts ? study.frames : 0;
}

/// The order of a run's stages, and what passes from one to the next.
class StudyRun {
 public:
  StudyRun(const StudySpec& study, const render::GlContext& gl, RunWriter& writer,
           cache::Cache& kept, const StageProgress& progress, Extras extras)
      : study_(study),
        extras_(extras),
        costs_(render::frameClockOf(gl.driver().renderer), framesOf(study, extras)),
        clock_(progress),
        scene_(study, clock_, gl, kept),
        before_(scene_.cache.counts()),
        surface_(truthSurface(scene_)),
        writer_(writer),
        pictures_(scene_, writer) {
    record_ = startRecord(study, gl);
  }

  StudyRecord run() {
    prepareMethods();
    LadderStage ladders(scene_, surface_, writer_);
    traceTruth(ladders);
    record_.notices = noticesOf(scene_, record_.truth, methods_);
    compareMethods(ladders);
    if (auto notice = otherChartNotice(record_.methods)) record_.notices.push_back(*notice);
    record_.budgets = ladders.attribute(record_.truth);
    if (extras_ != Extras::nothing) measureCosts();
    record_.judgements = judgeThresholds(study_.thresholds, record_);
    record_.timings = clock_.timings();
    if (scene_.cache.isOn()) record_.cache = scene_.cache.counts() - before_;
    return std::move(record_);
  }

 private:
  void measureCosts() {
    if (framesOf(study_, extras_) > 0) writer_.beQuiet();
    for (MethodCase& method : methods_) {
      if (!method.isGiven()) record_.cost.push_back(costs_.measure(scene_, method));
    }
  }

  void prepareMethods() {
    // The study's own base is shown and traced even where every method draws another.
    scene_.standardBase();
    for (const MethodSpec& spec : study_.methods) {
      MethodCase prepared = prepareMethod(scene_, spec, surface_);
      requireView(prepared, study_);
      record_.methods.push_back({spec.label, prepared.method.name, prepared.method.title,
                                 prepared.method.citation, prepared.method.mark});
      methods_.push_back(std::move(prepared));
    }
  }

  void traceTruth(LadderStage& ladders) {
    record_.truth = sizesOf(scene_, surface_);
    const surface::TextureLayout& layout = *scene_.layout;
    record_.texture = {layout.chartCount, !layout.isOneToOne, layout.sharedArea};
    for (const std::span<MethodCase> methods : {std::span(methods_), ladders.states()}) {
      shootTables(scene_, methods);
    }
    record_.undefinedSamples = traceTruths(scene_, surface_);
    if (hasPictures()) pictures_.drawDisplaced(surface_);
    surface_.release();  // the fine mesh goes before the coarse one comes
    traceUncertainty(scene_, record_.truth);
  }

  /// Masks live for one view and light: that is all that a panel needs.
  void compareMethods(LadderStage& ladders) {
    for (std::size_t v = 0; v < study_.views.size(); ++v) {
      SpreadStage spread(scene_, methods_, v);
      for (std::size_t l = 0; l < study_.lights.size(); ++l) {
        std::vector<std::optional<CaseAnswers>> found(methods_.size());
        const std::vector<PanelAnswer> answers = answersIn(v, l, found);
        compareMethods(answers, v, l, spread);
        if (v == ladders.view()) {
          for (const PanelAnswer& answer : answers) (void)answer.answers();
          ladders.measure(l, found);
        }
        if (hasPictures()) record_.panels.push_back(pictures_.draw(v, l, answers));
      }
      spread.report(record_);
    }
  }

  /// @param found  one a method: where they are kept once they are drawn
  std::vector<PanelAnswer> answersIn(std::size_t view, std::size_t light,
                                     std::vector<std::optional<CaseAnswers>>& found) {
    std::vector<PanelAnswer> answers;
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      MethodCase& method = methods_[m];
      if (!study::answersIn(method, study_.views[view])) continue;
      answers.push_back({m, &method, [&, view, light, both = &found[m]]() -> const CaseAnswers& {
                           if (!*both) *both = draw(method, view, light);
                           return **both;
                         }});
    }
    return answers;
  }

  void compareMethods(std::span<const PanelAnswer> answers, std::size_t view, std::size_t light,
                      SpreadStage& spread) {
    std::vector<std::optional<MethodOutcome>> outcomes;
    std::vector<cache::ContentKey> keys;
    std::vector<ComparedMethod> missing;
    for (const PanelAnswer& answer : answers) {
      cache::KeyBuilder key("outcome");
      key.add("answer", answerKey(scene_, *answer.method, view, light));
      key.add("cells", spread.cellSide());
      keys.push_back(key.key());
      outcomes.push_back(scene_.cache.find<MethodOutcome>(keys.back()));
      if (!outcomes.back()) missing.push_back({answer.method->base, answer.answers});
    }
    if (costs_.clockOf(study_, view, light)) {
      // Before the comparison, which has work for other threads meanwhile.
      for (const ComparedMethod& method : missing) (void)method.answers();
    }
    std::vector<MethodOutcome> found =
        OutcomeStage(scene_, view, light, spread.cellSide()).compare(missing);
    auto next = found.begin();
    for (std::size_t i = 0; i < answers.size(); ++i) {
      if (!outcomes[i]) {
        outcomes[i] = std::move(*next++);
        scene_.cache.keep(keys[i], *outcomes[i]);
      }
      spread.add(answers[i].place, *outcomes[i]);
      addOtherChartShare(answers[i].place, outcomes[i]->otherChartShare);
      addResults(*answers[i].method, view, light, *outcomes[i]);
    }
  }

  /// Adds the share of one view and light to the mean.
  void addOtherChartShare(std::size_t place, double share) {
    const MethodCase& method = methods_[place];
    if (scene_.layout->isOneToOne || method.isGiven()) return;
    const auto views =
        std::count_if(study_.views.begin(), study_.views.end(),
                      [&](const ViewSpec& view) { return study::answersIn(method, view); });
    std::optional<double>& mean = record_.methods[place].otherChartShare;
    mean = mean.value_or(0) +
           share / (static_cast<double>(views) * static_cast<double>(study_.lights.size()));
  }

  CaseAnswers draw(MethodCase& method, std::size_t view, std::size_t light) {
    const std::optional<render::FrameClock> clock = costs_.clockOf(study_, view, light);
    if (clock) writer_.beQuiet();
    return clock_.measure(
        "methods", [&](const Progress&) { return answersOf(scene_, method, view, light, clock); });
  }

  void addResults(const MethodCase& method, std::size_t view, std::size_t light,
                  const MethodOutcome& outcome) {
    for (const Answer answer : allAnswers) {
      const AnswerOutcome& found = answer == Answer::drawn ? outcome.drawn : outcome.test;
      const std::size_t all = record_.results.size();
      const std::vector<std::string> regions = judgedRegions(study_.cage.partNames);
      for (std::size_t r = 0; r < found.regions.size(); ++r) {
        ResultRecord result;
        result.method = method.spec->label;
        result.light = study_.lights[light].name;
        result.view = study_.views[view].name;
        result.region = regions.at(r);
        result.answer = answer;
        result.counts = found.regions[r];
        record_.results.push_back(std::move(result));
      }
      record_.results[all].lengths = found.lengths;
      record_.results[all].boundaries = found.boundaries;
      record_.results[all].shares = found.shares;
    }
  }

  [[nodiscard]] bool hasPictures() const { return extras_ == Extras::picturesAndCosts; }

  const StudySpec& study_;
  Extras extras_;
  CostStage costs_;
  StageClock clock_;
  RunScene scene_;
  cache::CacheCounts before_;
  SurfaceOnDemand surface_;
  RunWriter& writer_;
  PanelPictures pictures_;
  std::vector<MethodCase> methods_;
  StudyRecord record_;
};

/// Measures what the driver draws right.
StudyRecord runMeasurable(const StudySpec& study, const render::GlContext& gl, RunWriter& writer,
                          cache::Cache& kept, const StageProgress& progress, Extras extras) {
  DriverFaults faults(render::shaderFolder(), kept);
  const MeasurableStudy left = measurable(study, faults);
  StudyRecord record =
      StudyRun(left.reduced ? *left.reduced : study, gl, writer, kept, progress, extras).run();
  addRefused(record, study, left.refused);
  return record;
}

}  // namespace

StudyRecord runStudy(const StudySpec& study, const render::GlContext& gl, RunWriter& writer,
                     cache::Cache& kept, const StageProgress& progress) {
  return runMeasurable(study, gl, writer, kept, progress, Extras::picturesAndCosts);
}

StudyRecord runStudyFigures(const StudySpec& study, const render::GlContext& gl, cache::Cache& kept,
                            const StageProgress& progress) {
  NoFiles writer;
  return runMeasurable(study, gl, writer, kept, progress, Extras::memory);
}

StudyRecord measureStudy(const StudySpec& study, const render::GlContext& gl, cache::Cache& kept,
                         const StageProgress& progress) {
  NoFiles writer;
  return runMeasurable(study, gl, writer, kept, progress, Extras::nothing);
}

StudyRecord traceStudy(RunScene& scene, const render::GlContext& gl,
                       const std::function<void(const TracedSurface&)>& whileTraced,
                       const std::function<void(const TracedSurface&)>& whileCoarse) {
  DriverFaults(scene.shaders, scene.cache).requireViews(scene.study);
  StudyRecord record = startRecord(scene.study, gl);
  scene.standardBase();
  {
    SurfaceOnDemand surface = truthSurface(scene);
    record.truth = sizesOf(scene, surface);
    record.undefinedSamples = traceTruths(scene, surface);
    if (whileTraced) whileTraced(surface.get());
  }  // the fine mesh goes before the coarse one comes
  traceUncertainty(scene, record.truth, whileCoarse);
  record.notices = noticesOf(scene, record.truth, {});
  record.timings = scene.clock.timings();
  return record;
}

horizon::StoredHorizons bakeStudyTables(const StudySpec& study, cache::Cache& cache,
                                        const Progress& progress) {
  const relief::HeightField& field = study.relief.field;
  const horizon::BakeSettings& settings = study.bake.settings;
  if (!keepsHorizons(field, settings)) {
    return withKeys("bake", [&] {
      return horizon::bakeStoredHorizons(field, settings, study.bake.bits, progress);
    });
  }
  const horizon::HorizonTables tables = keptHorizons(cache, field, study.bake, progress);
  return {tables, tables.radiusTexels, horizon::storeTable(tables.horizon, study.bake.bits),
          horizon::storeTable(tables.distance, study.bake.bits)};
}

}  // namespace gnomon::study
