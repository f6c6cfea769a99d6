#include "cli/help/manual_page.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

namespace gnomon::cli {
namespace {

/// Text in which no line is a request to the formatter and no sign is changed by it.
std::string escaped(const std::string& text) {
  std::string result;
  bool opensLine = true;
  for (const char c : text) {
    if (opensLine && (c == '.' || c == '\'')) result += "\\&";
    if (c == '-' || c == '\\') result += c == '-' ? "\\" : "\\e";
    if (c != '\\') result += c;
    opensLine = c == '\n';
  }
  return result;
}

/// "--out DIR", "STUDY FILE…" or "--quick".
std::string headOf(const CLI::Option& option) {
  const std::string name = option.get_name(option.get_positional(), true);
  const std::string type = option.get_type_name();
  return type.empty() || option.get_items_expected_max() == 0 ? name : name + " " + type;
}

std::string entryOf(const CLI::Option& option) {
  std::string text =
      fmt::format(".TP\n.B {}\n{}", escaped(headOf(option)), escaped(option.get_description()));
  if (!option.get_default_str().empty()) {
    text += fmt::format(" (default: {})", escaped(option.get_default_str()));
  }
  return text + "\n";
}

std::string optionsOf(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) text += entryOf(*option);
  return text;
}

/// As it is, line by line.
std::string verbatim(const std::string& text) {
  const std::size_t begin = text.find_first_not_of('\n');
  if (begin == std::string::npos) return "";
  return fmt::format(".PP\n.nf\n{}\n.fi\n", escaped(text.substr(begin)));
}

}  // namespace

std::string manualPage(const CLI::App& app, const std::string& version) {
  const std::string& name = app.get_name();
  std::string text = fmt::format(
      ".TH GNOMON 1 \"\" \"Gnomon {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B "
      "{}\n"
      ".I COMMAND\n[OPTIONS]\n.SH OPTIONS\n{}.SH COMMANDS\n",
      escaped(version), name, escaped(app.get_description()), name, optionsOf(app));
  for (const CLI::App* command : app.get_subcommands({})) {
    text += fmt::format(".SS {}\n{}\n{}{}", escaped(command->get_name()),
                        escaped(command->get_description()), optionsOf(*command),
                        verbatim(command->get_footer()));
  }
  return text;
}

}  // namespace gnomon::cli
