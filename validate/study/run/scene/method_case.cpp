#include "study/run/scene/method_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/error.h"
#include "compare/answer_metrics.h"
#include "render/passes/drawing.h"
#include "study/run/scene/cached_fields.h"
#include "truth/surface_horizons.h"

namespace gnomon::study {
namespace {

render::GpuTables reliefTables(RunScene& scene, const render::Method& method,
                               const BakeSpec& bake) {
  render::GpuTables tables;
  tables.searchRadius = bake.settings.radiusTexels;
  if (method.tables.horizon || method.tables.distance) {
    const TablePair& pair = scene.tables.tables(bake, scene.clock);
    tables.horizon = &pair.horizon;
    tables.distance = &pair.distance;
  }
  if (method.tables.angles) tables.angles = &scene.tables.angles(bake, scene.clock);
  if (method.tables.ellipse) tables.ellipse = &scene.tables.ellipses(bake, scene.clock);
  return tables;
}

/// Bakes the method's own tables, once all others are there.
void bakeOwn(RunScene& scene, MethodCase& method) {
  CompiledMethod& ready = *method.compiled;
  ready.bakes = methodBakes(scene, *method.spec, method.method, ready.tables);
  ready.tables.bakes = ready.bakes.get();
}

/// What all methods and cases draw their answers into; null where it is too large to be kept.
std::shared_ptr<const render::SharedTargets> sharedTargets(RunScene& scene) {
  std::size_t samples = 0;
  for (const ViewCase& view : scene.standardBase().views) {
    samples = std::max(samples, view.samples.samples.size());
  }
  // Answers as bits and as shares, and texel counts, each with its depth.
  const std::uint64_t bytes = (5 + 13 + 8) * samples;
  if (!scene.cache.canShare(bytes)) return nullptr;
  return scene.cache.share(
      cache::KeyBuilder("targets").key(), [] { return render::SharedTargets(); }, bytes);
}

/// The shader of a method as this study uses it, compiled once for all cases: Pass is MethodPass or
/// TexelCounter.
/// @param more  what else its constructor takes
template <typename Pass, typename... More>
std::shared_ptr<const Pass> compiledPass(RunScene& scene, const MethodCase& method,
                                         const More&... more) {
  const MethodSpec& spec = *method.spec;
  return scene.cache.share(
      scene.keys.program(spec, method.method),
      [&] {
        return Pass(scene.shaders, method.method, scene.study.relief.field.wrap(), spec.filter,
                    spec.parameters, spec.disc ? render::SoftAnswer::disc : render::SoftAnswer::own,
                    more...);
      },
      programBytes);
}

void compile(RunScene& scene, MethodCase& method) {
  const DrawnBase& base = scene.clock.measure(
      "samples", [&](const Progress&) -> const DrawnBase& { return *method.base->drawn.get(); });
  if (method.method.passes.needTexturePlane() || method.method.tables.surfaceAngles) {
    render::requireTextureView(base.texture);
  }
  method.compiled.emplace(
      CompiledMethod{compiledPass<render::MethodPass>(scene, method, sharedTargets(scene)),
                     reliefTables(scene, method.method, method.spec->bake)});
  if (!method.method.tables.surfaceAngles) bakeOwn(scene, method);
}

bool hasAllMasks(const RunScene& scene, const MethodCase& method) {
  for (std::size_t v = 0; v < scene.study.views.size(); ++v) {
    for (std::size_t l = 0;
         answersIn(method, scene.study.views[v]) && l < scene.study.lights.size(); ++l) {
      const cache::ContentKey key = scene.keys.mask(method.key, method.base->choice, v, l);
      if (!scene.cache.holds(key)) return false;
    }
  }
  return true;
}

/// The layers of every `step`-th azimuth: what is shot toward the fewer azimuths, to the bit where
/// the step is a power of two.
horizon::AngleTable everyAzimuth(const horizon::AngleTable& table, int step) {
  horizon::AngleTable some = table;
  some.layers = table.layers / step;
  some.angles.clear();
  const auto texels = static_cast<std::ptrdiff_t>(table.width) * table.height;
  for (int m = 0; m < table.layers; m += step) {
    const auto layer = table.angles.begin() + m * texels;
    some.angles.insert(some.angles.end(), layer, layer + texels);
  }
  return some;
}

/// Of a table that was shot toward more azimuths, if the cache has one.
std::shared_ptr<const horizon::AngleTable> finerAngles(RunScene& scene, const MethodCase& method,
                                                       int azimuths) {
  BakeSpec bake = method.spec->bake;
  bake.settings.azimuths = azimuths;
  return scene.cache.shared<horizon::AngleTable>(
      scene.keys.surfaceAngles(method.base->choice, bake));
}

horizon::AngleTable shootAngles(RunScene& scene, const MethodCase& method) {
  const BakeSpec& bake = method.spec->bake;
  for (const int step : {2, 4, 8, 16}) {
    const auto finer = finerAngles(scene, method, step * bake.settings.azimuths);
    if (finer) return everyAzimuth(*finer, step);
  }
  const render::RenderView& plane = method.base->drawn.get()->texture;
  const surface::SampleGrid texels =
      render::SamplesPass(scene.shaders).render(plane, method.base->drawn.get()->gpu);
  const TracedSurface& traced = method.surface->get();
  horizon::AngleTable table =
      scene.clock.measure("surface horizons", [&](const Progress& progress) {
        return truth::shootHorizons(scene.surface, scene.study.relief, traced.mesh, traced.scene,
                                    texels, bake.settings.azimuths, bake.angleLimit, progress);
      });
  table.originX = plane.texelWindow.x;
  table.originY = plane.texelWindow.y;
  return *scene.cache.share(
      scene.keys.surfaceAngles(method.base->choice, bake), [&] { return std::move(table); },
      [](const horizon::AngleTable& angles) { return sizeof(float) * angles.angles.size(); });
}

/// "method "own" (mine.glsl)", and "samples of view "a" under light "b"".
std::string nameOf(const MethodCase& method) {
  return fmt::format("method \"{}\" ({})", method.spec->label, method.spec->file.string());
}
std::string samplesOf(const RunScene& scene, std::size_t view, std::size_t light) {
  return fmt::format("samples of view \"{}\" under light \"{}\"", scene.study.views[view].name,
                     scene.study.lights[light].name);
}

/// A method has to answer wherever the truth does: one that leaves out pixels would not be scored
/// on them.
void requireAnswers(const RunScene& scene, const MethodCase& method, std::size_t view,
                    std::size_t light, const Mask& answer) {
  const Mask& truth = method.base->views[view].truths[light].mask;
  if (compare::answersAllOf(truth, answer)) return;
  std::size_t left = 0;
  std::size_t samples = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const bool isSample = truth.samples[i] != Shade::none;
    samples += static_cast<std::size_t>(isSample);
    left += static_cast<std::size_t>(isSample && answer.samples[i] == Shade::none);
  }
  std::size_t first = 0;
  while (truth.samples[first] == Shade::none || answer.samples[first] != Shade::none) ++first;
  if (method.isGiven()) {
    const auto width = static_cast<std::size_t>(truth.width);
    throw InputError(fmt::format(
        "{}: no answer at {} of the {} pixels where the truth has one, first at column {}, row {}; "
        "lit or shadowed expected",
        maskOf(method.given, scene.study, view, light).path.string(), left, samples, first % width,
        first / width));
  }
  throw InputError(fmt::format("{}: its shader leaves out {} of {} {}, an answer for each expected",
                               nameOf(method), left, samples, samplesOf(scene, view, light)));
}

/// Counts the samples of a truth, and those of them that a list holds.
/// @param placeOf  of an entry of the list
template <typename List, typename PlaceOf>
std::pair<std::size_t, std::size_t> countOf(const Mask& truth, const List& list,
                                            const PlaceOf& placeOf) {
  const auto isSample = [](Shade shade) { return shade != Shade::none; };
  const auto found = std::count_if(list.begin(), list.end(), [&](const auto& entry) {
    return isSample(truth.samples[placeOf(entry)]);
  });
  const auto all = std::count_if(truth.samples.begin(), truth.samples.end(), isSample);
  return {static_cast<std::size_t>(found), static_cast<std::size_t>(all)};
}

/// A number that is none, or means nothing, is no answer.
void requireNumbers(const RunScene& scene, const MethodCase& method, std::size_t view,
                    std::size_t light, const std::vector<render::FaultySample>& faulty) {
  const Mask& truth = method.base->views[view].truths[light].mask;
  for (const auto& [fault, what] :
       {std::pair(render::AnswerFault::share,
                  "`visibility` is no number or not from 0 to 1 at {} of {} {}, a number from 0 to "
                  "1 expected"),
        std::pair(render::AnswerFault::horizon,
                  "`horizonSlope` is no number at {} of {} {}, a number expected"),
        std::pair(render::AnswerFault::normal,
                  "`shadingNormal` is no unit vector at {} of {} {}, length 1 expected")}) {
    std::vector<render::FaultySample> of;
    std::copy_if(faulty.begin(), faulty.end(), std::back_inserter(of),
                 [bit = static_cast<unsigned>(fault)](const render::FaultySample& sample) {
                   return (sample.faults & bit) != 0;
                 });
    const auto [found, all] =
        countOf(truth, of, [](const render::FaultySample& sample) { return sample.sample; });
    if (found == 0) continue;
    throw InputError(nameOf(method) + ": its " +
                     fmt::format(fmt::runtime(what), found, all, samplesOf(scene, view, light)));
  }
}

/// Draws nothing that does not end: the methods that come with the program do, which a test holds.
void requireEnds(RunScene& scene, const MethodCase& method, const CompiledMethod& ready,
                 const render::Drawing& drawing, std::size_t view, std::size_t light) {
  if (isBuiltIn(*method.spec) || !render::hasLoops(method.method)) return;
  const auto check = compiledPass<render::LoopCheck>(scene, method);
  std::vector<std::size_t> endless;
  try {
    endless =
        ready.pass->endlessSamples(method.base->views[view].view, drawing, ready.tables, *check);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: under light \"{}\" {}", nameOf(method),
                                 scene.study.lights[light].name, error.what()));
  }
  const Mask& truth = method.base->views[view].truths[light].mask;
  const auto [found, all] = countOf(truth, endless, [](std::size_t sample) { return sample; });
  if (found == 0) return;
  throw InputError(fmt::format(
      "{}: its loops turn {} times or more at {} of {} {}, fewer expected: "
      "is one without an end?",
      nameOf(method), render::mostLoopIterations, found, all, samplesOf(scene, view, light)));
}

