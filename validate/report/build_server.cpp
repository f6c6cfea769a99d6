#include "report/build_server.h"

#include <fmt/core.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <system_error>
#include <utility>

#include "common/error.h"
#include "common/text.h"
#include "image/grey_picture.h"
#include "image/images.h"
#include "report/terminal_page.h"
#include "report/text/html.h"
#include "report/text/verdict_text.h"
#include "study/judge/gates.h"

namespace gnomon::report {

namespace fs = std::filesystem;
namespace {

constexpr int mosaicColumns = 40;

/// A name that ends no cell and is no markup.
std::string cell(const std::string& text) {
  std::string result;
  const Html escaped = escapeHtml(oneLine(text));
  for (const char c : escaped.text()) {
    if (std::string_view("|`*_[]\\~").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string faultRow(const study::CheckRecord& check, const study::Judgement& judgement) {
  const study::Gate& gate = judgement.gate;
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.4f}", *value) : "–";
  };
  const GatePlace place = faultPlace(check, gate);
  const std::string answer = gate.answer == study::Answer::drawn
                                 ? ""
                                 : fmt::format(", {}", study::answerName(gate.answer));
  return fmt::format("| {} | {} | {} | {}, {}{} | {} | {} | {} | {} |\n", cell(check.name),
                     cell(gate.method), cell(std::string(gate.metric.name())), cell(gate.view),
                     cell(gate.light), answer, number(judgement.value),
                     number(study::committedValue(gate)), cell(limitText(gate, 4)),
                     cell(place.file));
}

std::string faultTable(std::span<const study::CheckRecord> checks) {
  std::string rows;
  for (const study::CheckRecord& check : checks) {
    for (const study::Judgement& judgement : check.judgements) {
      if (judgement.isFault()) rows += faultRow(check, judgement);
    }
  }
  if (rows.empty()) return "";
  return "| study | method | metric | view, light | value | committed | limit | shader or file |\n"
         "|---|---|---|---|---|---|---|---|\n" +
         rows + "\n";
}

std::string picture(const char* title, const fs::path& file) {
  if (file.empty()) return "";
  return fmt::format("**{}** (`{}`)\n\n```\n{}```\n\n", title, file.generic_string(),
                     mosaicOf(file, mosaicColumns));
}

std::string worstText(const WorstCase& worst) {
  std::string text = fmt::format("### Worst case: {}, {}, {}, {}\n\n", cell(worst.study),
                                 cell(worst.method), cell(worst.view), cell(worst.light));
  text +=
      "🟧 shadow where the truth is lit, 🟦 light where it is shadowed; in the change: 🟧 "
      "now "
      "shadowed, 🟦 now lit. 🟫 lies outside the surface.\n\n";
  text += picture("Before", worst.before) + picture("After", worst.after) +
          picture("Change", worst.change);
  if (!worst.note.empty()) text += cell(worst.note) + "\n\n";
  return text;
}

}  // namespace

std::optional<WorstCase> worstCase(std::span<const study::StudyRecord> records,
                                   const fs::path& out) {
  std::optional<WorstCase> worst;
  bool worstIsShare = false;
  for (const study::StudyRecord& record : records) {
    const fs::path folder = out / record.name;
    const auto in = [&](const std::string& file) {
      return file.empty() ? fs::path() : folder / file;
    };
    for (const study::ReferencePictures& row : record.referencePictures) {
      for (const study::Judgement& judgement : study::byOrigin(record.judgements).references) {
        const study::Gate& gate = judgement.gate;
        const std::optional<double> margin = judgement.margin();
        const bool isOfRow =
            gate.method == row.method && gate.view == row.view && gate.light == row.light;
        if (!isOfRow || !judgement.isFault() || !margin) continue;
        const bool isShare = gate.metric.unit() == compare::MetricUnit::share;
        const bool isWorse = !worst || (isShare && !worstIsShare) ||
                             (isShare == worstIsShare && *margin < worst->margin);
        if (!isWorse) continue;
        worstIsShare = isShare;
        worst = {record.name,    row.method,    row.view,       row.light, *margin,
                 in(row.before), in(row.after), in(row.change), row.note};
      }
    }
  }
  return worst;
}

std::string jobSummary(std::span<const study::CheckRecord> checks,
                       const std::optional<WorstCase>& worst, const std::string& accept) {
  std::size_t passed = 0;
  std::size_t faults = 0;
  std::string problems;
  for (const study::CheckRecord& check : checks) {
    for (const study::Judgement& judgement : check.judgements) {
      passed += judgement.verdict == study::GateVerdict::passed ? 1 : 0;
      faults += judgement.isFault() ? 1 : 0;
    }
    for (const study::ProblemRecord& problem : check.problems) {
      problems += fmt::format("- {}: {}\n", cell(check.name), cell(problem.message));
    }
  }
  const bool isWhole = std::ranges::all_of(
      checks, [](const study::CheckRecord& check) { return check.status() == ExitStatus::pass; });
  std::string text =
      fmt::format("## Shadows: {}\n\n{} limits hold, {} {} not.\n\n", isWhole ? "pass" : "fail",
                  passed, faults, faults == 1 ? "does" : "do");
  text += faultTable(checks);
  if (!problems.empty()) text += problems + "\n";
  if (worst) text += worstText(*worst);
  if (!isWhole && !accept.empty()) {
    text += fmt::format(
        "To accept what was measured, run this and commit its files:\n\n```\n{}\n"
        "```\n",
        oneLine(accept));
  }
  return text;
}

namespace {

enum Kind : std::size_t { falseShadow, falseLight, bothLit, bothShadowed, none };
using Colours = image::DifferenceColours;
/// Red tells the colours apart.
constexpr std::array<std::pair<std::uint8_t, const char*>, 5> kinds = {{
    {Colours::falseShadow[0], "🟧"},
    {Colours::falseLight[0], "🟦"},
    {Colours::bothLit[0], "⬜"},
    {Colours::bothShadowed[0], "⬛"},
    {Colours::none[0], "🟫"},
}};

std::size_t kindOf(float red, const std::filesystem::path& path) {
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    if (std::lround(255 * red) == kinds[kind].first) return kind;
  }
  throw InputError(fmt::format("{}: a colour found that no signed difference has", path.string()));
}

using Counts = std::array<int, kinds.size()>;

const char* squareOf(const Counts& counts) {
  const int samples =
      counts[falseShadow] + counts[falseLight] + counts[bothLit] + counts[bothShadowed];
  const std::size_t error = counts[falseShadow] >= counts[falseLight] ? falseShadow : falseLight;
  if (samples > 0 && 8 * (counts[falseShadow] + counts[falseLight]) >= samples) {
    return kinds[error].second;
  }
  const auto most = std::max_element(counts.begin(), counts.end());
  return kinds[static_cast<std::size_t>(most - counts.begin())].second;
}

}  // namespace

std::string mosaicOf(const std::filesystem::path& difference, int columns) {
  const image::GreyPicture picture = image::readGreyPicture(difference, "R");
  columns = std::clamp(columns, 1, picture.width);
  const int rows = std::max(1, picture.height * columns / picture.width);
  std::string text;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      Counts counts{};
      for (int y = picture.height * row / rows; y < picture.height * (row + 1) / rows; ++y) {
        for (int x = picture.width * column / columns; x < picture.width * (column + 1) / columns;
             ++x) {
          const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x);
          ++counts.at(kindOf(picture.values[pixel], difference));
        }
      }
      text += squareOf(counts);
    }
    text += '\n';
  }
  return text;
}

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

