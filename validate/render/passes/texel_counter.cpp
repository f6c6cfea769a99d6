#include "render/passes/texel_counter.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>

#include "common/parallel.h"
#include "render/passes/method_program.h"

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

}  // namespace gnomon::render
