#include "gnomon/exception.h"

#include "api/inner/translated.h"
#include "cli/failure.h"

namespace gnomon {
inline namespace api {

Exception::Exception(FailureKind kind, const std::string& message)
    : std::runtime_error(message), kind_(kind) {}

void throwTranslated() {
  try {
    throw;
  } catch (const Exception&) {
    throw;
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

}  // namespace api
}  // namespace gnomon
