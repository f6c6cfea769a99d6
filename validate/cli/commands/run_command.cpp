#include "cli/commands/run_command.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <map>
#include <memory>

#include "cli/commands/cache_command.h"
#include "cli/output.h"
#include "cli/shards/merge_command.h"
#include "cli/study_plans.h"
#include "common/error.h"
#include "common/files/part_file.h"
#include "common/lists.h"
#include "common/system/memory.h"
#include "horizon/table_file.h"
#include "report/paper_files.h"
#include "study/run/run_study.h"

namespace gnomon::cli {

namespace fs = std::filesystem;
namespace {

void bakeTables(const study::StudySpec& study, const fs::path& out, cache::Cache& cache) {
  TerminalProgress progress(study.name);
  const horizon::StoredHorizons stored =
      study::bakeStudyTables(study, cache, [&](double share) { progress.update("bake", share); });
  const fs::path path = out / study.name / "tables.exr";
  removeLeftovers(path.parent_path());
  horizon::writeHorizons(path, stored);
  printLine(fmt::format("{}: {} × {} texels, {} azimuths, {} in {} bits", path.string(),
                        stored.width, stored.height, stored.layers,
                        formatBytes(static_cast<double>(stored.byteCount())),
                        static_cast<int>(study.bake.bits)));
}

}  // namespace

ExitStatus runStudies(const RunRequest& request) {
  if (request.shard) return runShard(request);
  const std::vector<study::StudyPlan> plans = readPlans(request.studies, request.options);
  requirePaperMethods(request.paper, plans);
  Failures failures;
  return measurePlans(plans, request, failures);
}

ExitStatus bakeStudies(const RunRequest& request) {
  const std::vector<study::StudyPlan> plans = readPlans(request.studies, request.options);
  const std::unique_ptr<cache::Cache> cache = openCache(request.noCache);
  Failures failures;
  for (const study::StudyPlan& plan : plans) {
    for (const study::StudySpec& step : plan.steps) {
      failures.attempt([&] { bakeTables(step, request.out, *cache); });
    }
  }
  failures.print();
  return failures.status();
}

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
