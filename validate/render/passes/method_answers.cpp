#include "render/passes/method_answers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::render {
namespace {

/// The other bits that mask.frag writes.
constexpr std::uint8_t testShadowed = 1;
constexpr std::uint8_t drawnShadowed = 2;
constexpr std::uint8_t metOtherChart = 8;
constexpr int firstFault = 4;  // the first bit of AnswerFault

double share(std::ptrdiff_t some, std::ptrdiff_t all) {
  return all > 0 ? static_cast<double>(some) / static_cast<double>(all) : 0;
}

Mask maskOf(const RenderView& view, const std::vector<std::uint8_t>& answers, std::uint8_t bit) {
  Mask mask{view.width, view.height, std::vector<Shade>(answers.size())};
  // Without a branch, so that many are done at once.
  std::transform(answers.begin(), answers.end(), mask.samples.begin(), [bit](std::uint8_t answer) {
    const Shade shade = (answer & bit) == 0 ? Shade::lit : Shade::shadowed;
    return answer == noAnswer ? Shade::none : shade;
  });
  return mask;
}

/// The samples whose value tells faults.
/// @param faultsOf  of a value; 0 for none
template <typename Value, typename FaultsOf>
std::vector<FaultySample> faultySamples(const std::vector<Value>& values,
                                        const FaultsOf& faultsOf) {
  std::vector<FaultySample> faulty;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto faults = static_cast<std::uint8_t>(faultsOf(values[i]));
    if (faults != 0) faulty.push_back({i, faults});
  }
  return faulty;
}

Visibility visibilityOf(const RenderView& view, std::vector<float> shares) {
  std::replace(shares.begin(), shares.end(), noShare, noSample);
  return {view.width, view.height, std::move(shares)};
}

Visibility visibilityOf(const Mask& mask) {
  Visibility visibility{mask.width, mask.height, std::vector<float>(mask.size(), noSample)};
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask.samples[i] == Shade::none) continue;
    visibility.shares[i] = mask.samples[i] == Shade::lit ? 1.0F : 0.0F;
  }
  return visibility;
}

}  // namespace

MethodAnswers answersOf(const RenderView& view, const std::vector<std::uint8_t>& bits) {
  const auto met = std::count_if(bits.begin(), bits.end(),
                                 [](std::uint8_t answer) { return (answer & metOtherChart) != 0; });
  const auto samples = std::count_if(bits.begin(), bits.end(),
                                     [](std::uint8_t answer) { return answer != noAnswer; });
  return {maskOf(view, bits, drawnShadowed), maskOf(view, bits, testShadowed), share(met, samples),
          faultySamples(bits, [](std::uint8_t answer) { return answer >> firstFault; })};
}

VisibilityAnswers answersOf(const RenderView& view, std::vector<float> drawn,
                            std::vector<float> test, const std::vector<std::uint8_t>& met) {
  std::vector<FaultySample> faulty = faultySamples(
      test, [](float value) { return value < noShare ? std::lround(noShare - value) : 0; });
  for (const FaultySample& sample : faulty) test[sample.sample] = 0;
  const auto samples =
      std::count_if(drawn.begin(), drawn.end(), [](float answer) { return answer != noShare; });
  const double other = share(std::count(met.begin(), met.end(), std::uint8_t{1}), samples);
  return {visibilityOf(view, std::move(drawn)), visibilityOf(view, std::move(test)), other,
          std::move(faulty)};
}

VisibilityAnswers asShares(MethodAnswers answers) {
  return {visibilityOf(answers.drawn), visibilityOf(answers.test), answers.otherChartShare,
          std::move(answers.faulty)};
}

}  // namespace gnomon::render