/// Times a frame by a clock.
/// @param milliseconds  receives its time
render::FrameDrawer timedBy(render::FrameClock clock, std::optional<double>& milliseconds) {
  return [clock, &milliseconds](const std::function<void()>& draw) {
    milliseconds = render::frameMilliseconds(draw, clock);
  };
}

/// What the method's shader draws, by one of the functions of its pass.
/// @param clock  as in answersOf
template <typename Answers>
Answers drawnBy(RunScene& scene, MethodCase& method, std::size_t view, std::size_t light,
                std::optional<render::FrameClock> clock,
                Answers (render::MethodPass::*draw)(const render::RenderView&,
                                                    const render::Drawing&,
                                                    const render::GpuTables&,
                                                    const render::FrameDrawer&) const) {
  const cache::ContentKey key = scene.keys.mask(method.key, method.base->choice, view, light);
  return scene.cache.remember(key, [&] {
    const CompiledMethod& ready = compiled(scene, method);
    const render::Drawing drawing = drawingOf(scene, method, light);
    requireEnds(scene, method, ready, drawing, view, light);
    const bool isTimed = clock && ready.pass->isWarm(drawing);
    Answers answers = ((*ready.pass).*draw)(
        method.base->views[view].view, drawing, ready.tables,
        isTimed ? timedBy(*clock, method.compiled->frameMs) : render::FrameDrawer());
    requireNumbers(scene, method, view, light, answers.faulty);
    return answers;
  });
}

