#include "render/passes/texel_counter.h"

#include <array>
#include <cstddef>
#include <numeric>
#include <optional>

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
  std::array<double, 8> sums{};
  std::size_t samples = 0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const bool isSample = texels[i] >= 0;
    sums[i % sums.size()] += isSample ? static_cast<double>(texels[i]) : 0.0;
    samples += static_cast<std::size_t>(isSample);
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(samples);
}

}  // namespace gnomon::render
