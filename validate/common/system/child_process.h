#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// A program to start beside this one.
struct ChildProgram {
  std::vector<std::string> words;  ///< its name, looked for on the PATH, and its arguments
  /// Its variables, "NAME=value"; without a list this process's own.
  std::optional<std::vector<std::string>> variables = {};
  std::filesystem::path folder = {};  ///< where it runs; empty for this process's own
  std::FILE* in = nullptr;            ///< its standard input; without one it has none
  std::FILE* out = nullptr;           ///< its standard output, to be open
  std::FILE* err = nullptr;           ///< its standard error, to be open
};

/// What came of a start.
struct ChildStart {
  pid_t process = -1;
  int failure = 0;  ///< the number of the system's error; 0 where the program runs
};

/// Starts a program. A signal that ends this process (`cleanUpOnSignals`) kills it until its end
/// has been awaited. It dies itself of the signals that this process ignores or blocks, so that
/// what it could not write whole does not pass for whole.
ChildStart startChild(const ChildProgram& program);

/// The state of a started program as waitpid tells it, which frees its number. Of a process that is
/// no child of this one: the exit status 127.
/// @param isAwaited  waits for its end; else nothing is returned while it runs
std::optional<int> endOfChild(pid_t process, bool isAwaited);

/// What a file holds, from its beginning.
std::string contentOf(std::FILE* file);

}  // namespace gnomon
