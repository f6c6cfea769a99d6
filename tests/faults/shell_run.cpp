#include "faults/shell_run.h"

#include <fmt/core.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "common/error.h"
#include "common/shell_quote.h"

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

Outcome runShell(const fs::path& folder, const std::string& command, int seconds) {
  // Beside the folder, so that nothing is in it but what the program reads and writes.
  const fs::path out = folder.string() + ".out";
  const fs::path err = folder.string() + ".err";
  const fs::path cache = folder.string() + ".cache";
  const std::string script =
      fmt::format("gnomon() {{ {} \"$@\"; }}; {}", shellQuoted(GNOMON_PROGRAM), command);
  const std::string line =
      fmt::format("cd {} && GNOMON_CACHE={} timeout -k 5 {} bash -c {} >{} 2>{} </dev/null",
                  shellQuoted(folder.string()), shellQuoted(cache.string()), seconds,
                  shellQuoted(script), shellQuoted(out.string()), shellQuoted(err.string()));
  const int status = statusOf(std::system(line.c_str()));
  const Outcome outcome{status, bytesOf(out), bytesOf(err)};
  for (const fs::path& path : {out, err, cache}) fs::remove_all(path);
  return outcome;
}

Outcome runPosixShell(const fs::path& folder, const std::string& script) {
  const std::string whole = fmt::format(
      "cd {}\ngnomon={}\nexport GNOMON_CACHE=\"$PWD/.cache\"\n{{\n{}\n}} >.shell-out 2>.shell-err "
      "</dev/null\n",
      shellQuoted(folder.string()), shellQuoted(GNOMON_PROGRAM), script);
  const int status = statusOf(std::system(whole.c_str()));
  return {status, bytesOf(folder / ".shell-out"), bytesOf(folder / ".shell-err")};
}

void expectRefused(const Outcome& outcome, const std::string& what) {
  EXPECT_EQ(outcome.status, static_cast<int>(ExitStatus::badInput)) << what << ": " << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("gnomon: ")) << what << ": " << outcome.err;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << what << ": " << outcome.err;
  EXPECT_EQ(outcome.err.find("internal error"), std::string::npos) << what << ": " << outcome.err;
}

}  // namespace gnomon::test
