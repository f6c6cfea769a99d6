#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

/// Marks what the shared library exports.
#define GNOMON_API __attribute__((visibility("default")))

/// Users write `gnomon::NAME`. The inline namespace keeps these names apart from those inside the
/// library when both are linked.
namespace gnomon {
inline namespace api {

/// What kind of failure an Exception reports. The values are the exit statuses of the program.
enum class FailureKind : int {
  badInput = 3,   ///< a file, number, size or shader is missing, malformed or out of range
  internal = 4,   ///< out of memory, an OpenGL driver that draws wrong, or a fault in Gnomon
  noOpenGl = 77,  ///< this machine has no OpenGL 4.5
  stopped = 130,  ///< a StopSwitch ended the call
};

/// The only type of exception that the library throws. Its message is one line: the file or
/// parameter, what was found, what was expected.
class GNOMON_API Exception : public std::runtime_error {
 public:
  Exception(FailureKind kind, const std::string& message);
  [[nodiscard]] FailureKind kind() const noexcept { return kind_; }

 private:
  FailureKind kind_;
};

/// Lets another thread end calls of the library, those too that report no progress.
class GNOMON_API StopSwitch {
 public:
  StopSwitch();
  ~StopSwitch();
  StopSwitch(const StopSwitch&) = delete;
  StopSwitch& operator=(const StopSwitch&) = delete;

  /// Does work that calls the library, on this thread and once.
  /// @throws Exception  stopped, where `stop` ended it; else what the work throws
  void run(const std::function<void()>& work);
  /// Ends the calls that the work makes, within a fraction of a second. From any thread, at any
  /// time.
  void stop();

 private:
  struct Inner;
  std::unique_ptr<Inner> inner_;
};

}  // namespace api
}  // namespace gnomon
