#include "cli/paper_request.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <map>

#include "cli/list_option.h"
#include "common/error.h"
#include "common/lists.h"
#include "report/paper/paper_table.h"

namespace gnomon::cli {

CLI::Option* addPaperOptions(CLI::App& command, report::PaperOptions& options) {
  const std::map<std::string, report::PaperWidth> widths = {{"column", report::PaperWidth::column},
                                                            {"page", report::PaperWidth::page}};
  CLI::Option* figures =
      command
          .add_option("--figures", options.widths,
                      "Also write figures for a paper, as PDF: as wide as a column, 84 mm, "
                      "or a page, 178 mm; of a page its table too. May be repeated")
          ->transform(CLI::CheckedTransformer(widths).description(""))
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
          ->type_name("column|page");
  addList(command, "--paper-method", options.methods,
          "Show only this method, by its label, in the figures and tables for a paper; may be "
          "repeated",
          "LABEL");
  command
      .add_option("--paper-font", options.fontSize,
                  "Size of the text in the figures and tables for a paper, points")
      ->capture_default_str()
      ->check(CLI::Range(5.0, 14.0))
      ->type_name("SIZE");
  const std::vector<std::string> columns = report::paperColumnKeys();
  addList(command, "--table-column", options.columns,
          fmt::format("Show only this column beside the method in the tables for a paper; may be "
                      "repeated: {}",
                      fmt::join(columns, ", ")),
          "KEY")
      ->check(CLI::IsMember(columns).description(""));
  return figures;
}

void appendLabels(const study::StudyPlan& plan, std::vector<std::string>& labels) {
  for (const study::StudySpec& step : plan.steps) {
    for (const study::MethodSpec& method : step.methods) appendOnce(labels, method.label);
  }
}

void requirePaperMethods(const report::PaperOptions& options,
                         const std::vector<study::StudyPlan>& plans) {
  std::vector<std::string> labels;
  for (const study::StudyPlan& plan : plans) appendLabels(plan, labels);
  requirePaperMethods(options, labels);
}

void requirePaperMethods(const report::PaperOptions& options,
                         const std::vector<std::string>& measured) {
  for (const std::string& label : options.methods) {
    if (contains(measured, label)) continue;
    throw UsageError(
        fmt::format("--paper-method: \"{}\" found, a method that is measured expected: {}", label,
                    fmt::join(measured, ", ")));
  }
}

}  // namespace gnomon::cli