/// The shares of a light's disc with the masks that they are cut to.
CaseAnswers cutAnswers(render::VisibilityAnswers shares) {
  CaseAnswers answers{{cutInHalf(shares.drawn), cutInHalf(shares.test)}};
  answers.drawnShares = std::move(shares.drawn);
  answers.testShares = std::move(shares.test);
  answers.otherChartShare = shares.otherChartShare;
  return answers;
}

/// The method's masks, or what its shader draws.
CaseAnswers drawnAnswers(RunScene& scene, MethodCase& method, std::size_t view, std::size_t light,
                         std::optional<render::FrameClock> clock) {
  const bool isSoft = scene.study.lights[light].isSoft();
  if (method.isGiven()) {
    const GivenMask& given = maskOf(method.given, scene.study, view, light);
    if (isSoft) return cutAnswers({given.shares, given.shares});
    return {{given.mask, given.mask}};
  }
  if (isSoft) {
    return cutAnswers(
        drawnBy(scene, method, view, light, clock, &render::MethodPass::renderVisibility));
  }
  return {drawnBy(scene, method, view, light, clock, &render::MethodPass::render)};
}

}  // namespace

bool answerAlike(const CaseAnswers& a, const CaseAnswers& b) {
  return isSame(a.drawn, b.drawn) && isSame(a.test, b.test) &&
         isSame(a.drawnShares, b.drawnShares) && isSame(a.testShares, b.testShares);
}

