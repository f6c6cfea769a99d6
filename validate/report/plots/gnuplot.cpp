#include "report/plots/gnuplot.h"

#include <fmt/core.h>
#include <sys/wait.h>

#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

#include "common/system/child_process.h"
#include "common/text/one_line.h"
#include "report/plots/gnuplot_session.h"
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

}  // namespace gnomon::report
