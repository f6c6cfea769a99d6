#include "study/run_study.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>

#include "common/error.h"
#include "compare/counts.h"
#include "compare/shadow_length.h"
#include "render/gpu_scene.h"
#include "render/method.h"
#include "render/method_pass.h"
#include "render/passes.h"
#include "study/base_case.h"
#include "study/budget.h"
#include "study/environment.h"
#include "study/file_names.h"
#include "study/light_field.h"
#include "study/method_section.h"
#include "study/panel_pictures.h"
#include "study/table_set.h"
#include "study/thresholds.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"

namespace gnomon {
namespace {

/// A method ready to be asked.
struct MethodCase {
  const MethodSpec* spec;
  Method method;
  MethodPass pass;
  GpuTables tables;
  BaseCase* base;
};

class StudyRun {
 public:
  StudyRun(const StudySpec& study, const GlContext& gl, RunWriter& writer,
           const StageProgress& progress)
      : study_(study),
        clock_(progress),
        shaders_(shaderFolder()),
        surface_(
            clock_.measure("surface", [&](const Progress&) { return LimitSurface(study.cage); })),
        heights_(study.relief.field),
        tables_(study.relief.field),
        writer_(writer),
        pictures_(study, heights_, shaders_, writer, clock_) {
    record_.environment = describeEnvironment(gl);
    record_.name = study.name;
    record_.title = study.title;
    record_.source = study.source;
    record_.file = study.file.string();
  }

  StudyRecord run() {
    prepareMethods();
    prepareLadders();
    traceTruth();
    traceUncertainty();
    compareMethods();
    attributeErrors();
    timeFrames();
    record_.thresholds = judgeThresholds(study_.thresholds, record_.results);
    record_.timings = clock_.timings();
    return std::move(record_);
  }

 private:
  // ---- before the truth: what depends on neither light nor micro-mesh

  void prepareMethods() {
    // The study's own base is shown and traced even where every method draws another.
    baseFor(standardMesh());
    for (const MethodSpec& spec : study_.methods) {
      MethodCase prepared = prepare(spec);
      record_.methods.push_back(
          {spec.label, prepared.method.name, prepared.method.title, prepared.method.citation});
      requireView(prepared.method, spec.label);
      methods_.push_back(std::move(prepared));
    }
  }

  MethodCase prepare(const MethodSpec& spec) {
    Method method = readMethod(spec.file);
    MethodPass pass(shaders_, method, study_.relief.field.wrap(), spec.filter, spec.parameters);
    const GpuTables tables = prepareTables(method, spec.bake);
    BaseCase& base = baseFor({method.mesh, spec.baseSubdivisions});
    if (method.passes.texture || method.tables.surfaceAngles) requireTextureView(base.texture);
    return {&spec, std::move(method), std::move(pass), tables, &base};
  }

  /// A method that only a camera can see needs one.
  void requireView(const Method& method, const std::string& label) const {
    if (!method.passes.shadowVolumes) return;
    const bool camera =
        std::any_of(study_.views.begin(), study_.views.end(),
                    [](const ViewSpec& view) { return std::holds_alternative<Camera>(view.kind); });
    if (!camera) {
      throw InputError(fmt::format(
          "method \"{}\" counts shadow volumes at a camera's pixels: a [[view]] of type camera "
          "expected",
          label));
    }
  }

  /// The tables that depend on the relief alone.
  [[nodiscard]] GpuTables prepareTables(const Method& method, const BakeSpec& bake) {
    GpuTables tables;
    if (method.tables.horizon || method.tables.distance) {
      const TablePair& pair = tables_.tables(bake, clock_);
      tables.horizon = &pair.horizon;
      tables.distance = &pair.distance;
    }
    if (method.tables.angles) tables.angles = &tables_.angles(bake, clock_);
    if (method.tables.ellipse) tables.ellipse = &tables_.ellipses(bake, clock_);
    return tables;
  }

