#include "cli/shards/arguments.h"

#include "cli/commands/run_command.h"
#include "common/text/shell_quote.h"

namespace gnomon::cli {
namespace {

constexpr std::string_view outOption = "--out";

/// How many words from this one on are the option and its value; 0 for another word.
std::size_t wordsOf(const Arguments& arguments, std::size_t at, std::string_view name) {
  const std::string& word = arguments[at];
  if (word == name) return at + 1 < arguments.size() ? 2 : 1;
  return word.starts_with(std::string(name) + "=") ? 1 : 0;
}

}  // namespace

std::string commandText(std::span<const std::string> arguments) {
  std::string text = "gnomon";
  for (const std::string& word : arguments) text += " " + shellQuoted(word);
  return text;
}

Arguments withoutOption(const Arguments& arguments, std::string_view name) {
  Arguments kept;
  for (std::size_t i = 0; i < arguments.size();) {
    const std::size_t words = wordsOf(arguments, i, name);
    if (words == 0) kept.push_back(arguments[i]);
    i += words == 0 ? 1 : words;
  }
  return kept;
}

Arguments withOut(const Arguments& arguments, const std::string& out) {
  Arguments result;
  // The folder that a run without the option writes to needs none.
  bool isDone = out == RunRequest().out;
  for (std::size_t i = 0; i < arguments.size();) {
    const std::size_t words = wordsOf(arguments, i, outOption);
    if (words == 0) {
      result.push_back(arguments[i]);
    } else if (!isDone) {
      isDone = true;
      if (words == 2) result.emplace_back(outOption);
      result.push_back(words == 2 ? out : std::string(outOption) + "=" + out);
    }
    i += words == 0 ? 1 : words;
  }
  if (!isDone) {
    result.emplace_back(outOption);
    result.push_back(out);
  }
  return result;
}

}  // namespace gnomon::cli
