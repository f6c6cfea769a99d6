#pragma once

#include <stdexcept>
#include <string>

namespace gnomon {

/// What the process returns to its caller. A build server tells these apart.
enum class ExitStatus : int {
  pass = 0,
  thresholdFailed = 1,
  usage = 2,
  badInput = 3,
  internal = 4,  ///< also: out of memory
  noGl = 77,     ///< the status by which test drivers know a skipped test
};

/// Base of every error that Gnomon raises. The message is one line: the file, line or key, what was
/// found, what was expected. Caught once, in `cli`, which returns `status()`.
class Error : public std::runtime_error {
 public:
  /// @param parameter  of the function that fails, by its name in the header; the message then
  ///   begins with it, "step: 0 texels found". Code that read the value from a file puts the key in
  ///   its place (`withKeys`)
  Error(ExitStatus status, const std::string& message, const std::string& parameter = {})
      : std::runtime_error(parameter.empty() ? message : parameter + ": " + message),
        status_(status),
        parameter_(parameter) {}
  [[nodiscard]] ExitStatus status() const { return status_; }
  /// The parameter whose value is wrong; empty where the message names none.
  [[nodiscard]] const std::string& parameter() const { return parameter_; }
  /// The message without the parameter.
  [[nodiscard]] std::string reason() const {
    return std::string(what()).substr(parameter_.empty() ? 0 : parameter_.size() + 2);
  }

 private:
  ExitStatus status_;
  std::string parameter_;
};

/// The command line asks for something that does not exist or contradicts itself.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitStatus::usage, message) {}
};

/// A study, mesh, image or shader is missing, malformed or out of range.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message, const std::string& parameter = {})
      : Error(ExitStatus::badInput, message, parameter) {}
};

/// Something failed that no input should be able to cause.
class InternalError : public Error {
 public:
  explicit InternalError(const std::string& message) : Error(ExitStatus::internal, message) {}
};

/// A request needs more memory than there is. The message holds both figures.
class MemoryError : public Error {
 public:
  explicit MemoryError(const std::string& message, const std::string& parameter = {})
      : Error(ExitStatus::internal, message, parameter) {}
};

/// No OpenGL 4.5 context can be had on this machine.
class NoGlError : public Error {
 public:
  explicit NoGlError(const std::string& message) : Error(ExitStatus::noGl, message) {}
};

}  // namespace gnomon
