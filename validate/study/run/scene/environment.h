#pragma once

#include <string>

#include "render/gl_context.h"
#include "study/record/record.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// The processor's name as the kernel knows it, or "unknown".
std::string processorName();

/// What the processor can do, as the kernel lists it: "fpu … avx2 … avx512f …"; empty where it does
/// not tell.
std::string processorFeatures();

/// Of the program, "0.1.0".
std::string programVersion();

/// Of the sources that the program was built from, or empty outside a checkout.
std::string programCommit();

/// Versions and hardware, for whoever gets other figures.
EnvironmentRecord describeEnvironment(const render::GlContext& gl);

/// The names of the views whose lengths are in texels.
std::vector<std::string> atlasViewsOf(const StudySpec& study);

/// A record that says which study was measured where, and nothing that was found.
StudyRecord startRecord(const StudySpec& study, const render::GlContext& gl);

}  // namespace gnomon::study
