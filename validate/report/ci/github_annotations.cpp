#include "report/ci/github_annotations.h"

#include <fmt/core.h>

#include <charconv>
#include <system_error>

#include "report/text/gate_text.h"
#include "report/text/utf8_text.h"

namespace gnomon::report {
namespace {

std::string escaped(std::string_view text, bool property) {
  std::string result;
  for (const char c : xmlText(text)) {
    const bool special = c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','));
    result += special ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return result;
}

/// @param line  0 where none is known
std::string command(const char* level, const std::string& file, int line, const std::string& title,
                    const std::string& message) {
  const std::string place = line > 0 ? fmt::format(",line={}", line) : "";
  return fmt::format("::{} file={}{},title={}::{}\n", level, escaped(file, true), place,
                     escaped(title, true), escaped(message, false));
}

/// The line that a message names first, 0 for none.
int lineOf(std::string_view message, const std::string& file) {
  if (!message.starts_with(file + ":")) return 0;
  message.remove_prefix(file.size() + 1);
  int line = 0;
  const auto [end, failure] =
      std::from_chars(message.data(), message.data() + message.size(), line);
  const bool whole =
      failure == std::errc() && end != message.data() + message.size() && *end == ':';
  return whole ? line : 0;
}

/// Where a problem is: in the user's own shader that its message names first, or behind the study,
/// or else in the study.
GatePlace placeOf(const study::CheckRecord& check, std::string_view message) {
  std::string_view inner = message;
  if (inner.starts_with(check.file + ": ")) inner.remove_prefix(check.file.size() + 2);
  for (const auto& [method, shader] : check.shaders) {
    if (inner.starts_with(shader + ":")) return {shader, lineOf(inner, shader)};
  }
  return {check.file, lineOf(message, check.file)};
}

std::string gateAnnotation(const study::CheckRecord& check, const study::Judgement& judgement) {
  const auto [file, line] = faultPlace(check, judgement.gate);
  const char* outcome = judgement.verdict == study::GateVerdict::failed ? "failed" : "undefined";
  return command("error", file, line,
                 fmt::format("{}: {} {}", check.name, gateOriginName(judgement.gate), outcome),
                 fmt::format("{}\n{}", gateFaultText(judgement), check.command));
}

}  // namespace

std::string githubAnnotations(std::span<const study::CheckRecord> checks) {
  std::string text;
  for (const study::CheckRecord& check : checks) {
    for (const study::ProblemRecord& problem : check.problems) {
      const auto [file, line] = placeOf(check, problem.message);
      text += command("error", file, line, fmt::format("{}: not judged", check.name),
                      fmt::format("{}\n{}", problem.message, check.command));
    }
    for (const study::Judgement& judgement : check.judgements) {
      if (judgement.isFault()) text += gateAnnotation(check, judgement);
    }
  }
  for (const study::CheckRecord& check : checks) {
    for (const study::NoticeRecord& notice : check.notices) {
      text += command("notice", check.file, notice.line, fmt::format("{}: notice", check.name),
                      notice.text);
    }
  }
  return text;
}

std::string withoutWorkflowCommands(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  bool opensLine = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i);
    plain += rest.front();
    // A space breaks the sign that the runner looks for.
    if (rest.starts_with("##[")) {
      plain += "# ";
      ++i;
    } else if (opensLine && rest.starts_with("::")) {
      plain += ' ';
    }
    opensLine = rest.front() == '\n' || (opensLine && rest.front() == ' ');
  }
  return plain;
}

}  // namespace gnomon::report
