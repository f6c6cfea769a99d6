#include "study/run/method_trial.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "common/lists.h"
#include "common/system/memory.h"
#include "common/system/process.h"
#include "relief/patterns.h"
#include "study/run/run_study.h"
#include "study/run/scene/run_keys.h"
#include "study/spec/method_changes.h"
#include "study/spec/sections/method_section.h"
#include "surface/cage/shapes.h"

namespace gnomon::study {
namespace {

cache::ContentKey driverKey(const render::GlDriver& gl, const std::filesystem::path& shaders) {
  cache::KeyBuilder key("driver");
  key.add("vendor", gl.vendor).add("renderer", gl.renderer).add("gl", gl.version);
  return key.add("shaders", shadersKey(shaders)).key();
}

}  // namespace

DriverFaults::DriverFaults(std::filesystem::path shaders, cache::Cache& kept)
    : driver_(render::currentDriver()),
      shaders_(std::move(shaders)),
      cache_(kept),
      key_(driverKey(driver_, shaders_)) {}

const std::string& DriverFaults::passFault(render::PassKind kind) {
  const auto known = found_.find(kind);
  if (known != found_.end()) return known->second;
  const cache::ContentKey key =
      cache::KeyBuilder("pass").add("driver", key_).add("pass", kind).key();
  return found_
      .emplace(kind, cache_.remember(key, [&] { return render::passFault(kind, shaders_); }))
      .first->second;
}

std::string DriverFaults::faultText(render::PassKind kind, const std::string& fault) const {
  return fmt::format(
      "this OpenGL gets {} wrong: {} in a scene that is known in closed form ({}, {})",
      render::passName(kind), fault, driver_.renderer, driver_.version);
}

std::string DriverFaults::faultOf(const MethodSpec& method, bool isSoft) {
  const auto kinds = render::passesOf(declarationOf(method), method.filter, isSoft);
  for (const render::PassKind kind : kinds) {
    const std::string& fault = passFault(kind);
    if (!fault.empty()) return faultText(kind, fault);
  }
  return "";
}

void DriverFaults::require(render::PassKind kind) {
  const std::string& fault = passFault(kind);
  if (!fault.empty()) {
    throw DriverError(fmt::format("nothing is measured: {}", faultText(kind, fault)));
  }
}

void DriverFaults::requireViews(const StudySpec& study) {
  for (const ViewSpec& view : study.views) {
    require(traitsOf(view).samplesPass);
  }
  require(render::PassKind::pictures);
}

namespace {

ProcessLimits trialLimits() {
  constexpr double mostBytes = 4e9;
  constexpr double seconds = 60;
  return {std::min(mostBytes, static_cast<double>(availableMemoryBytes()) / 2), seconds};
}

/// Columns on a plane, one light, one camera of 16 × 16 pixels: a fifth of a second.
StudySpec trialStudy(MethodSpec method, relief::Wrap wrap) {
  constexpr int texels = 16;
  constexpr double side = texels;
  StudySpec study{{.name = "trial", .title = "A method's trial"},
                  {},
                  surface::makePlane(side, side, 1, 1),
                  {relief::makeColumns(texels, texels, {8, 2, 1}, 2, wrap)}};
  study.bake.settings = {4, 8};
  study.truth.stepTexels = 0.5;
  Camera camera;
  camera.eye = {0, 0, 40};
  camera.verticalFov = radians(25);
  camera.width = camera.height = texels;
  study.views.push_back({"camera", camera});
  study.lights.push_back(makeLight({20, 30}, "light"));
  method.bake = study.bake;
  study.methods.push_back(std::move(method));
  return study;
}

std::vector<std::string> argumentsOf(const MethodSpec& method, relief::Wrap wrap) {
  return {trialArgument, method.file.string(),
          method.filter == render::TableFilter::hardware ? "hardware" : "exact",
          wrap == relief::Wrap::clamp ? "clamp" : "repeat"};
}

/// Every method of others that the study draws, each once.
std::vector<const MethodSpec*> foreignMethods(const StudySpec& study) {
  std::vector<const MethodSpec*> methods;
  const auto add = [&](const std::vector<MethodSpec>& from) {
    for (const MethodSpec& method : from) {
      if (isBuiltIn(method) || method.isGiven()) continue;
      const bool isKnown = std::any_of(methods.begin(), methods.end(), [&](const auto* known) {
        return known->file == method.file && known->filter == method.filter;
      });
      if (!isKnown) methods.push_back(&method);
    }
  };
  add(study.methods);
  for (const LadderSpec& ladder : study.ladders) {
    add(ladder.forward);
    add(ladder.backward);
  }
  return methods;
}

/// Its statuses of its own accord: any other is one that a driver ended it with.
bool isOfItsOwnAccord(int status) {
  return status == static_cast<int>(ExitStatus::pass) ||
         status == static_cast<int>(ExitStatus::badInput) ||
         status == static_cast<int>(ExitStatus::noGl);
}

std::string whatHappened(const ProcessOutcome& outcome, const ProcessLimits& limits) {
  switch (outcome.end) {
    case ProcessEnd::crashed:
      return fmt::format("the OpenGL driver crashes on its shader (signal {})", outcome.code);
    case ProcessEnd::outgrew:
      return fmt::format("its shader takes more than {} in the OpenGL driver",
                         formatBytes(limits.bytes));
    case ProcessEnd::overstayed:
      return fmt::format("its shader takes the OpenGL driver more than {} s", limits.seconds);
    case ProcessEnd::exited:
      break;
  }
  return fmt::format("the OpenGL driver gives up on its shader (status {})", outcome.code);
}

}  // namespace

bool tryMethod(const MethodSpec& method, relief::Wrap wrap) {
  if (isBuiltIn(method)) return true;
  const ProcessLimits limits = trialLimits();
  const ProcessOutcome outcome = runSelf(argumentsOf(method, wrap), limits);
  if (outcome.end == ProcessEnd::exited && isOfItsOwnAccord(outcome.code)) {
    return outcome.code == static_cast<int>(ExitStatus::pass);
  }
  throw InputError(fmt::format("method \"{}\" ({}): {}", method.label, method.file.string(),
                               whatHappened(outcome, limits)));
}

void tryMethods(const StudySpec& study, const render::GlContext& gl, cache::Cache& cache) {
  const std::vector<const MethodSpec*> methods = foreignMethods(study);
  if (methods.empty()) return;
  const RunKeys keys(study, gl, render::shaderFolder());
  for (const MethodSpec* method : methods) {
    const cache::ContentKey key =
        cache::KeyBuilder("trial")
            .add("method", keys.method(*method, render::readMethod(method->file)))
            .key();
    if (cache.find<bool>(key)) continue;
    if (tryMethod(*method, study.relief.field.wrap())) cache.keep(key, true);
  }
}

ExitStatus answerTrial(std::span<const std::string> arguments) {
  beChildProcess(trialLimits());
  if (arguments.size() != 3) throw UsageError("a trial: file, filter and wrap expected");
  MethodSpec method;
  method.file = arguments[0];
  method.label = "trial";
  method.filter =
      arguments[1] == "hardware" ? render::TableFilter::hardware : render::TableFilter::exact;
  const StudySpec study = trialStudy(
      std::move(method), arguments[2] == "clamp" ? relief::Wrap::clamp : relief::Wrap::repeat);
  const render::GlContext gl;
  cache::Cache none;
  (void)measureStudy(study, gl, none);
  return ExitStatus::pass;
}

namespace {

bool speaksOf(const std::string& filter, const std::string& name) {
  return filter.empty() || filter == name;
}

/// The gates of one refused method, one for each view and light.
void addGates(StudyRecord& record, const StudySpec& study, const RefusedMethod& method) {
  for (const Gate& gate : study.thresholds) {
    if (!speaksOf(gate.method, method.label)) continue;
    for (const ViewSpec& view : study.views) {
      for (const Light& light : study.lights) {
        if (!speaksOf(gate.view, view.name) || !speaksOf(gate.light, light.name)) continue;
        Gate row = gate;
        row.method = method.label;
        row.view = view.name;
        row.light = light.name;
        row.step = record.name;
        record.judgements.push_back({std::move(row), GateVerdict::undefined, {}, method.reason});
      }
    }
  }
}

}  // namespace

MeasurableStudy measurable(const StudySpec& study, DriverFaults& faults) {
  faults.requireViews(study);
  MeasurableStudy left;
  std::vector<std::string> labels;
  const bool isSoft = std::any_of(study.lights.begin(), study.lights.end(),
                                  [](const Light& light) { return light.isSoft(); });
  for (const MethodSpec& method : study.methods) {
    std::string fault = faults.faultOf(method, isSoft);
    if (fault.empty()) continue;
    labels.push_back(method.label);
    left.refused.push_back({method.label, std::move(fault)});
  }
  if (!study.methods.empty() && labels.size() == study.methods.size()) {
    throw DriverError(fmt::format("nothing is measured: {}", left.refused.front().reason));
  }
  const auto isWrong = [&](const MethodSpec& state) {
    return !faults.faultOf(state, isSoft).empty();
  };
  for (const LadderSpec& ladder : study.ladders) {
    const auto state = std::find_if(ladder.forward.begin(), ladder.forward.end(), isWrong);
    const auto other = std::find_if(ladder.backward.begin(), ladder.backward.end(), isWrong);
    if (state == ladder.forward.end() && other == ladder.backward.end()) continue;
    if (contains(labels, ladder.method)) continue;
    const MethodSpec& wrong = state != ladder.forward.end() ? *state : *other;
    throw DriverError(fmt::format("the ladder of {} is not measured: {}", ladder.method,
                                  faults.faultOf(wrong, isSoft)));
  }
  if (!labels.empty()) left.reduced = withoutMethods(study, labels);
  return left;
}

void addRefused(StudyRecord& record, const StudySpec& study,
                const std::vector<RefusedMethod>& refused) {
  record.refused = refused;
  std::vector<std::string> texts;
  for (const RefusedMethod& method : refused) {
    texts.push_back(fmt::format("{} is not measured: {}", method.label, method.reason));
    record.problems.push_back({"method", ExitStatus::internal, texts.back()});
    addGates(record, study, method);
  }
  record.notices.insert(record.notices.begin(), texts.begin(), texts.end());
}

}  // namespace gnomon::study
