#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cache/cache.h"
#include "common/error.h"
#include "render/check/pass_check.h"
#include "render/gl_context.h"
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

}  // namespace gnomon::study