MethodCase prepareMethod(RunScene& scene, const MethodSpec& spec, SurfaceOnDemand& surface) {
  render::Method method = declarationOf(spec);
  method.isOnPolygons = scene.surface.isPolygons();
  BaseCase& base = scene.base(meshOf(spec, method));
  if (spec.isGiven()) {
    GivenMasks given = readGivenMasks(scene.study, spec, base);
    const cache::ContentKey key = keyOf(given);
    return {&spec, std::move(method), &base, key, &surface, {}, std::move(given)};
  }
  const cache::ContentKey key = scene.keys.method(spec, method);
  MethodCase prepared{&spec, std::move(method), &base, key, &surface};
  if (!hasAllMasks(scene, prepared)) compile(scene, prepared);
  return prepared;
}

const CompiledMethod& compiled(RunScene& scene, MethodCase& method) {
  if (!method.compiled) compile(scene, method);
  shootTables(scene, {&method, 1});
  return *method.compiled;
}

std::shared_ptr<const render::TexelCounter> texelCounter(RunScene& scene,
                                                         const MethodCase& method) {
  return compiledPass<render::TexelCounter>(scene, method);
}

render::Drawing drawingOf(RunScene& scene, const MethodCase& method, std::size_t light) {
  render::Drawing drawing = scene.drawing(*method.base, light);
  const auto lightMesh = lightMeshOf(*method.spec, method.method);
  if (lightMesh) drawing.lightMesh = &scene.mesh(*lightMesh).gpu;
  return drawing;
}

std::uint64_t polygonsOf(RunScene& scene, const MethodCase& method) {
  const auto lightMesh = lightMeshOf(*method.spec, method.method);
  return method.base->drawn.get()->gpu.triangleCount() +
         (lightMesh ? scene.mesh(*lightMesh).gpu.triangleCount() : 0);
}

std::string cameraReason(const render::Method& method) {
  return method.passes.shadowVolumes ? "counts shadow volumes at a camera's pixels"
                                     : "answers at a camera's pixels alone";
}

