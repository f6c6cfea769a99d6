#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cache/cache.h"
#include "common/error.h"
#include "render/check/pass_check.h"
#include "render/gl_context.h"
#include "study/record/record.h"
#include "study/run/stages/run_writer.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// The OpenGL driver renders something incorrectly that a study needs.
class DriverError : public Error {
 public:
  explicit DriverError(const std::string& message) : Error(ExitStatus::internal, message) {}
};

/// Finds the kinds of pass that this machine's OpenGL driver renders incorrectly. Each kind is
/// checked at its first use; the result is cached by vendor, renderer and version of the driver, by
/// the shaders and by the program.
class DriverFaults {
 public:
  /// Of the context that is current, and stays so while it is asked.
  /// @param kept  outlives it
  DriverFaults(std::filesystem::path shaders, cache::Cache& kept);

  /// Why a method cannot be measured: the first kind of pass that it needs and that is rendered
  /// incorrectly, "this OpenGL gets shadow volumes wrong: …"; empty where all are correct.
  /// @param isSoft  whether it answers with shares, under a disc of light
  /// @throws InputError for a method that cannot be read, as readMethod
  std::string faultOf(const MethodSpec& method, bool isSoft = false);

  /// @throws DriverError where a kind of pass is rendered incorrectly
  void require(render::PassKind kind);
  /// @throws DriverError where the samples of the study's views, which all its methods need, or its
  ///   pictures are rendered incorrectly
  void requireViews(const StudySpec& study);

 private:
  /// As `passFault`.
  const std::string& passFault(render::PassKind kind);
  std::string faultText(render::PassKind kind, const std::string& fault) const;

  render::GlDriver driver_;
  std::filesystem::path shaders_;
  cache::Cache& cache_;
  cache::ContentKey key_;
  std::map<render::PassKind, std::string> found_;
};

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

/// The part of a study that the driver can measure.
struct MeasurableStudy {
  std::vector<RefusedMethod> refused;
  /// The study without them and their ladders; none where nothing is refused.
  std::optional<StudySpec> reduced;
};

/// Refuses the methods that need a pass that the driver draws wrong.
/// @throws DriverError where no method is left, where another state of a ladder that is left needs
///   such a pass, and as DriverFaults::requireViews
MeasurableStudy measurable(const StudySpec& study, DriverFaults& faults);

/// Adds the refused methods to a record: for each a notice and a problem, so that the run does not
/// pass, and an undefined value, which fails, for each of its gates.
/// @param study  as its file asks for it
void addRefused(StudyRecord& record, const StudySpec& study,
                const std::vector<RefusedMethod>& refused);

/// Writes nothing: for a run of which only the figures are wanted.
class NoFiles : public RunWriter {
 public:
  [[nodiscard]] std::string mask(const Mask&) const override { return {}; }
  [[nodiscard]] std::string shares(const Visibility&) const override { return {}; }
  [[nodiscard]] std::string regions(const truth::Truth&) const override { return {}; }
  [[nodiscard]] std::string weights(int, int, const std::vector<double>&) const override {
    return {};
  }
  [[nodiscard]] std::string picture(int, int, std::vector<std::uint8_t>) const override {
    return {};
  }
  [[nodiscard]] std::string difference(const Mask&, const Mask&) const override { return {}; }
  [[nodiscard]] std::string difference(const Visibility&, const Visibility&) const override {
    return {};
  }
  [[nodiscard]] std::string embedded(int, int, std::vector<std::uint8_t>,
                                     EmbeddedSize) const override {
    return {};
  }
  [[nodiscard]] std::vector<std::uint8_t> displaced(int, int,
                                                    const std::vector<float>&) const override {
    return {};
  }
  void write(const std::string&, const std::string&) override {}
};

}  // namespace gnomon::study
