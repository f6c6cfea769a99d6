#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "relief/relief.h"
#include "render/gl_objects.h"
#include "render/method.h"
#include "render/passes/drawing.h"
#include "render/passes/method_program.h"

namespace gnomon::render {

/// A method's answer with the texels counted that it reads: one a texelFetch, four a textureGather,
/// those of a linear filter for texture and textureLod; with those of the normal that the picture
/// is shaded with.
class TexelCounter {
 public:
  /// @param values  as of MethodPass
  /// @throws InputError as MethodPass
  TexelCounter(const std::filesystem::path& shaders, const Method& method, relief::Wrap wrap,
               TableFilter filter, const std::map<std::string, double>& values,
               SoftAnswer soft = SoftAnswer::own);

  /// Draws the number of texels of every pixel's answer, in place of the answer.
  [[nodiscard]] GLuint program() const { return program_.name(); }

 private:
  gl::Program program_;
};

/// The mean of the numbers that are no less than 0; NaN if there is none.
double meanOfSamples(const std::vector<float>& texels);

/// How often the loops of one call of a method's function may turn, all of them together. A loop
/// without an end would hang a GPU, and Mesa's software driver ends all loops of a shader after
/// 65,535 turns without a word: what they find is then no answer. So a method's loops are counted,
/// and ended, before a frame of it is drawn.
constexpr unsigned mostLoopIterations = 32768;

/// Whether a method's own code has a loop.
bool hasLoops(const Method& method);

/// A stage with its loops counted and ended at `mostLoopIterations`.
/// @param result  what its `main` sets in the end, GLSL, of `loopTurns`
MethodStage boundedStage(MethodStage stage, const std::string& result);

/// Of the stage of a pass or a bake: stores 1 where loops were ended, 0 elsewhere.
MethodStage endlessStage(MethodStage stage);

/// A method's answer and passes in this form.
class LoopCheck {
 public:
  /// @param values  as of MethodPass
  /// @throws InputError as MethodPass
  LoopCheck(const std::filesystem::path& shaders, const Method& method, relief::Wrap wrap,
            TableFilter filter, const std::map<std::string, double>& values,
            SoftAnswer soft = SoftAnswer::own);

  /// Draws how often the loops of every pixel's answer turn, in place of the answer.
  [[nodiscard]] GLuint answer() const { return answer_.name(); }
  /// Draws 1 in the first channel where the loops of a pass were ended, 0 elsewhere.
  /// @param place  of `ownPasses`
  [[nodiscard]] GLuint pass(std::size_t place) const { return passes_.at(place).name(); }

 private:
  gl::Program answer_;
  std::vector<gl::Program> passes_;
};

}  // namespace gnomon::render