  /// The tables that are shot on the displaced surface.
  void shootTables(const MicroMesh& mesh, const MicroScene& scene) {
    for (std::vector<MethodCase>* cases : {&methods_, &states_}) {
      for (MethodCase& method : *cases) {
        if (!method.method.tables.surfaceAngles) continue;
        const RenderView& plane = method.base->texture;
        const SampleGrid texels = SamplesPass(shaders_).render(plane, method.base->gpu);
        const HorizonScene on{surface_, study_.relief, mesh,
                              scene,    texels,        {plane.texelWindow.x, plane.texelWindow.y}};
        method.tables.angles = &tables_.surfaceAngles(method.spec->bake, on, clock_);
      }
    }
  }

  BaseCase& baseFor(MeshChoice choice) {
    const auto found = bases_.find(choice);
    if (found != bases_.end()) return found->second;
    return clock_.measure("samples", [&](const Progress&) -> BaseCase& {
      return bases_.emplace(choice, makeBaseCase(study_, surface_, choice, shaders_)).first->second;
    });
  }

  // ---- the truth

  [[nodiscard]] Truth trace(const MicroMesh& mesh, const MicroScene& scene,
                            const SampleGrid& samples, const LightSpec& light, double liftShare,
                            const Progress& progress) const {
    const TraceSettings settings{light.direction(), study_.bake.settings.radiusTexels, liftShare};
    return traceShadows(surface_, study_.relief, mesh, scene, samples, settings, progress);
  }

  void traceTruth() {
    const MicroMesh mesh = clock_.measure("micro-mesh", [&](const Progress& progress) {
      return MicroMesh(surface_, study_.relief, study_.truth, progress);
    });
    const auto scene = clock_.measure(
        "hierarchy", [&](const Progress&) { return std::make_unique<MicroScene>(mesh); });
    record_.truth.microTriangles = mesh.triangleCount();
    record_.truth.stepTexels = mesh.stepTexels();
    record_.truth.bvhBytes = scene->byteCount();
    record_.truth.meshBytes = mesh.coordinates().size() * sizeof(float);
    shootTables(mesh, *scene);
    for (auto& [choice, base] : bases_) {
      for (ViewCase& view : base.views) {
        for (const LightSpec& light : study_.lights) {
          view.truths.push_back(clock_.measure("truth", [&](const Progress& progress) {
            return trace(mesh, *scene, view.samples, light, standardLift, progress);
          }));
        }
        requireFrames(view.samples, view.truths.front());
        record_.undefinedSamples += view.truths.front().undefinedSamples;
      }
    }
    pictures_.drawDisplaced(mesh, *scene);
  }

  static void requireFrames(const SampleGrid& samples, const Truth& truth) {
    const auto shown = std::count_if(samples.samples.begin(), samples.samples.end(),
                                     [](const SurfaceSample& sample) { return sample.face >= 0; });
    if (truth.undefinedSamples == static_cast<std::size_t>(shown)) {
      throw InputError(
          "no sample of a view has a frame: the surface or its texture coordinates have no area");
    }
  }

  /// The same rays at half the resolution and half the lift: what flips is the truth's own error.
  void traceUncertainty() {
    MicroMeshSettings half = study_.truth;
    half.stepTexels = 2 * record_.truth.stepTexels;
    const MicroMesh mesh = clock_.measure("uncertainty", [&](const Progress& progress) {
      return MicroMesh(surface_, study_.relief, half, progress);
    });
    if (2 * mesh.triangleCount() > record_.truth.microTriangles) {
      throw InputError(fmt::format(
          "truth.step: {} texels found, but twice that gives {} micro-triangles instead of {}: too "
          "alike to tell the truth's own error. A smaller step expected",
          record_.truth.stepTexels, mesh.triangleCount(), record_.truth.microTriangles));
    }
    const auto scene = clock_.measure(
        "uncertainty", [&](const Progress&) { return std::make_unique<MicroScene>(mesh); });
    const BaseCase& base = bases_.at(standardMesh());
    for (std::size_t v = 0; v < study_.views.size(); ++v) {
      const ViewCase& view = base.views[v];
      for (std::size_t l = 0; l < study_.lights.size(); ++l) {
        const Truth coarse = clock_.measure("uncertainty", [&](const Progress& progress) {
          return trace(mesh, *scene, view.samples, study_.lights[l], standardLift / 2, progress);
        });
        const double flips = flipRate(view.truths[l].mask, coarse.mask);
        const auto lengthError = clock_.measure("uncertainty", [&](const Progress&) {
          const LightField field = lightField(base, v, l);
          return differenceFromOne(lengths(coarse.mask, view.truths[l], field).ratio);
        });
        record_.truth.flips.push_back(
            {study_.views[v].name, study_.lights[l].name, flips, lengthError});
        record_.truth.uncertainty = std::max(record_.truth.uncertainty, flips);
      }
    }
  }