namespace {

struct Tally {
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;

  Tally& operator+=(const Tally& other) {
    tests += other.tests;
    failures += other.failures;
    errors += other.errors;
    skipped += other.skipped;
    return *this;
  }
};

void set(pugi::xml_node node, const char* name, const std::string& text) {
  node.append_attribute(name).set_value(xmlText(text).c_str());
}

/// The attributes that a suite and the whole have alike.
void describe(pugi::xml_node node, const std::string& name, const Tally& counts, double seconds) {
  set(node, "name", name);
  set(node, "tests", fmt::format("{}", counts.tests));
  set(node, "failures", fmt::format("{}", counts.failures));
  set(node, "errors", fmt::format("{}", counts.errors));
  set(node, "skipped", fmt::format("{}", counts.skipped));
  set(node, "time", fmt::format("{:.3f}", seconds));
}

pugi::xml_node addCase(pugi::xml_node suite, const std::string& group, const std::string& name) {
  pugi::xml_node node = suite.append_child("testcase");
  set(node, "classname", group);
  set(node, "name", name);
  return node;
}

/// `failure` or `error`.
void addFault(pugi::xml_node testCase, const char* kind, const std::string& type,
              const std::string& message, const study::CheckRecord& check) {
  pugi::xml_node fault = testCase.append_child(kind);
  set(fault, "type", type);
  set(fault, "message", message);
  const std::string text = fmt::format("{}\nReproduce: {}", message, check.command);
  fault.append_child(pugi::node_pcdata).set_value(xmlText(text).c_str());
}

std::string placeOf(const study::CheckRecord& check, const study::Gate& gate) {
  const auto [file, line] = gatePlace(check, gate);
  return line > 0 ? fmt::format("{}:{}", file, line) : file;
}

Tally addGate(pugi::xml_node suite, const study::CheckRecord& check,
              const study::Judgement& judgement) {
  const study::Gate& gate = judgement.gate;
  const std::string kind = gateOriginName(gate);
  pugi::xml_node node = addCase(suite, fmt::format("{}.{}", check.name, kind), gateTitle(gate));
  Tally counts{1, 0, 0, 0};
  const std::string message = fmt::format("{}: {}", placeOf(check, gate), gateFaultText(judgement));
  switch (judgement.verdict) {
    case study::GateVerdict::passed:
      break;
    case study::GateVerdict::failed:
      addFault(node, "failure", kind, message, check);
      counts.failures = 1;
      break;
    case study::GateVerdict::undefined:
      addFault(node, "error", "undefined", message, check);
      counts.errors = 1;
      break;
    case study::GateVerdict::skipped:
      set(node.append_child("skipped"), "message", judgement.reason);
      counts.skipped = 1;
      break;
  }
  return counts;
}

const char* statusName(ExitStatus status) {
  switch (status) {
    case ExitStatus::pass:
    case ExitStatus::thresholdFailed:
      return "threshold";
    case ExitStatus::usage:
      return "usage";
    case ExitStatus::badInput:
      return "bad input";
    case ExitStatus::internal:
      return "internal";
    case ExitStatus::noGl:
      return "no OpenGL";
  }
  throw InternalError("check: a status that has no name");
}

Tally addSuite(pugi::xml_node root, const study::CheckRecord& check) {
  pugi::xml_node suite = root.append_child("testsuite");
  Tally counts;
  pugi::xml_node property = suite.append_child("properties").append_child("property");
  set(property, "name", "command");
  set(property, "value", check.command);
  for (const study::ProblemRecord& problem : check.problems) {
    addFault(addCase(suite, check.name, problem.part), "error", statusName(problem.status),
             problem.message, check);
    counts += {1, 0, 1, 0};
  }
  for (const study::Judgement& judgement : check.judgements)
    counts += addGate(suite, check, judgement);
  describe(suite, check.name, counts, check.seconds);
  set(suite, "file", check.file);
  return counts;
}

}  // namespace

std::string junitXml(std::span<const study::CheckRecord> checks) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node root = document.append_child("testsuites");
  Tally counts;
  double seconds = 0;
  for (const study::CheckRecord& check : checks) {
    counts += addSuite(root, check);
    seconds += check.seconds;
  }
  describe(root, "gnomon check", counts, seconds);
  std::ostringstream text;
  document.save(text, "  ", pugi::format_default, pugi::encoding_utf8);
  return std::move(text).str();
}

}  // namespace gnomon::report
