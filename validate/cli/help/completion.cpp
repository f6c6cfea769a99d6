#include "cli/help/completion.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <vector>

namespace gnomon::cli {
namespace {

std::string longOptions(const CLI::App& app) {
  std::vector<std::string> words;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  }
  return fmt::format("{}", fmt::join(words, " "));
}

}  // namespace

std::string bashCompletion(const CLI::App& app) {
  std::vector<std::string> names;
  std::string options;
  for (const CLI::App* command : app.get_subcommands({})) {
    names.push_back(command->get_name());
    options += fmt::format("    {}) words='{}' ;;\n", command->get_name(), longOptions(*command));
  }
  return fmt::format(
      R"(# bash completion of {0}
_{0}() {{
  local words='' current=${{COMP_WORDS[COMP_CWORD]}}
  COMPREPLY=()
  case ${{COMP_WORDS[1]}} in
{3}  esac
  if [ "$COMP_CWORD" -eq 1 ]; then
    words='{1} {2}'
  elif [ "${{current#-}}" = "$current" ]; then
    return
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o default -F _{0} {0}
)",
      app.get_name(), fmt::join(names, " "), longOptions(app), options);
}

}  // namespace gnomon::cli
