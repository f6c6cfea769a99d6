#pragma once

#include "render/gl_context.h"
#include "study/record.h"

namespace gnomon {

/// Versions and hardware of this process: what someone needs who gets other figures.
EnvironmentRecord describeEnvironment(const GlContext& gl);

}  // namespace gnomon
