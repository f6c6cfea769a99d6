#include "report/plots/gnuplot.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "common/error.h"
#include "common/system/child_process.h"
#include "common/text/one_line.h"
#include "report/text/html.h"

namespace gnomon::report {
namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
/// A file without a name, which goes when it is closed.
using ScratchFile = std::unique_ptr<std::FILE, FileCloser>;

[[noreturn]] void fail(const std::string& what) {
  throw InternalError(fmt::format("gnuplot: {}", what));
}

ScratchFile scratchFile(const std::string& content = "") {
  ScratchFile file(std::tmpfile());
  if (!file) fail(fmt::format("no temporary file: {}", std::strerror(errno)));
  if (std::fwrite(content.data(), 1, content.size(), file.get()) != content.size()) {
    fail("the temporary file cannot be written");
  }
  std::rewind(file.get());
  return file;
}

/// What gnuplot's process knows of this one's variables: where programs, libraries, temporary files
/// and the list of known fonts lie. All else could change what it draws (GNUTERM, GDFONTPATH,
/// FONTCONFIG_FILE, the locale). The time is UTC: a PDF tells the hour's distance from it.
std::vector<std::string> plotVariables() {
  std::vector<std::string> variables = {"TZ=UTC", "LC_ALL=C.UTF-8"};
  for (const char* name : {"PATH", "LD_LIBRARY_PATH", "TMPDIR", "HOME", "XDG_CACHE_HOME"}) {
    if (const char* value = std::getenv(name))
      variables.push_back(fmt::format("{}={}", name, value));
  }
  return variables;
}

/// Starts gnuplot with the three files as its standard streams. It opens its input anew, as a file:
/// from the stream itself it reads every character by a call of the system.
/// @param extra  variables beside this process's own, "NAME=value"
pid_t start(std::FILE* in, std::FILE* out, std::FILE* err, const std::vector<std::string>& extra) {
  std::vector<std::string> variables = plotVariables();
  variables.insert(variables.end(), extra.begin(), extra.end());
  const ChildStart started =
      startChild({{"gnuplot", "-d", "/dev/stdin"}, variables, {}, in, out, err});
  if (started.failure != 0) {
    fail(fmt::format("cannot be started: {}; reports need it for their plots (gnuplot-nox)",
                     std::strerror(started.failure)));
  }
  return started.process;
}

/// @throws InternalError where a signal ended it
bool succeeded(pid_t process) {
  const int state = endOfChild(process, true).value_or(0);
  if (WIFSIGNALED(state)) fail(fmt::format("ended: {}", strsignal(WTERMSIG(state))));
  return WEXITSTATUS(state) == 0;
}

/// The last line that says something: gnuplot quotes the script before it.
std::string lastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return "ended without a word";
  const std::size_t line = text.find_last_of('\n', end);
  const std::size_t begin = line == std::string::npos ? 0 : line + 1;
  return text.substr(begin, end + 1 - begin);
}

/// A gnuplot that works on a script.
class Running {
 public:
  explicit Running(const std::string& script, const std::vector<std::string>& extra = {})
      : in_(scratchFile(script)),
        out_(scratchFile()),
        err_(scratchFile()),
        process_(start(in_.get(), out_.get(), err_.get(), extra)) {}

  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() {
    if (process_ > 0) (void)endOfChild(process_, true);
  }

  /// Waits for its end. Once.
  std::string output() {
    if (!succeeded(std::exchange(process_, 0))) fail(lastLine(contentOf(err_.get())));
    return contentOf(out_.get());
  }

 private:
  ScratchFile in_, out_, err_;
  pid_t process_;
};

Running& versionQuestion() {
  static Running question(
      "set print '-'\nprint sprintf('%.1f.%s', GPVAL_VERSION, GPVAL_PATCHLEVEL)\n");
  return question;
}

/// Its name in a process that this one starts.
std::string inheritedName(const ScratchFile& file) {
  const int number = fileno(file.get());
  if (::fcntl(number, F_SETFD, 0) < 0) fail(std::strerror(errno));
  return fmt::format("/dev/fd/{}", number);
}

}  // namespace

std::string runGnuplot(const std::string& script) {
  return Running(script).output();
}

std::vector<std::string> drawByGnuplot(const std::vector<std::string>& scripts,
                                       const DrawingOptions& options) {
  std::vector<ScratchFile> files;
  std::string all;
  for (const std::string& script : scripts) {
    files.push_back(scratchFile());
    all += fmt::format("reset session\n{}reset session\nset output '{}'\n{}\nunset output\n",
                       options.before, inheritedName(files.back()), script);
  }
  // A variable of cairo's own: 1.18 knows no other way.
  const std::vector<std::string> plain = {"CAIRO_DEBUG_PDF=1"};
  (void)Running(all, options.objects == PdfObjects::plain ? plain : std::vector<std::string>())
      .output();
  std::vector<std::string> drawn;
  drawn.reserve(files.size());
  for (const ScratchFile& file : files) {
    drawn.push_back(contentOf(file.get()));
    // gnuplot 6 only warns of a terminal that it does not have.
    if (drawn.back().empty()) fail("drew nothing");
  }
  return drawn;
}

void askGnuplotVersion() {
  (void)versionQuestion();
}

const std::string& gnuplotVersion() {
  static const std::string version = versionQuestion().output();
  return version;
}

std::string gnuplotText(const std::string& text) {
  std::string quoted = "'";
  for (const char c : oneLine(text)) {
    // Doubled, as gnuplot has it, a quote could not be the first character.
    if (c == '\'') {
      quoted += "’";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::string cleanSvg(const std::string& svg, const std::string& title) {
  const std::string begin = "<title>";
  const std::string end = "</desc>";
  const std::size_t from = svg.find(begin);
  const std::size_t to = svg.find(end);
  if (from == std::string::npos || to == std::string::npos || to < from) {
    fail("its SVG has no title and description");
  }
  std::string clean = svg.substr(0, from) + "<title>" + escapeHtml(title).text() + "</title>" +
                      svg.substr(to + end.size());
  // gnuplot writes a label's > as it is, which XML does not take behind ]].
  constexpr std::string_view sign = "]]>";
  for (std::size_t at = 0; (at = clean.find(sign, at)) != std::string::npos;) {
    clean.replace(at, sign.size(), "]]&gt;");
  }
  return clean;
}

}  // namespace gnomon::report
