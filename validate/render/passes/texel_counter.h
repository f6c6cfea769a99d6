#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "relief/relief.h"
#include "render/gl_handles.h"
#include "render/method.h"
#include "render/passes/drawing.h"
#include "render/passes/method_tables.h"
#include "render/passes/soft_answer.h"

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

}  // namespace gnomon::render
