#include "render/passes/texel_counter.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "common/parallel.h"
#include "render/shader_files.h"

namespace gnomon::render {

TexelCounter::TexelCounter(const std::filesystem::path& shaders, const Method& method,
                           relief::Wrap wrap, TableFilter filter,
                           const std::map<std::string, double>& values, SoftAnswer soft) {
  std::vector<std::string> defines = methodDefines(method, wrap, filter);
  const std::optional<std::string> added = softDefine(method, soft);
  if (added) defines.push_back(*added);
  program_ = makeMethodProgram(shaders, method, countingStage(shaders), defines);
  setParameters(program_.name(), method, parameterValues(method, values));
}

double meanOfSamples(const std::vector<float>& texels) {
  // Counts are whole numbers: their sum is exact in any order. Several sums need not wait for each
  // other.
  struct Part {
    std::array<double, 8> sums{};
    std::array<std::uint32_t, 8> samples{};
  };
  constexpr std::size_t texelsAtOnce = 1 << 16;
  std::vector<Part> parts((texels.size() + texelsAtOnce - 1) / texelsAtOnce);
  parallelFor(0, parts.size(), [&](std::size_t p) {
    Part& part = parts[p];
    const std::size_t end = std::min((p + 1) * texelsAtOnce, texels.size());
    for (std::size_t i = p * texelsAtOnce; i < end; ++i) {
      const bool isSample = texels[i] >= 0;
      part.sums[i % 8] += isSample ? static_cast<double>(texels[i]) : 0.0;
      part.samples[i % 8] += static_cast<std::uint32_t>(isSample);
    }
  });
  double sum = 0;
  double samples = 0;
  for (const Part& part : parts) {
    sum += std::accumulate(part.sums.begin(), part.sums.end(), 0.0);
    samples += std::accumulate(part.samples.begin(), part.samples.end(), 0.0);
  }
  return sum / samples;
}

bool hasLoops(const Method& method) {
  return placeOfWord(method.code, "for") || placeOfWord(method.code, "while");
}

MethodStage boundedStage(MethodStage stage, const std::string& result) {
  stage.endsLoops = true;
  stage.before.push_back({"(count of loops)",
                          fmt::format("uint loopTurns = 0u;\n"
                                      "bool nextTurn() {{ return ++loopTurns < {}u; }}\n"
                                      "#define main countedMain\n",
                                      mostLoopIterations),
                          1});
  stage.fragment.push_back(
      {"(count of loops)",
       fmt::format("#undef main\nvoid main() {{\n  countedMain();\n  {};\n}}\n", result), 1});
  return stage;
}

MethodStage endlessStage(MethodStage stage) {
  return boundedStage(std::move(stage), fmt::format("stored = vec4(loopTurns < {}u ? 0.0 : 1.0)",
                                                    mostLoopIterations));
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
