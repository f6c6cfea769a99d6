#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cache/cache.h"
#include "common/error.h"
#include "render/check/pass_check.h"
#include "render/gl_context.h"
#include "study/spec/study_file.h"

namespace gnomon {

/// The OpenGL driver draws wrong what a study cannot do without.
class DriverError : public Error {
 public:
  explicit DriverError(const std::string& message) : Error(ExitStatus::internal, message) {}
};

/// What this machine's OpenGL draws wrong. Every kind of pass is checked when it is first asked
/// for, and the answer is kept by vendor, renderer and version of the driver, by the shaders and by
/// the program.
class DriverFaults {
 public:
  /// Of the context that is current, and stays so while it is asked.
  /// @param kept  outlives it
  DriverFaults(std::filesystem::path shaders, Cache& kept);

  /// Why a method cannot be measured: the first kind of pass that it needs and that is drawn wrong,
  /// "this OpenGL gets shadow volumes wrong: …"; empty where all are right.
  /// @throws InputError for a method that cannot be read, as readMethod
  std::string faultOf(const MethodSpec& method);

  /// @throws DriverError where a kind of pass is drawn wrong
  void require(PassKind kind);
  /// @throws DriverError where the samples of the study's views, which all its methods need, or its
  ///   pictures are drawn wrong
  void requireViews(const StudySpec& study);

 private:
  /// As `passFault`.
  const std::string& passFault(PassKind kind);
  std::string faultText(PassKind kind, const std::string& fault) const;

  GlDriver driver_;
  std::filesystem::path shaders_;
  Cache& cache_;
  ContentKey key_;
  std::map<PassKind, std::string> found_;
};

}  // namespace gnomon