  // ---- shadow lengths

  [[nodiscard]] LightField lightField(const BaseCase& base, std::size_t view,
                                      std::size_t light) const {
    const ViewCase& seen = base.views[view];
    return makeLightField(surface_, seen.view, seen.samples, study_.lights[light].direction());
  }

  /// Of the shadows that an occluder casts: those that are attached alone have no end to measure.
  [[nodiscard]] static ShadowLengths lengths(const Mask& mask, const Truth& truth,
                                             const LightField& field) {
    std::vector<std::uint8_t> isCast(mask.size());
    std::transform(truth.regions.begin(), truth.regions.end(), isCast.begin(), [](Region region) {
      return static_cast<std::uint8_t>(region == Region::cast || region == Region::distant);
    });
    return compareShadowLengths(mask, truth.mask, field, isCast);
  }

  static std::optional<double> differenceFromOne(std::optional<double> ratio) {
    return ratio ? std::optional(std::abs(*ratio - 1)) : std::nullopt;
  }

  // ---- the methods

  /// The study's own base mesh: the one that is shown and whose truth is tested.
  [[nodiscard]] MeshChoice standardMesh() const {
    return {DrawnMesh::base, study_.baseSubdivisions};
  }

  [[nodiscard]] bool answersIn(const MethodCase& method, std::size_t view) const {
    return !method.method.passes.shadowVolumes ||
           std::holds_alternative<Camera>(study_.views[view].kind);
  }

  /// Masks live for one view and light: that is all that a panel needs.
  void compareMethods() {
    for (std::size_t v = 0; v < study_.views.size(); ++v) {
      for (std::size_t l = 0; l < study_.lights.size(); ++l) {
        std::vector<std::optional<Mask>> masks(methods_.size());
        std::vector<PanelMask> shown;
        std::map<const BaseCase*, LightField> fields;
        for (std::size_t m = 0; m < methods_.size(); ++m) {
          const BaseCase* base = methods_[m].base;
          if (answersIn(methods_[m], v)) {
            masks[m] = clock_.measure("methods",
                                      [&](const Progress&) { return answer(methods_[m], v, l); });
            clock_.measure("compare", [&](const Progress&) {
              if (!fields.contains(base)) fields.emplace(base, lightField(*base, v, l));
              compare(m, v, l, *masks[m], fields.at(base));
            });
          }
          shown.push_back({base, masks[m] ? &*masks[m] : nullptr});
        }
        if (v == budgetView_) measureStates(l, masks);
        record_.panels.push_back(pictures_.draw(v, l, bases_.at(standardMesh()), shown));
      }
    }
  }

  /// A method's mask, without the samples for which no frame exists.
  [[nodiscard]] Mask answer(const MethodCase& method, std::size_t view, std::size_t light) const {
    const ViewCase& seen = method.base->views[view];
    Mask mask = method.pass.render(seen.view, drawingOf(study_, heights_, *method.base, light),
                                   method.tables);
    const Mask& truth = seen.truths[light].mask;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (truth.samples[i] == Shade::none) mask.samples[i] = Shade::none;
    }
    return mask;
  }

  void compare(std::size_t method, std::size_t view, std::size_t light, const Mask& mask,
               const LightField& field) {
    const ViewCase& seen = methods_[method].base->views[view];
    const Truth& truth = seen.truths[light];
    const auto add = [&](std::string_view region, std::span<const std::uint8_t> selected) {
      record_.results.push_back({study_.methods[method].label, study_.lights[light].name,
                                 study_.views[view].name, std::string(region),
                                 countSamples(mask, truth.mask, seen.weights, selected)});
    };
    add("all", {});
    record_.results.back().lengths = lengths(mask, truth, field);
    std::vector<std::uint8_t> selected(mask.size());
    for (const Region region : reportedRegions) {
      std::transform(truth.regions.begin(), truth.regions.end(), selected.begin(),
                     [region](Region r) { return static_cast<std::uint8_t>(r == region); });
      add(regionName(region), selected);
    }
  }

