#include "cli/failure.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>

#include "common/text/one_line.h"
#include "report/ci/github_annotations.h"

namespace gnomon::cli {
namespace {

/// One line, with no control character at its end. Messages quote what was found, which may be of
/// any length.
std::string cleaned(std::string_view message) {
  constexpr std::size_t longest = 1500;  // bytes
  std::string line = oneLine(message);
  if (line.size() > longest) {
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0U) == 0x80U) --end;
    line = line.substr(0, end) + "…";
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

Failure currentFailure() {
  try {
    throw;
  } catch (const Error& error) {
    return {error.status(), cleaned(error.what())};
  } catch (const std::filesystem::filesystem_error& error) {
    // A folder without permission, a name that is too long, a full disk.
    return {ExitStatus::badInput,
            cleaned(fmt::format("{}: {}", error.path1().string(), error.code().message()))};
  } catch (const std::bad_alloc&) {
    return {ExitStatus::internal, "out of memory"};
  } catch (const std::exception& error) {
    return {ExitStatus::internal, cleaned(fmt::format("internal error: {}", error.what()))};
  } catch (...) {
    return {ExitStatus::internal, "internal error: of a kind that is not known"};
  }
}

void printWarning(const std::string& text) {
  printError(report::withoutWorkflowCommands(fmt::format("gnomon: warning: {}\n", cleaned(text))));
}

void printFailure(const Failure& failure) {
  printError(report::withoutWorkflowCommands(fmt::format("gnomon: {}\n", failure.message)));
}

void Failures::print() const {
  for (const Failure& failure : all_) printFailure(failure);
}

ExitStatus Failures::status() const {
  ExitStatus worst = ExitStatus::pass;
  for (const Failure& failure : all_) worst = std::max(worst, failure.status);
  return worst;
}

}  // namespace gnomon::cli
