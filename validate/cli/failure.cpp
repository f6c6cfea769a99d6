#include "cli/failure.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <new>

namespace gnomon {
namespace {

/// Without line breaks and other controls; none at its end.
std::string oneLine(std::string message) {
  const auto isControl = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  message.erase(std::find_if_not(message.rbegin(), message.rend(), isControl).base(),
                message.end());
  std::replace_if(message.begin(), message.end(), isControl, ' ');
  return message;
}

}  // namespace

Failure currentFailure() {
  try {
    throw;
  } catch (const Error& error) {
    return {error.status(), oneLine(error.what())};
  } catch (const std::bad_alloc&) {
    return {ExitStatus::internal, "out of memory"};
  } catch (const std::exception& error) {
    return {ExitStatus::internal, oneLine(fmt::format("internal error: {}", error.what()))};
  } catch (...) {
    return {ExitStatus::internal, "internal error: of a kind that is not known"};
  }
}

void printFailure(const Failure& failure) {
  fmt::print(stderr, "gnomon: {}\n", failure.message);
}

}  // namespace gnomon
