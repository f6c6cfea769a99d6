#include "viewer/session/opened_study.h"

#include <set>

#include "cli/output.h"
#include "common/lists.h"
#include "render/method.h"
#include "render/shader_files.h"
#include "study/spec/method_changes.h"
#include "study/spec/resolved_study.h"
#include "study/spec/study_file.h"
#include "study/spec/toml_reader.h"

namespace gnomon::app {
namespace {

/// The request's options, with all built-in methods after the study's own.
study::StudyOptions optionsOf(const cli::ViewRequest& request) {
  study::StudyOptions options = request.options;
  const toml::table table = study::studyTable(request.study, request.options);
  std::set<std::string> labels;
  if (const toml::array* methods = table["method"].as_array()) {
    for (const toml::node& method : *methods) {
      if (method.is_table()) labels.insert(study::methodLabel(*method.as_table()));
    }
  }
  // A study without methods is refused by its reader, which says so better.
  if (labels.empty()) return options;
  for (const std::string& name : render::methodNames(render::shaderFolder())) {
    if (labels.insert(name).second) options.addedMethods.push_back(name);
  }
  return options;
}

StudyNumbers numbersOf(const cli::ViewRequest& request) {
  const toml::table table = study::parseToml(request.study, request.options.overrides);
  return {table["relief"]["height"].value<double>(), table["surface"]["curvature"].value<double>()};
}

}  // namespace

OpenedStudy openStudy(const cli::ViewRequest& request) {
  OpenedStudy opened{request, {}, numbersOf(request), {}, 0};
  study::StudyOptions& options = opened.request.options;
  options = optionsOf(request);
  opened.study = std::make_shared<const study::StudySpec>(study::readStudy(request.study, options));
  if (request.screenshot) {
    cli::requireNoInput("--screenshot", *request.screenshot, study::inputFiles(*opened.study));
  }
  for (const study::MethodSpec& method : opened.study->methods) {
    // Masks that another program drew belong to one camera: they cannot follow a moving one.
    if (method.isGiven()) continue;
    opened.labels.push_back(method.label);
    if (!contains(options.addedMethods, method.label)) opened.ownCount = opened.labels.size();
  }
  return opened;
}

}  // namespace gnomon::app
