#include "report/plots/gnuplot.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

#include "common/error.h"
#include "common/system/process.h"
#include "common/text.h"
#include "report/text/html.h"

namespace gnomon::report {

namespace {

/// @throws InternalError where a signal ended it
bool succeeded(pid_t process) {
  const int state = endOfChild(process, true).value_or(0);
  if (WIFSIGNALED(state)) failAsGnuplot(fmt::format("ended: {}", strsignal(WTERMSIG(state))));
  return WEXITSTATUS(state) == 0;
}

/// A gnuplot that works on a script.
class Running {
 public:
  /// It opens its input anew, as a file: from the stream itself it reads every character by a call
  /// of the system.
  explicit Running(const std::string& script)
      : in_(scratchFile(script)),
        out_(scratchFile()),
        err_(scratchFile()),
        process_(startGnuplot({"/dev/stdin"}, in_.get(), out_.get(), err_.get(), {})) {}

  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() {
    if (process_ > 0) (void)endOfChild(process_, true);
  }

  /// Waits for its end. Once.
  std::string output() {
    if (!succeeded(std::exchange(process_, 0))) failAsGnuplot(lastLine(contentOf(err_.get())));
    return contentOf(out_.get());
  }

 private:
  OwnedFile in_, out_, err_;
  pid_t process_;
};

Running& versionQuestion() {
  static Running question(
      "set print '-'\nprint sprintf('%.1f.%s', GPVAL_VERSION, GPVAL_PATCHLEVEL)\n");
  return question;
}

/// Sessions that nobody draws with now, each with one kind of PDF. Ended with this process.
class IdleSessions {
 public:
  std::unique_ptr<GnuplotSession> take(PdfObjects objects) {
    {
      const std::lock_guard lock(mutex_);
      std::vector<std::unique_ptr<GnuplotSession>>& idle = idle_[objects];
      if (!idle.empty()) {
        std::unique_ptr<GnuplotSession> session = std::move(idle.back());
        idle.pop_back();
        return session;
      }
    }
    // A variable of cairo's own: 1.18 knows no other way.
    const std::vector<std::string> plain = {"CAIRO_DEBUG_PDF=1"};
    return std::make_unique<GnuplotSession>(
        objects == PdfObjects::plain ? plain : std::vector<std::string>());
  }

  void giveBack(PdfObjects objects, std::unique_ptr<GnuplotSession> session) {
    const std::lock_guard lock(mutex_);
    idle_[objects].push_back(std::move(session));
  }

 private:
  std::mutex mutex_;
  std::map<PdfObjects, std::vector<std::unique_ptr<GnuplotSession>>> idle_;
};

IdleSessions& idleSessions() {
  static IdleSessions sessions;
  return sessions;
}

}  // namespace

std::string runGnuplot(const std::string& script) {
  return Running(script).output();
}

std::vector<std::string> drawByGnuplot(const std::vector<std::string>& scripts,
                                       const DrawingOptions& options) {
  std::unique_ptr<GnuplotSession> session = idleSessions().take(options.objects);
  std::vector<std::string> drawn;
  drawn.reserve(scripts.size());
  for (const std::string& script : scripts) drawn.push_back(session->draw(options.before, script));
  idleSessions().giveBack(options.objects, std::move(session));
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

std::string styledSvg(const std::string& svg, const std::string& title, const std::string& style) {
  const std::string begin = "<title>";
  const std::string end = "</desc>";
  const std::size_t from = svg.find(begin);
  const std::size_t to = svg.find(end);
  if (from == std::string::npos || to == std::string::npos || to < from) {
    failAsGnuplot("its SVG has no title and description");
  }
  std::string clean = svg.substr(0, from) + "<title>" + escapeHtml(title).text() +
                      "</title><style>" + style + "</style>" + svg.substr(to + end.size());
  // gnuplot writes a label's > as it is, which XML does not take behind ]].
  constexpr std::string_view sign = "]]>";
  for (std::size_t at = 0; (at = clean.find(sign, at)) != std::string::npos;) {
    clean.replace(at, sign.size(), "]]&gt;");
  }
  return clean;
}

namespace {

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

/// Both ends of a pipe that no other started program keeps open.
struct Pipe {
  OwnedFile from, to;
};

Pipe makePipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) failAsGnuplot(std::strerror(errno));
  return {OwnedFile(::fdopen(ends[0], "r")), OwnedFile(::fdopen(ends[1], "w"))};
}

/// A file's name in the processes that this one starts from now on.
std::string inheritedName(const OwnedFile& file) {
  const int number = fileno(file.get());
  if (::fcntl(number, F_SETFD, 0) < 0) failAsGnuplot(std::strerror(errno));
  return fmt::format("/dev/fd/{}", number);
}

/// Whether the text reached the file.
bool isWritten(std::FILE* file, std::string_view text) {
  return std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
}

void rewrite(std::FILE* file, std::string_view text) {
  std::rewind(file);
  if (::ftruncate(fileno(file), 0) == 0 && isWritten(file, text)) return;
  failAsGnuplot("the temporary file cannot be written");
}

constexpr std::string_view done = "gnomon: done\n";

}  // namespace

