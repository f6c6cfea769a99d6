#include "cli/output.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>

#include "common/progress.h"
#include "common/text.h"
#include "report/build_server.h"

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

TerminalProgress::TerminalProgress(std::string title, std::size_t cases)
    : cases_(cases),
      start_(Clock::now()),
      caseStart_(start_),
      title_(std::move(title)),
      enabled_(progressWanted()),
      stageStart_(start_) {}

TerminalProgress::~TerminalProgress() {
  clear();
}

void TerminalProgress::beginCase(std::string title) {
  ++current_;
  title_ = std::move(title);
  caseStart_ = Clock::now();
}

void TerminalProgress::update(std::string_view stage, double share) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (stage != stage_ || share == 0) {
    stage_ = stage;
    stageStart_ = now;
  }
  using std::chrono::duration;
  constexpr double quietSeconds = 0.5;
  constexpr double refreshSeconds = 0.1;
  // Cases may be short where all of them are not.
  const double elapsed = duration<double>(now - (cases_ > 1 ? start_ : stageStart_)).count();
  if (elapsed < quietSeconds || duration<double>(now - lastShown_).count() < refreshSeconds) return;
  lastShown_ = now;
  shown_ = true;
  const std::string which =
      cases_ > 1 ? fmt::format("case {} of {}, ", std::max<std::size_t>(current_, 1), cases_) : "";
  printError(fmt::format("\r\033[K{}: {}{} {:.0f} %{}", title_, which, stage_, 100 * share,
                         leftText(share, now)));
}

std::string TerminalProgress::leftText(double share, Clock::time_point now) const {
  using std::chrono::duration;
  if (cases_ > 1) {
    if (current_ < 2) return "";
    return fmt::format(", {} left in all",
                       durationText(secondsLeft(current_ - 1, cases_,
                                                duration<double>(caseStart_ - start_).count(),
                                                duration<double>(now - caseStart_).count())));
  }
  const double elapsed = duration<double>(now - stageStart_).count();
  return share > 0.01 ? fmt::format(", {:.0f} s left", elapsed * (1 - share) / share) : "";
}

void TerminalProgress::clear() {
  if (shown_) printError("\r\033[K");
  shown_ = false;
}

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
