#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "common/shell_quote.h"
#include "end_to_end/program.h"

namespace gnomon::test {

inline std::string contentOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

/// Runs a script of the POSIX shell in a folder, for redirections and limits that only it can set.
/// `$gnomon` is the program; its cache is the folder's, and stays from script to script.
inline Outcome runShell(const std::filesystem::path& folder, const std::string& script) {
  const std::filesystem::path out = folder / ".shell-out";
  const std::filesystem::path err = folder / ".shell-err";
  const std::string whole = "cd " + shellQuoted(folder.string()) +
                            "\ngnomon=" + shellQuoted(GNOMON_PROGRAM) +
                            "\nexport GNOMON_CACHE=\"$PWD/.cache\"\n{\n" + script +
                            "\n} >.shell-out 2>.shell-err </dev/null\n";
  const int state = std::system(whole.c_str());
  const int status = WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
  return {status, contentOf(out), contentOf(err)};
}

}  // namespace gnomon::test
