#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "cache/cache.h"
#include "common/error.h"
#include "render/gl_context.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// A shader can crash the OpenGL driver that compiles it, or take all memory there, and would end
/// the whole run. So a method that does not come with the program first answers for some pixels of
/// a small scene in a process of its own, which has 60 seconds of the processor and 4 GB, or half
/// of what is available where that is less. A method that has passed is not tried again on the same
/// driver while the cache keeps that.

/// Tries the methods of a study, and of its ladders, that do not come with the program.
/// @param gl  whose driver compiles them
/// @throws InputError naming method and file of one whose trial crashes or exceeds its memory or
///   time. Any other fault, as of a shader that does not compile, is left to the run
void tryMethods(const StudySpec& study, const render::GlContext& gl, cache::Cache& cache);

/// Tries one method, unless it comes with the program. @throws InputError as tryMethods
/// @param wrap  of the relief that it is to be drawn on
/// @return whether it answered
bool tryMethod(const MethodSpec& method, relief::Wrap wrap);

/// Tries one method, as `tryMethod`.
using MethodTrial = std::function<void(const MethodSpec& method, relief::Wrap wrap)>;

/// The program's first argument in such a process, before those of a trial.
constexpr const char* trialArgument = "--try-method";

/// Runs a trial in the process that was started for it.
/// @param arguments  file, filter and wrap, as `tryMethods` gives them
ExitStatus answerTrial(std::span<const std::string> arguments);

}  // namespace gnomon::study
