#include "viewer/session/first_view.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "common/error.h"

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

/// The control of every study: bump mapping alone.
constexpr std::string_view controlMethod = "unshadowed";

bool isControl(const study::StudySpec& study, const std::string& label) {
  return std::any_of(study.methods.begin(), study.methods.end(),
                     [&](const study::MethodSpec& method) {
                       return method.label == label && method.file.stem() == controlMethod;
                     });
}

ViewPart partOf(const std::vector<double>& percent) {
  const ViewPart part{percent[0] / 100, percent[1] / 100, percent[2] / 100, percent[3] / 100};
  const bool isOne = part.left >= 0 && part.left < part.right && part.right <= 1 && part.top >= 0 &&
                     part.top < part.bottom && part.bottom <= 1;
  if (isOne) return part;
  throw UsageError(
      fmt::format("--rectangle {}: left, top, right and bottom, percent of the "
                  "picture, as 25,20,75,70, expected",
                  fmt::join(percent, ",")));
}

}  // namespace

const std::string& firstMethod(const OpenedStudy& opened) {
  const auto begin = opened.labels.begin();
  const auto end = opened.ownCount > 0 ? begin + static_cast<std::ptrdiff_t>(opened.ownCount)
                                       : opened.labels.end();
  const auto found = std::find_if(
      begin, end, [&](const std::string& label) { return !isControl(*opened.study, label); });
  return found == end ? opened.labels.front() : *found;
}

ViewState firstView(const OpenedStudy& opened) {
  const cli::ViewRequest& request = opened.request;
  ViewState state;
  state.camera = firstCamera(*opened.study);
  state.light = opened.study->lights.front().angles;
  const PaneSource first = methodSource(firstMethod(opened));
  state.panes = {PaneContent{first}, PaneContent{tracedTruth}, PaneContent{first, tracedTruth},
                 PaneContent{displacedSurface}};
  const std::size_t count = request.show.size();
  if (count == 3 || count > state.panes.size()) {
    throw UsageError(fmt::format("--show: {} panes found, 1, 2 or 4 expected", count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    state.panes.at(i) = parseContent(request.show[i], opened.labels);
  }
  state.paneCount = count == 0 ? 2 : static_cast<int>(count);
  for (const std::string& overlay : request.overlays) {
    if (overlay == "curvature") state.overlays.curvature = true;
    if (overlay == "directions") state.overlays.directions = true;
    if (overlay == "section") state.overlays.section = true;
    if (overlay == "pixel") state.overlays.pixel = true;
  }
  if (!request.rectangle.empty()) state.part = partOf(request.rectangle);
  state.panel = request.panel;
  state.help = request.help;
  return state;
}

}  // namespace gnomon::app
