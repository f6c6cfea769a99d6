#pragma once

#include <string>

#include "render/gl_context.h"
#include "study/record/record.h"
#include "study/spec/study_file.h"

namespace gnomon {

/// The processor's name as the kernel knows it, or "unknown".
std::string processorName();

/// Versions and hardware, for whoever gets other figures.
EnvironmentRecord describeEnvironment(const GlContext& gl);

/// A record that says which study was measured where, and nothing that was found.
StudyRecord startRecord(const StudySpec& study, const GlContext& gl);

}  // namespace gnomon
