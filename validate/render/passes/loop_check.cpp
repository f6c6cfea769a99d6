#include "render/passes/loop_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "render/glsl_text.h"

namespace gnomon::render {

bool hasLoops(const Method& method) {
  return placeOfWord(method.code, "for") || placeOfWord(method.code, "while");
}

MethodStage boundedStage(MethodStage stage, const std::string& result) {
  stage.endsLoops = true;
  stage.before.push_back({"(count of loops)",
                          fmt::format("uint loopTurns = 0u;\n"
                                      "bool nextTurn() {{ return ++loopTurns < {}u; }}\n"
                                      "#define main countedMain\n",
                                      mostLoopTurns),
                          1});
  stage.fragment.push_back(
      {"(count of loops)",
       fmt::format("#undef main\nvoid main() {{\n  countedMain();\n  {};\n}}\n", result), 1});
  return stage;
}

MethodStage endlessStage(MethodStage stage) {
  return boundedStage(std::move(stage),
                      fmt::format("stored = vec4(loopTurns < {}u ? 0.0 : 1.0)", mostLoopTurns));
}

LoopCheck::LoopCheck(const std::filesystem::path& shaders, const Method& method, relief::Wrap wrap,
                     TableFilter filter, const std::map<std::string, double>& values,
                     SoftAnswer soft) {
  const std::vector<std::string> defines = methodDefines(method, wrap, filter);
  std::vector<std::string> softDefines = defines;
  const std::optional<std::string> added = softDefine(method, soft);
  if (added) softDefines.push_back(*added);
  const std::map<std::string, double> all = parameterValues(method, values);
  answer_ = makeMethodProgram(shaders, method,
                              boundedStage(countingStage(shaders), "texels = float(loopTurns)"),
                              softDefines);
  setParameters(answer_.name(), method, all);
  const std::vector<OwnPass> passes = ownPasses(method);
  for (const OwnPass& pass : passes) {
    passes_.push_back(makeMethodProgram(
        shaders, method, endlessStage(ownPassStage(shaders, method, pass, passes)), defines));
    setParameters(passes_.back().name(), method, all);
  }
}

}  // namespace gnomon::render
