#pragma once

#include <string>
#include <vector>

#include "report/paper/paper_options.h"
#include "study/spec/sweep/sweep.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gnomon::cli {

/// Adds the options that say what is written for a paper.
/// @return --figures
CLI::Option* addPaperOptions(CLI::App& command, report::PaperOptions& options);

/// Adds the labels of the methods that a study measures, each once.
void appendLabels(const study::StudyPlan& plan, std::vector<std::string>& labels);

/// @throws UsageError for a chosen method that none of the studies measures
void requirePaperMethods(const report::PaperOptions& options,
                         const std::vector<study::StudyPlan>& plans);

/// @param measured  labels
/// @throws UsageError for a chosen method that none of them is
void requirePaperMethods(const report::PaperOptions& options,
                         const std::vector<std::string>& measured);

}  // namespace gnomon::cli
