#pragma once

#include <string>

#include "render/method.h"
#include "render/shader_files.h"

namespace gnomon::test {

/// A method of the shaders' own folder.
inline render::Method methodOf(const std::string& name) {
  return render::readMethod(render::methodFile(render::shaderFolder(), name));
}

}  // namespace gnomon::test
