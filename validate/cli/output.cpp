#include "cli/output.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "common/text/one_line.h"
#include "report/ci/github_annotations.h"

namespace gnomon::cli {
namespace {

[[noreturn]] void failOutput(int reason) {
  if (reason == EPIPE) throw ClosedPipe();
  throw InputError(fmt::format("standard output: cannot be written: {}", std::strerror(reason)));
}

/// Whether a stream leads to a terminal that understands more than text.
bool isTerminal(int stream) {
  const char* kind = std::getenv("TERM");
  return isatty(stream) != 0 && kind != nullptr && std::string_view(kind) != "dumb";
}

}  // namespace

void prepareStreams() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest number that is free; opened for reading, so that writing fails.
    if (fcntl(number, F_GETFD) < 0 && errno == EBADF) (void)open("/dev/null", O_RDONLY);
  }
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

void printText(std::string_view text) {
  printUnchanged(report::withoutWorkflowCommands(text));
}

void printLine(std::string_view text) {
  printText(oneLine(text) + "\n");
}

void printUnchanged(std::string_view text) {
  const bool isWritten = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!isWritten || std::fflush(stdout) != 0) failOutput(errno);
}

void printError(std::string_view text) noexcept {
  (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

void flushOutput() {
  const bool isWritten = std::fflush(stdout) == 0;
  if (!isWritten) failOutput(errno);
  if (!isOutputLost()) return;
  // Whoever wrote, as the parser of the command line does, has taken the reason away.
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  const bool hasNoReader = poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
  failOutput(hasNoReader ? EPIPE : EIO);
}

bool isOutputLost() {
  return std::ferror(stdout) != 0;
}

bool isErrorLost() {
  return std::fflush(stderr) != 0 || std::ferror(stderr) != 0;
}

void requireNoInput(const std::string& option, const std::filesystem::path& output,
                    std::span<const std::filesystem::path> inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code isNotThere;
    if (!std::filesystem::equivalent(output, input, isNotThere)) continue;
    throw UsageError(fmt::format("{} {}: the command reads this file, another one expected", option,
                                 output.string()));
  }
}

void requireOther(const std::string& option, const std::filesystem::path& output,
                  const std::string& otherOption, const std::filesystem::path& other) {
  std::error_code isNotThere;
  const auto nameOf = [](const auto& path) {
    return std::filesystem::absolute(path).lexically_normal();
  };
  const bool areOne =
      nameOf(output) == nameOf(other) || std::filesystem::equivalent(output, other, isNotThere);
  if (!areOne) return;
  throw UsageError(
      fmt::format("{} {}: {} writes this file too", option, output.string(), otherOption));
}

bool coloursWanted() {
  return isTerminal(STDOUT_FILENO) && std::getenv("NO_COLOR") == nullptr;
}

bool progressWanted() {
  return isTerminal(STDERR_FILENO);
}

}  // namespace gnomon::cli
