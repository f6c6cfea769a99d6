#include "faults/shell_run.h"

#include <fmt/core.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "common/error.h"
#include "common/text.h"

namespace gnomon::test {
namespace fs = std::filesystem;

std::string bytesOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

namespace {

int statusOf(int state) {
  return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

}  // namespace

Outcome runShell(const fs::path& folder, const std::string& command, const ShellOptions& options) {
  // Beside the folder, so that nothing is in it but what the program reads and writes.
  const fs::path out = folder.string() + ".out";
  const fs::path err = folder.string() + ".err";
  const fs::path cache =
      options.keepsCache ? folder / ".cache" : fs::path(folder.string() + ".cache");
  const std::string script = fmt::format("gnomon={}\ngnomon() {{ \"$gnomon\" \"$@\"; }}\n{}",
                                         shellQuoted(GNOMON_PROGRAM), command);
  const std::string line = fmt::format(
      "cd {} && GNOMON_CACHE={} timeout -k 5 {} {} -c {} >{} 2>{} </dev/null",
      shellQuoted(folder.string()), shellQuoted(cache.string()), options.seconds, options.shell,
      shellQuoted(script), shellQuoted(out.string()), shellQuoted(err.string()));
  const int status = statusOf(std::system(line.c_str()));
  const Outcome outcome{status, bytesOf(out), bytesOf(err)};
  fs::remove(out);
  fs::remove(err);
  if (!options.keepsCache) fs::remove_all(cache);
  return outcome;
}

void expectRefused(const Outcome& outcome, const std::string& what) {
  EXPECT_EQ(outcome.status, static_cast<int>(ExitStatus::badInput)) << what << ": " << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("gnomon: ")) << what << ": " << outcome.err;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << what << ": " << outcome.err;
  EXPECT_EQ(outcome.err.find("internal error"), std::string::npos) << what << ": " << outcome.err;
}

}  // namespace gnomon::test