  // ---- where the errors come from

  /// The states of all ladders, one for each that differs from the others.
  void prepareLadders() {
    if (study_.budget.ladders.empty()) return;
    const auto atlas =
        std::find_if(study_.views.begin(), study_.views.end(),
                     [](const ViewSpec& v) { return std::holds_alternative<AtlasSpec>(v.kind); });
    budgetView_ = static_cast<std::size_t>(atlas - study_.views.begin());
    for (const LadderSpec& ladder : study_.budget.ladders) {
      for (const auto* way : {&ladder.forward, &ladder.backward}) {
        for (const MethodSpec& state : *way) addState(state, ladder.method);
      }
    }
    requireBlocks(bases_.at(standardMesh()).views[*budgetView_]);
    stateErrors_.resize(study_.lights.size());
  }

  void addState(const MethodSpec& spec, const std::string& method) {
    if (stateOf(spec) < states_.size()) return;
    states_.push_back(prepare(spec));
    if (states_.back().method.passes.shadowVolumes) {
      throw InputError(
          fmt::format("ladder \"{}\": {} counts shadow volumes at a camera's pixels, a method that "
                      "answers in an "
                      "atlas expected",
                      method, states_.back().method.name));
    }
  }

  /// The bootstrap needs at least two blocks.
  void requireBlocks(const ViewCase& seen) const {
    const auto blocks = [&](int samples) {
      return (samples + study_.budget.blockSide - 1) / study_.budget.blockSide;
    };
    if (blocks(seen.view.width) * blocks(seen.view.height) >= 2) return;
    throw InputError(fmt::format(
        "budget.block: {} samples found, less than a side of the view, {} × {}, expected",
        study_.budget.blockSide, seen.view.width, seen.view.height));
  }

  /// Its index, or the number of states.
  [[nodiscard]] std::size_t stateOf(const MethodSpec& spec) const {
    const auto found = std::find_if(states_.begin(), states_.end(), [&](const MethodCase& state) {
      return isSameMethod(*state.spec, spec);
    });
    return static_cast<std::size_t>(found - states_.begin());
  }

  /// @param masks  of the study's methods in the same view and light
  void measureStates(std::size_t light, const std::vector<std::optional<Mask>>& masks) {
    for (std::size_t s = 0; s < states_.size(); ++s) {
      const ViewCase& seen = states_[s].base->views[*budgetView_];
      const Mask mask = clock_.measure(
          "ladders", [&](const Progress&) { return answer(states_[s], *budgetView_, light); });
      clock_.measure("compare", [&](const Progress&) {
        requireStarts(s, mask, masks);
        stateErrors_[light].push_back(
            stateErrors(mask, seen.truths[light], seen.weights, study_.budget.blockSide));
      });
      clock_.measure("writing", [&](const Progress&) { writer_.mask(maskPath(s, light), mask); });
    }
  }

  /// A ladder must begin at the very method that it speaks of.
  void requireStarts(std::size_t state, const Mask& mask,
                     const std::vector<std::optional<Mask>>& masks) const {
    for (const LadderSpec& ladder : study_.budget.ladders) {
      if (stateOf(ladder.forward.front()) != state) continue;
      const auto method =
          std::find_if(study_.methods.begin(), study_.methods.end(),
                       [&](const MethodSpec& m) { return m.label == ladder.method; });
      const auto& own = masks[static_cast<std::size_t>(method - study_.methods.begin())];
      if (!own || own->samples == mask.samples) continue;
      std::size_t differ = 0;
      for (std::size_t i = 0; i < mask.size(); ++i) {
        differ += own->samples.at(i) != mask.samples[i] ? 1 : 0;
      }
      throw InputError(
          fmt::format("ladder \"{}\": its first state and the method differ in {} samples, none "
                      "expected",
                      ladder.method, differ));
    }
  }

  [[nodiscard]] std::string maskPath(std::size_t state, std::size_t light) const {
    std::vector<std::string> lights;
    for (const LightSpec& spec : study_.lights) lights.push_back(spec.name);
    return fmt::format("masks/ladders/{}_{}.png", fileNames(lights)[light], state);
  }

