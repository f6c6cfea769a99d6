#pragma once

#include <optional>
#include <string>

#include "render/method.h"

namespace gnomon::render {

/// What a method says of a soft light.
enum class SoftAnswer {
  own,   ///< its `visibility`; 0 or 1 where its file has none
  disc,  ///< its horizon held against the disc by the closed form, `shareOver` of disc.glsl
};

/// The define of a method's soft answers; none where it has only 0 and 1 to say.
/// @throws InputError for a disc without a horizon
std::optional<std::string> softDefine(const Method& method, SoftAnswer soft);

}  // namespace gnomon::render
