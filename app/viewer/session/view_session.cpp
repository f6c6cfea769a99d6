#include "viewer/session/view_session.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string_view>

#include "common/error.h"
#include "render/gl_context.h"

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

namespace {

std::function<void(const SceneRequest&, const BackgroundWorker<SceneRequest, SceneResult>::Job&)>
sceneWork(const cli::ViewRequest& asked) {
  return [maker = std::make_shared<SceneMaker>(asked.study, asked.tryMethod)](
             const SceneRequest& request, const auto& job) {
    SceneResult result;
    try {
      result.scene =
          maker->make(request, [&](const std::string& stage) { return job.progress(stage); });
    } catch (const std::exception& error) {
      result.error = error.what();
    }
    job.publish(std::move(result));
  };
}

std::function<void(const TruthRequest&, const TruthTracer::Worker::Job&)> truthWork() {
  return [tracer = std::make_shared<TruthTracer>()](const TruthRequest& request, const auto& job) {
    tracer->trace(request, job);
  };
}

}  // namespace

ViewSession::ViewSession(const cli::ViewRequest& request, const std::function<void()>& wake)
    : opened_(openStudy(request)),
      shaders_(render::shaderFolder()),
      state_(firstView(opened_)),
      scene_(shaders_),
      pictures_(shaders_),
      watch_(shaders_),
      cameraMoved_(Clock::now() - std::chrono::hours(1)),
      baker_(sceneWork(opened_.request), wake),
      tracer_(truthWork(), wake) {}

void ViewSession::resetView() {
  const ViewState first = firstView(opened_);
  const auto [width, height] = std::pair(state_.camera.width, state_.camera.height);
  state_.camera = first.camera;
  state_.camera.width = width;
  state_.camera.height = height;
  state_.light = first.light;
}

study::StudyOptions ViewSession::shownOptions() const {
  study::StudyOptions options = opened_.request.options;
  const std::vector<std::string> changes =
      overridesOf(state_.changes, opened_.request.study, opened_.request.options);
  options.overrides.insert(options.overrides.end(), changes.begin(), changes.end());
  return options;
}

void ViewSession::askForScene() {
  const std::vector<std::string> shown = shownMethods(state_);
  const study::StudyOptions options = shownOptions();
  const bool isSoft = makeLight(state_.light).isSoft();
  const std::string asked =
      fmt::format("{}\n{}\n{}\n{}\n{}", fmt::join(options.overrides, "\n"), fmt::join(shown, "\n"),
                  shaderVersion_, state_.overlays.directions, isSoft);
  if (asked == askedScene_) return;
  askedScene_ = asked;
  sceneArrives_ = true;
  baker_.request({options, shown, state_.overlays.directions, shaderVersion_, isSoft});
}

void ViewSession::takeScenes() {
  while (auto result = baker_.take()) {
    sceneArrives_ = false;
    sceneError_ = result->error;
    if (!result->scene) continue;
    const bool sameTruth = hasScene() && scene()->keys.truth == result->scene->keys.truth;
    auto old = scene_.sharedData();
    try {
      scene_.install(std::move(result->scene));
    } catch (const Error& error) {
      sceneError_ = error.what();
      continue;
    }
    baker_.dispose(std::move(old));
    std::vector<std::filesystem::path> files;
    for (const auto& [label, method] : scene()->methods) {
      files.push_back(method->spec.file);
      for (std::filesystem::path& file : method->method.otherFiles()) {
        files.push_back(std::move(file));
      }
    }
    watch_.watch(files);
    ++serial_;
    if (!sameTruth) {
      forgetTruth(true);
      tracer_.dispose(std::exchange(traced_, {}));  // of another surface
    }
  }
}

/// The light may be followed by a truth that is out of date; another camera has other pixels.
void ViewSession::forgetTruth(bool cameraMoved) {
  tracer_.cancel();
  askedTruth_.clear();
  ++truth_.serial;
  truth_.stale = true;
  pictureWhole_ = false;
  curvatureWhole_ = false;
  if (!cameraMoved) return;
  tracer_.dispose(std::exchange(truth_.truths, {}));
  tracer_.dispose(std::exchange(truth_.picture, {}));
  tracer_.dispose(std::exchange(curvature_, {}));
  tracer_.dispose(std::exchange(grids_, {}));
}

void ViewSession::noticeChanges() {
  const bool cameraMoved = !sameCamera(state_.camera, shownCamera_);
  const bool lightMoved = state_.light != shownLight_;
  if (cameraMoved) cameraMoved_ = Clock::now();
  if (cameraMoved || lightMoved) {
    shownCamera_ = state_.camera;
    shownLight_ = state_.light;
    ++serial_;
    forgetTruth(cameraMoved);
  }
  if (watch_.changed()) reloadShaders();
}

void ViewSession::reloadShaders() {
  // Methods compile again with the next scene, for which they are read and tried again.
  ++shaderVersion_;
  ++serial_;
  try {
    pictures_.reloadShaders(shaders_);
    shaderError_.clear();
  } catch (const InputError& error) {
    shaderError_ = error.what();
  }
}

std::vector<AnglesRequest> ViewSession::missingAngles() const {
  std::vector<AnglesRequest> missing;
  for (const auto& [label, method] : scene()->methods) {
    if (!scene_.lacksAngles(label)) continue;
    const render::RenderView& plane = scene_.mesh(method->mesh).texture;
    render::requireTextureView(plane);
    missing.push_back({label,
                       scene_.anglesKey(*method),
                       method->spec.bake,
                       pictures_.texelsOf(plane, scene_.mesh(method->mesh).gpu),
                       {plane.texelWindow.x, plane.texelWindow.y}});
  }
  return missing;
}

