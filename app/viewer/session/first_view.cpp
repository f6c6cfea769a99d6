#include "viewer/session/first_view.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <set>

#include "render/method.h"
#include "render/shader_files.h"
#include "study/spec/method_replacement.h"
#include "study/spec/study_table.h"
#include "study/spec/toml/toml_reader.h"

namespace gnomon::app {
namespace {

/// Half from above, the whole cage in view.
Camera cameraOn(const surface::Cage& cage) {
  Vec3 low(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (const Vec3& position : cage.positions) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  Camera camera;
  camera.target = (low + high) / 2.0;
  const double radius = glm::length(high - low) / 2;
  camera.eye = camera.target + 4.2 * radius * glm::normalize(Vec3(0, -1, 1));
  camera.up = {0, 0, 1};
  return camera;
}

Camera firstCamera(const study::StudySpec& study) {
  for (const study::ViewSpec& view : study.views) {
    if (const Camera* camera = study::cameraOf(view)) return *camera;
  }
  return cameraOn(study.cage);
}

}  // namespace

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

std::vector<std::string> labelsOf(const study::StudySpec& study) {
  std::vector<std::string> labels;
  for (const study::MethodSpec& method : study.methods) {
    if (!method.isGiven()) labels.push_back(method.label);
  }
  return labels;
}

ViewState firstView(const study::StudySpec& study, const cli::ViewRequest& request,
                    const std::vector<std::string>& labels) {
  ViewState state;
  state.camera = firstCamera(study);
  state.light = lightAngles(study.lights.front());
  const bool hasPaper = std::find(labels.begin(), labels.end(), "onoue-2004") != labels.end();
  const std::string method = hasPaper ? "onoue-2004" : labels.front();
  const PaneSource first = methodSource(method);
  state.panes = {PaneContent{first}, PaneContent{tracedTruth}, PaneContent{first, tracedTruth},
                 PaneContent{displacedSurface}};
  const std::size_t count = request.show.size();
  if (count == 3 || count > state.panes.size()) {
    throw UsageError(fmt::format("--show: {} panes found, 1, 2 or 4 expected", count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    state.panes.at(i) = parseContent(request.show[i], labels);
  }
  state.paneCount = count == 0 ? 1 : static_cast<int>(count);
  for (const std::string& overlay : request.overlays) {
    if (overlay == "curvature") state.overlays.curvature = true;
    if (overlay == "directions") state.overlays.directions = true;
    if (overlay == "section") state.overlays.section = true;
    if (overlay == "pixel") state.overlays.pixel = true;
  }
  state.panel = request.panel;
  state.help = request.help;
  return state;
}

}  // namespace gnomon::app
