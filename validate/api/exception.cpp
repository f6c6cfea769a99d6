#include "gnomon/exception.h"

#include <unistd.h>

#include "api/inner/conversions.h"
#include "cli/output.h"
#include "common/progress.h"

namespace gnomon {
inline namespace api {

Exception::Exception(FailureKind kind, const std::string& message)
    : std::runtime_error(message), kind_(kind) {}

void requireOwnProcess() {
  static const pid_t first = getpid();
  if (getpid() == first) return;
  throw Exception(
      FailureKind::internal,
      "this process is a fork of one that had used gnomon, whose threads do not live on "
      "in it: start processes by \"spawn\" (in Python "
      "multiprocessing.get_context(\"spawn\")), or fork before the first call");
}

void throwTranslated() {
  try {
    throw;
  } catch (const Exception&) {
    throw;
  } catch (const Cancelled&) {
    throw Exception(FailureKind::stopped, "stopped by another thread");
  } catch (...) {
    const cli::Failure failure = cli::currentFailure();
    switch (failure.status) {
      case ExitStatus::noGl:
        throw Exception(FailureKind::noOpenGl, failure.message);
      case ExitStatus::usage:
      case ExitStatus::badInput:
        throw Exception(FailureKind::badInput, failure.message);
      default:
        throw Exception(FailureKind::internal, failure.message);
    }
  }
}

struct StopSwitch::Inner {
  Cancellation cancellation;
};

StopSwitch::StopSwitch() : inner_(std::make_unique<Inner>()) {}
StopSwitch::~StopSwitch() = default;

void StopSwitch::run(const std::function<void()>& work) {
  try {
    inner_->cancellation.run(work);
  } catch (const Cancelled&) {
    throwTranslated();
  }
}

void StopSwitch::stop() {
  inner_->cancellation.cancel();
}

}  // namespace api
}  // namespace gnomon
