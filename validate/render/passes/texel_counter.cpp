#include "render/passes/texel_counter.h"

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
  double sum = 0;
  std::size_t samples = 0;
  for (const float count : texels) {
    if (count < 0) continue;
    sum += static_cast<double>(count);
    ++samples;
  }
  return sum / static_cast<double>(samples);
}

}  // namespace gnomon::render
