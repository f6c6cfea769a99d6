#pragma once

#include <sys/types.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::report {

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

}  // namespace gnomon::report
