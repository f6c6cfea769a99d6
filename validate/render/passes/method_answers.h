#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/mask.h"
#include "render/gpu_scene.h"

namespace gnomon::render {

/// Numbers of a method that are no answer, one bit each (answers.glsl).
enum class AnswerFault : std::uint8_t {
  share = 1,    ///< `visibility` is no number, or not from 0 to 1
  horizon = 2,  ///< `horizonSlope` is no number
  normal = 4,   ///< `shadingNormal` is no unit vector
};

/// A sample at which a method's answer means nothing.
struct FaultySample {
  std::size_t sample;
  std::uint8_t faults;  ///< of `AnswerFault`
};

/// A method's two answers for every sample of a view.
struct MethodAnswers {
  /// The score: dark in the method's picture, by its shadow test or because the normal that the
  /// picture is shaded with is turned from the light (shading.glsl), as every published method
  /// multiplies its shadows with diffuse light.
  Mask drawn;
  /// The result of `isShadowed` alone.
  Mask test;
  /// The share of the samples whose answer met a texel of another chart than their own.
  double otherChartShare = 0;
  /// In the order of the samples. A cache keeps none: such answers are refused.
  std::vector<FaultySample> faulty = {};
};

/// A method's two answers as shares of the light's disc, 0 to 1 for every sample of a view.
struct VisibilityAnswers {
  /// The score. Of a method that answers with a share, the smaller of `test` and the share of the
  /// disc in front of the plane of the normal that its picture is shaded with (visibility.frag); of
  /// others `MethodAnswers::drawn`, 1 where it is lit and 0 where not.
  Visibility drawn;
  /// What the method's `visibility` or its horizon says; of others `MethodAnswers::test` as 1 and
  /// 0.
  Visibility test;
  double otherChartShare = 0;             ///< as of MethodAnswers
  std::vector<FaultySample> faulty = {};  ///< as of MethodAnswers
};

/// What mask.frag leaves at a pixel without a sample.
constexpr std::uint8_t noAnswer = 4;
/// What visibility.frag leaves there, as do counts of texels and turns: all others are 0 or more.
/// What is no answer is less, by its AnswerFault.
constexpr float noShare = -1;

/// The answers that a frame of mask.frag holds.
/// @param bits  one a pixel
MethodAnswers answersOf(const RenderView& view, const std::vector<std::uint8_t>& bits);
/// The answers that a frame of visibility.frag holds.
/// @param drawn, test, met  its attachments, one a pixel
VisibilityAnswers answersOf(const RenderView& view, std::vector<float> drawn,
                            std::vector<float> test, const std::vector<std::uint8_t>& met);
/// Shares of 0 and 1, of a method that answers with no others.
VisibilityAnswers asShares(MethodAnswers answers);

}  // namespace gnomon::render