void failAsGnuplot(const std::string& what) {
  throw InternalError(fmt::format("gnuplot: {}", what));
}

OwnedFile scratchFile(const std::string& content) {
  OwnedFile file(std::tmpfile());
  if (!file) failAsGnuplot(fmt::format("no temporary file: {}", std::strerror(errno)));
  rewrite(file.get(), content);
  std::rewind(file.get());
  return file;
}

pid_t startGnuplot(const std::vector<std::string>& arguments, std::FILE* in, std::FILE* out,
                   std::FILE* err, const std::vector<std::string>& extra) {
  std::vector<std::string> words = {"gnuplot", "-d"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = plotVariables();
  variables.insert(variables.end(), extra.begin(), extra.end());
  const ChildStart started = startChild({words, variables, {}, in, out, err});
  if (started.failure != 0) {
    failAsGnuplot(
        fmt::format("cannot be started: {}; reports need it for their plots "
                    "(gnuplot-nox)",
                    std::strerror(started.failure)));
  }
  return started.process;
}

std::string lastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return "ended without a word";
  const std::size_t line = text.find_last_of('\n', end);
  const std::size_t begin = line == std::string::npos ? 0 : line + 1;
  return text.substr(begin, end + 1 - begin);
}

GnuplotSession::GnuplotSession(const std::vector<std::string>& variables)
    : script_(scratchFile()),
      drawn_(scratchFile()),
      out_(scratchFile()),
      scriptName_(inheritedName(script_)),
      drawnName_(inheritedName(drawn_)) {
  Pipe commands = makePipe();
  Pipe answers = makePipe();
  process_ = startGnuplot({}, commands.from.get(), out_.get(), answers.to.get(), variables);
  commands_ = std::move(commands.to);
  answers_ = std::move(answers.from);
}

GnuplotSession::~GnuplotSession() {
  if (process_ > 0) (void)end();
}

int GnuplotSession::end() {
  commands_.reset();  // where its input ends, so does gnuplot
  return endOfChild(std::exchange(process_, 0), true).value_or(0);
}

std::string GnuplotSession::draw(const std::string& before, const std::string& script) {
  if (process_ == 0) failAsGnuplot("has ended");
  // Not on its input: from a pipe it reads every character by a call of the system.
  rewrite(script_.get(), fmt::format("reset session\n{}reset session\nset output '{}'\n{}\n"
                                     "unset output\n",
                                     before, drawnName_, script));
  rewrite(drawn_.get(), "");
  command(fmt::format("load '{}'", scriptName_));
  std::string drawn = contentOf(drawn_.get());
  // gnuplot 6 only warns of a terminal that it does not have.
  if (drawn.empty()) failAsGnuplot("drew nothing");
  return drawn;
}

void GnuplotSession::command(const std::string& line) {
  std::string said;
  if (isWritten(commands_.get(), fmt::format("{}\nset print\nprint '{}'\n", line,
                                             done.substr(0, done.size() - 1)))) {
    std::array<char, 4096> text{};
    while (std::fgets(text.data(), text.size(), answers_.get()) != nullptr) {
      if (text.data() == done) return;
      said += text.data();
    }
  }
  // An error ends gnuplot, and with it the pipes.
  const int state = end();
  failAsGnuplot(WIFSIGNALED(state) ? fmt::format("ended: {}", strsignal(WTERMSIG(state)))
                                   : lastLine(said));
}

}  // namespace gnomon::report
