#pragma once

#include <functional>
#include <memory>

#include "gnomon/exception.h"

namespace gnomon {
inline namespace api {

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
