#include "report/plots/gnuplot.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "cache/cache.h"
#include "common/error.h"
#include "common/parallel.h"
#include "common/system/process.h"
#include "common/text.h"
#include "report/plots/line_plot.h"
#include "report/text/html.h"

namespace gnomon::report {

namespace {

constexpr const char* encoding = "set encoding utf8\n";
constexpr std::string_view dateKey = "/CreationDate (D:";

bool showsDate(const std::string& pdf) {
  return pdf.find(dateKey) != std::string::npos;
}

/// A PDF says when it was made: it shall not. Nothing else in it moves.
std::string withoutDate(std::string pdf) {
  const std::size_t at = pdf.rfind(dateKey);
  if (at == std::string::npos) return pdf;
  const std::string never = "19700101000000";
  return pdf.replace(at + dateKey.size(), never.size(), never);
}

struct PlotFormat {
  std::string_view name;
  std::vector<std::string> (*write)(const std::vector<PlotSheet>&);
  std::size_t plotsAtOnce;
};

// So few that other cores have some, so many that most are spared a start.
constexpr std::array<PlotFormat, 2> formats = {{{"svg", svgsOf, 24}, {"pdf", pdfsOf, 8}}};

/// Fonts are the one thing that it does not hold: they are the system's, and change no figure.
cache::ContentKey keyOf(const PlotSheet& sheet, std::string_view format) {
  cache::KeyBuilder key("drawn plot");
  key.add("format", format).add("gnuplot", gnuplotVersion()).add("title", sheet.title);
  key.add("width", sheet.width).add("height", sheet.height).add("style", darkStyle());
  return key.add("commands", sheet.commands).key();
}

/// Plots in one format, drawn where the cache does not have them.
std::vector<std::string> inFormat(const std::vector<PlotSheet>& sheets, const PlotFormat& format,
                                  cache::Cache* cache) {
  std::vector<std::string> drawn(sheets.size());
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    std::optional<std::string> kept;
    if (cache != nullptr) {
      kept = cache->find<std::string>(keyOf(sheets[i], format.name), cache::HoldsOn::thisProcessor,
                                      cache::Counted::no);
    }
    if (kept) drawn[i] = std::move(*kept);
    if (!kept) missing.push_back(i);
  }
  const std::size_t parts = (missing.size() + format.plotsAtOnce - 1) / format.plotsAtOnce;
  parallelFor(0, parts, [&](std::size_t part) {
    const auto rest = std::span(missing).subspan(part * format.plotsAtOnce);
    const auto own = rest.first(std::min(format.plotsAtOnce, rest.size()));
    std::vector<PlotSheet> wanted;
    for (const std::size_t i : own) wanted.push_back(sheets[i]);
    std::vector<std::string> made = format.write(wanted);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (cache != nullptr) cache->keep(keyOf(sheets[own[k]], format.name), made[k]);
      drawn[own[k]] = std::move(made[k]);
    }
  });
  return drawn;
}

}  // namespace

std::vector<std::string> svgsOf(const std::vector<PlotSheet>& sheets) {
  // The last colour of one SVG reaches into the next: let it be the same before each.
  const std::string before =
      "set terminal svg noenhanced background '#ffffff'\nset output '/dev/null'\n"
      "unset border\nunset tics\nunset key\nplot [0:1] [0:1] 2 lc rgb 'black'\nunset output\n";
  std::vector<std::string> scripts;
  for (const PlotSheet& sheet : sheets) {
    scripts.push_back(fmt::format(
        "{}set terminal svg size {},{} noenhanced font 'sans-serif,14' background '#ffffff'\n{}",
        encoding, sheet.width, sheet.height, sheet.commands));
  }
  std::vector<std::string> svgs = drawByGnuplot(scripts, {before});
  for (std::size_t i = 0; i < svgs.size(); ++i) {
    svgs[i] = styledSvg(svgs[i], sheets[i].title, darkStyle());
  }
  return svgs;
}

std::vector<std::string> pdfsOf(const std::vector<PlotSheet>& sheets) {
  constexpr double pixelsPerInch = 144;
  // gnuplot drops what is left of a point: half a thousandth keeps the last one.
  const auto inches = [](int pixels) { return pixels / pixelsPerInch + 0.0005; };
  std::vector<std::string> scripts;
  for (const PlotSheet& sheet : sheets) {
    scripts.push_back(
        fmt::format("{}set terminal pdfcairo size {:.3f}in,{:.3f}in noenhanced font "
                    "'sans-serif,14' fontscale 0.4 linewidth 0.5\n{}",
                    encoding, inches(sheet.width), inches(sheet.height), sheet.commands));
  }
  return undatedPdfs(scripts);
}

std::vector<std::string> undatedPdfs(const std::vector<std::string>& scripts) {
  std::vector<std::string> pdfs = drawByGnuplot(scripts);
  // cairo 1.18 compresses the date too.
  if (!std::all_of(pdfs.begin(), pdfs.end(), showsDate)) {
    pdfs = drawByGnuplot(scripts, {{}, PdfObjects::plain});
  }
  for (std::string& pdf : pdfs) pdf = withoutDate(std::move(pdf));
  return pdfs;
}

std::vector<DrawnPlot> drawPlots(std::vector<PlotSheet> sheets, cache::Cache* cache) {
  std::array<std::vector<std::string>, formats.size()> drawn;
  parallelFor(0, drawn.size(),
              [&](std::size_t i) { drawn.at(i) = inFormat(sheets, formats.at(i), cache); });
  std::vector<DrawnPlot> plots;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    plots.push_back({std::move(sheets[i]), std::move(drawn[0][i]), std::move(drawn[1][i])});
  }
  return plots;
}

namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OwnedFile = std::unique_ptr<std::FILE, FileCloser>;

/// A file without a name, which goes when it is closed.
/// @throws InternalError where there is no room for it
OwnedFile scratchFile(const std::string& content = "");

/// Starts gnuplot with the three files as its standard streams, without the user's own settings.
/// @param arguments  of gnuplot
/// @param extra      variables beside those that it needs of this process, "NAME=value"
/// @throws InternalError where it cannot be started
pid_t startGnuplot(const std::vector<std::string>& arguments, std::FILE* in, std::FILE* out,
                   std::FILE* err, const std::vector<std::string>& extra);

/// The last line that says something: gnuplot quotes the script before it.
std::string lastLine(const std::string& text);

/// @throws InternalError in one line, "gnuplot: " and what
[[noreturn]] void failAsGnuplot(const std::string& what);

/// A gnuplot that draws one script after the other: its start takes longer than most plots. After a
/// failure it draws nothing more.
class GnuplotSession {
 public:
  /// @param variables  of its environment, beside the usual ones
  /// @throws InternalError where it cannot be started
  explicit GnuplotSession(const std::vector<std::string>& variables);
  ~GnuplotSession();
  GnuplotSession(const GnuplotSession&) = delete;
  GnuplotSession& operator=(const GnuplotSession&) = delete;

  /// What it writes for a script that sets a terminal, and no output.
  /// @param before  a script that runs before it, and draws nothing
  /// @throws InternalError where it refuses the script or draws nothing
  std::string draw(const std::string& before, const std::string& script);

 private:
  /// Gives a line, and waits until gnuplot has done what it says.
  void command(const std::string& line);
  /// Waits for its end, and returns how it ended, as waitpid tells it.
  int end();

  OwnedFile script_, drawn_, out_;
  std::string scriptName_, drawnName_;
  OwnedFile commands_, answers_;  ///< pipes to its input and from its standard error
  pid_t process_ = 0;
};

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

}  // namespace

}  // namespace gnomon::report