void requireView(const MethodCase& method, const StudySpec& study) {
  const bool isSeen = std::any_of(study.views.begin(), study.views.end(),
                                  [&](const ViewSpec& view) { return answersIn(method, view); });
  if (isSeen) return;
  throw InputError(fmt::format("method \"{}\" {}: a [[view]] of type camera expected",
                               method.spec->label, cameraReason(method.method)));
}

void shootTables(RunScene& scene, std::span<MethodCase> methods) {
  std::vector<MethodCase*> needing;
  for (MethodCase& method : methods) {
    const bool isNeeded = method.compiled && method.method.tables.surfaceAngles;
    if (isNeeded && method.compiled->tables.angles == nullptr) needing.push_back(&method);
  }
  // The finest first: coarser ones may be a part of them.
  const auto azimuths = [](const MethodCase* method) {
    return method->spec->bake.settings.azimuths;
  };
  std::stable_sort(needing.begin(), needing.end(),
                   [&](const auto* a, const auto* b) { return azimuths(a) > azimuths(b); });
  for (MethodCase* method : needing) {
    method->compiled->tables.angles = &scene.tables.surfaceAngles(
        method->spec->bake, method->base->choice, [&] { return shootAngles(scene, *method); });
    bakeOwn(scene, *method);
  }
}

bool answersIn(const MethodCase& method, const ViewSpec& view) {
  return !method.method.needsCamera() || cameraOf(view) != nullptr;
}

CaseAnswers answersOf(RunScene& scene, MethodCase& method, std::size_t view, std::size_t light,
                      std::optional<render::FrameClock> clock) {
  CaseAnswers answers = drawnAnswers(scene, method, view, light, clock);
  requireAnswers(scene, method, view, light, answers.drawn);
  const Mask& truth = method.base->views[view].truths[light].mask;
  for (Mask* mask : {&answers.drawn, &answers.test}) {
    std::transform(mask->samples.begin(), mask->samples.end(), truth.samples.begin(),
                   mask->samples.begin(),
                   [](Shade own, Shade right) { return right == Shade::none ? Shade::none : own; });
  }
  for (Visibility* shares : {&answers.drawnShares, &answers.testShares}) {
    for (std::size_t i = 0; i < shares->size(); ++i) {
      if (truth.samples[i] == Shade::none) shares->shares[i] = noSample;
    }
  }
  return answers;
}

cache::ContentKey answerKey(const RunScene& scene, const MethodCase& method, std::size_t view,
                            std::size_t light) {
  const MeshChoice& mesh = method.base->choice;
  return cache::KeyBuilder("answer")
      .add("mask", scene.keys.mask(method.key, mesh, view, light))
      .add("truth", scene.keys.truth(mesh, view, light))
      .key();
}

std::uint64_t tableBytes(RunScene& scene, MethodCase& method) {
  const render::MethodTables& declared = method.method.tables;
  const CompiledMethod& ready = compiled(scene, method);
  const render::GpuTables& tables = ready.tables;
  const auto isRead = [&](const std::string& sampler) { return ready.pass->reads(sampler); };
  std::uint64_t bytes = 0;
  if (declared.horizon && isRead("horizonTable")) bytes += tables.horizon->byteCount();
  if (declared.distance && isRead("distanceTable")) bytes += tables.distance->byteCount();
  if (declared.ellipse && isRead("ellipseTable")) bytes += tables.ellipse->byteCount();
  if (tables.angles != nullptr) bytes += tables.angles->byteCount();
  for (const render::MethodBake& bake : method.method.bakes) {
    if (isRead(bake.sampler())) bytes += render::bytesOver(bake, scene.heights.size());
  }
  const auto& views = scene.study.views;
  const auto camera = std::find_if(views.begin(), views.end(), cameraOf);
  const auto place = static_cast<std::size_t>(camera - views.begin());
  const render::RenderView* view =
      camera == views.end() ? nullptr : &method.base->views[place].view;
  return bytes + ready.pass->textureBytes() +
         ready.pass->passBytes(view, drawingOf(scene, method, 0), tables);
}

}  // namespace gnomon::study