void ViewSession::askForTruth() {
  constexpr auto rest = std::chrono::milliseconds(120);
  if (!hasScene() || Clock::now() - cameraMoved_ < rest) return;
  TruthRequest wanted;
  bool wantsPicture = false;
  std::string asked = scene()->keys.truth.text();
  std::set<study::MeshChoice> meshes;
  for (int i = 0; i < state_.paneCount; ++i) {
    const PaneContent& content = state_.panes.at(static_cast<std::size_t>(i));
    if (content.shown == displacedSurface) wantsPicture = true;
    const auto mesh = PanePictures::meshOf(scene_, content);
    if (mesh && needsTruth(content)) meshes.insert(*mesh);
  }
  const study::MeshChoice standard = scene()->standardMesh();
  if (state_.overlays.curvature || state_.overlays.section || state_.overlays.pixel) {
    meshes.insert(standard);
  }
  for (const study::MeshChoice& mesh : meshes) {
    asked += fmt::format("\n{} {} {}", static_cast<int>(mesh.kind), mesh.base.subdivisions,
                         static_cast<int>(mesh.base.curvature));
  }
  asked += fmt::format("\n{} {}", wantsPicture, state_.overlays.curvature);
  for (const auto& [label, method] : scene()->methods) {
    if (scene_.lacksAngles(label)) asked += "\n" + scene_.anglesKey(*method).text() + label;
  }
  if (asked == askedTruth_) return;
  askedTruth_ = asked;
  for (const study::MeshChoice& mesh : meshes) {
    auto& grid = grids_[mesh];
    if (!grid) {
      grid = std::make_shared<const surface::SampleGrid>(
          pictures_.samplesOf(scene_, mesh, state_.camera));
    }
    const auto known = truth_.truths.find(mesh);
    const bool whole = !truth_.stale && known != truth_.truths.end() && known->second.share() == 1;
    if (!whole) wanted.views.push_back({mesh, grid});
  }
  wanted.scene = scene_.sharedData();
  wanted.light = makeLight(state_.light);
  if (wantsPicture && !pictureWhole_) wanted.picture = state_.camera;
  if (state_.overlays.curvature && !curvatureWhole_) wanted.curvature = grids_.at(standard);
  wanted.angles = missingAngles();
  tracer_.request(std::move(wanted));
}

void ViewSession::takeTruths() {
  while (auto result = tracer_.take()) {
    if (truth_.stale && result->truth) {
      truth_.stale = false;
      tracer_.dispose(std::exchange(truth_.truths, {}));
    }
    ++truth_.serial;
    traced_ = result->traced;
    truthError_ = result->error;
    if (result->truth) {
      auto& known = truth_.truths[result->truth->mesh];
      std::swap(known, *result->truth);
      tracer_.dispose(std::move(*result->truth));
    }
    if (result->picture) {
      pictureWhole_ = result->picture->width == state_.camera.width &&
                      result->picture->height == state_.camera.height;
      std::swap(truth_.picture, result->picture);
      tracer_.dispose(std::move(result->picture));
    }
    if (result->curvature) {
      std::swap(curvature_, result->curvature);
      tracer_.dispose(std::move(result->curvature));
      curvatureWhole_ = true;
    }
    if (result->angles) {
      const ShotAngles& angles = *result->angles;
      if (scene_.installAngles(angles.label, angles.key, angles.table)) ++serial_;
    }
  }
}

bool ViewSession::update() {
  noticeChanges();
  try {
    askForScene();
  } catch (const Error& error) {  // the study's file is not what it was
    sceneError_ = error.what();
  }
  takeScenes();
  if (!hasScene()) return false;
  try {
    askForTruth();
  } catch (const Error& error) {
    truthError_ = error.what();
  }
  takeTruths();
  const bool drawn = pictures_.draw(scene_, state_, truth_, serial_);
  render::throwOnGlError("drawing the panes");
  return drawn;
}

bool ViewSession::isComplete() const {
  if (!hasScene()) return !sceneError_.empty();
  if (sceneArrives_ || askedTruth_.empty()) return false;
  if (!truthError_.empty()) return true;
  for (const auto& [label, method] : scene()->methods) {
    if (scene_.lacksAngles(label)) return false;
  }
  for (int i = 0; i < state_.paneCount; ++i) {
    const auto pane = static_cast<std::size_t>(i);
    const PaneContent& content = state_.panes.at(pane);
    if (content.shown == displacedSurface && !pictureWhole_) return false;
    if (needsTruth(content) && PanePictures::meshOf(scene_, content) && tracedShare(pane) < 1) {
      return false;
    }
  }
  return !state_.overlays.curvature || curvatureWhole_;
}

double ViewSession::tracedShare(std::size_t pane) const {
  if (!hasScene() || truth_.stale) return 0;
  const auto mesh = PanePictures::meshOf(scene_, state_.panes.at(pane));
  if (!mesh) return 0;
  const auto found = truth_.truths.find(*mesh);
  return found == truth_.truths.end() ? 0 : found->second.share();
}

const Answers* ViewSession::answersOf(const PaneContent& content) {
  return hasScene() ? pictures_.answersOf(scene_, state_, truth_, content) : nullptr;
}

const surface::SampleGrid* ViewSession::samples() const {
  if (!hasScene()) return nullptr;
  const auto found = grids_.find(scene()->standardMesh());
  return found == grids_.end() ? nullptr : found->second.get();
}

std::vector<std::string> ViewSession::errors() const {
  std::vector<std::string> lines;
  for (const std::string& error : {shaderError_, sceneError_, truthError_}) {
    if (!error.empty()) lines.push_back(error);
  }
  for (const auto& [label, error] : scene_.errors()) lines.push_back(error);
  return lines;
}

}  // namespace gnomon::app