  void attributeErrors() {
    for (const LadderSpec& ladder : study_.budget.ladders) {
      std::vector<std::size_t> lights(study_.lights.size());
      std::iota(lights.begin(), lights.end(), 0);
      clock_.measure("confidence", [&](const Progress&) {
        if (lights.size() > 1) attribute(ladder, "all", lights);
        for (const std::size_t light : lights) {
          attribute(ladder, study_.lights[light].name, {&light, 1});
        }
      });
    }
  }

  /// Over some of the lights together.
  void attribute(const LadderSpec& ladder, const std::string& name,
                 std::span<const std::size_t> lights) {
    const auto along = [&](const std::vector<MethodSpec>& way) {
      std::vector<StateErrors> errors;
      for (const MethodSpec& spec : way) {
        const std::size_t state = stateOf(spec);
        errors.push_back(stateErrors_[lights.front()][state]);
        for (const std::size_t light : lights.subspan(1)) {
          errors.back() += stateErrors_[light][state];
        }
      }
      return errors;
    };
    const std::string& view = study_.views[*budgetView_].name;
    double uncertainty = 0;
    for (const UncertaintyRecord& flip : record_.truth.flips) {
      const bool isMeant = std::any_of(lights.begin(), lights.end(), [&](std::size_t light) {
        return study_.lights[light].name == flip.light;
      });
      if (flip.view == view && isMeant) uncertainty += flip.flipRate;
    }
    BootstrapSettings bootstrap;
    bootstrap.resamples = study_.budget.resamples;
    record_.budgets.push_back(
        attributeError(ladder, {view, name, uncertainty / static_cast<double>(lights.size())},
                       along(ladder.forward), along(ladder.backward), bootstrap));
  }

  // ---- cost

  /// Of the tables that the method declares, and of the textures that its passes fill.
  [[nodiscard]] std::uint64_t tableBytes(const MethodCase& method) const {
    const MethodTables& declared = method.method.tables;
    const GpuTables& tables = method.tables;
    std::uint64_t bytes = 0;
    if (declared.horizon) bytes += tables.horizon->byteCount();
    if (declared.distance) bytes += tables.distance->byteCount();
    if (declared.ellipse) bytes += tables.ellipse->byteCount();
    if (tables.angles != nullptr) bytes += tables.angles->byteCount();
    return bytes + method.pass.passBytes(drawingOf(study_, heights_, *method.base, 0), tables);
  }

  /// On the first camera view under the first light; without a camera view there is no frame time.
  void timeFrames() {
    constexpr int frames = 25;
    const auto camera =
        std::find_if(study_.views.begin(), study_.views.end(),
                     [](const ViewSpec& v) { return std::holds_alternative<Camera>(v.kind); });
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const MethodCase& method = methods_[m];
      CostRecord cost;
      cost.method = study_.methods[m].label;
      cost.polygons = method.base->gpu.triangleCount();
      cost.tableBytes = tableBytes(method);
      cost.passes = method.method.passes.count();
      if (method.method.tables.height) cost.heightBytes = heights_.byteCount();
      if (camera != study_.views.end()) {
        const auto view = static_cast<std::size_t>(camera - study_.views.begin());
        cost.frameMs = clock_.measure("frame times", [&](const Progress&) {
          return method.pass.frameMilliseconds(method.base->views[view].view,
                                               drawingOf(study_, heights_, *method.base, 0),
                                               method.tables, frames);
        });
      }
      record_.cost.push_back(cost);
    }
  }

  const StudySpec& study_;
  StageClock clock_;
  std::filesystem::path shaders_;
  LimitSurface surface_;
  GpuHeights heights_;
  TableSet tables_;
  RunWriter& writer_;
  PanelPictures pictures_;
  std::map<MeshChoice, BaseCase> bases_;
  std::vector<MethodCase> methods_;
  std::vector<MethodCase> states_;                     ///< of all ladders, without repetition
  std::optional<std::size_t> budgetView_;              ///< where they are compared
  std::vector<std::vector<StateErrors>> stateErrors_;  ///< [light][state]
  StudyRecord record_;
};

}  // namespace

StudyRecord runStudy(const StudySpec& study, const GlContext& gl, RunWriter& writer,
                     const StageProgress& progress) {
  return StudyRun(study, gl, writer, progress).run();
}

}  // namespace gnomon
