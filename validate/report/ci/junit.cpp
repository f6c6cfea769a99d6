#include "report/ci/junit.h"

#include <fmt/core.h>

#include <pugixml.hpp>
#include <sstream>

#include "report/text/gate_text.h"
#include "report/text/text_width.h"

namespace gnomon::report {
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
