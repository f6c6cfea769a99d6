#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "common/error.h"

namespace gnomon::cli {

/// What the command line writes on standard output and standard error. Output that is lost is a
/// failure: who reads an empty table must not read exit status 0 beside it.

/// Whoever reads standard output has closed it, as `head` does: an error, of which nothing is said.
class ClosedPipe : public InputError {
 public:
  ClosedPipe() : InputError("standard output: nobody reads it any more") {}
};

/// Prepares the process before it writes anything. A stream that is closed stays without a number
/// for any file, so that no text gets into one, and writing it fails. A closed pipe (SIGPIPE) and a
/// limit of file sizes (SIGXFSZ) are errors of writing in place of signals.
void prepareStreams();

/// Writes to standard output at once. Names in the text can give GitHub's runner no command: see
/// withoutWorkflowCommands.
/// @throws InputError where it cannot be written
void printText(std::string_view text);

/// Writes one line, whatever names in it hold: see oneLine.
/// @throws InputError where it cannot be written
void printLine(std::string_view text);

/// As printText without a change: JSON, and commands that are meant.
/// @throws InputError where it cannot be written
void printUnchanged(std::string_view text);

/// Writes to standard error; what becomes of it `isErrorLost` says.
void printError(std::string_view text) noexcept;

/// Writes what libraries left in standard output's buffer.
/// @throws InputError where something on standard output could not be written
void flushOutput();

/// Whether something on standard output could not be written.
bool isOutputLost();

/// Whether something on standard error could not be written.
bool isErrorLost();

/// Refuses to write a file over one that the command reads, by whatever names, links too.
/// @param option  as typed: "--json"
/// @throws UsageError "--json mine.png: the command reads this file, another one expected"
void requireNoInput(const std::string& option, const std::filesystem::path& output,
                    std::span<const std::filesystem::path> inputs);

/// Refuses to write one file for two options.
/// @throws UsageError "--json a.png: --difference writes this file too"
void requireOther(const std::string& option, const std::filesystem::path& output,
                  const std::string& otherOption, const std::filesystem::path& other);

/// Whether standard output takes colours: a terminal that knows them, and NO_COLOR is not set.
bool coloursWanted();

/// Whether standard error is a terminal whose line can be written anew.
bool progressWanted();

}  // namespace gnomon::cli
