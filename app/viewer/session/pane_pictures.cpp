#include "viewer/session/pane_pictures.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "render/gl_objects.h"

namespace gnomon::app {
namespace {

/// Of the kind that the light asks for.
Answers noAnswers(const ViewState& state) {
  const Camera& camera = state.camera;
  if (state.light.radius > 0) return emptyMap<Visibility>(camera.width, camera.height);
  return emptyMap<Mask>(camera.width, camera.height);
}

const PartialTruth* truthOf(const KnownTruth& known, study::MeshChoice mesh, const Camera& camera) {
  const auto found = known.truths.find(mesh);
  if (found == known.truths.end()) return nullptr;
  const surface::SampleGrid& samples = *found->second.samples;
  return samples.width == camera.width && samples.height == camera.height ? &found->second
                                                                          : nullptr;
}

/// A method's answers where both have one, to be compared: neither has one where
/// the other lacks it. Where a truth has none yet, it counts as agreement.
template <typename Map>
void makeComparable(Map& first, Map& second, bool agreeWhereUnknown) {
  for (std::size_t i = 0; i < first.size(); ++i) {
    auto& a = valuesOf(first)[i];
    auto& b = valuesOf(second)[i];
    if (isAnswer(a) && isAnswer(b)) continue;
    if (agreeWhereUnknown && isAnswer(a) != isAnswer(b)) {
      (isAnswer(a) ? b : a) = isAnswer(a) ? a : b;
    } else {
      a = b = absentIn(first);
    }
  }
}

/// Both are of one kind, that of the light.
std::pair<Answers, Answers> comparable(Answers first, Answers second, bool agreeWhereUnknown) {
  std::visit(
      [&](auto& map) {
        makeComparable(map, std::get<std::decay_t<decltype(map)>>(second), agreeWhereUnknown);
      },
      first);
  return {std::move(first), std::move(second)};
}

/// In the colours of the report.
image::Image differenceOf(const Answers& candidate, const Answers& truth) {
  if (const auto* map = std::get_if<Visibility>(&candidate)) {
    return image::shareDifferenceImage(*map, std::get<Visibility>(truth));
  }
  return image::unfolded(image::differenceImage(std::get<Mask>(candidate), std::get<Mask>(truth)));
}

/// Why there is nothing to show of methods that lack a common mesh; empty while one is awaited.
std::string noteOfNone(const DrawnScene& scene, const PaneContent& content) {
  bool waits = false;
  for (const PaneSource& source : {content.shown, content.against.value_or(tracedTruth)}) {
    if (!source.isMethod() || scene.method(source.label)) continue;
    if (scene.errors().contains(source.label)) return "not shown: see the message";
    waits = true;
  }
  return waits ? "" : "these two draw different meshes: their pixels cannot be compared";
}

std::vector<Vec3> endsOf(const std::vector<LineSegment>& lines) {
  std::vector<Vec3> ends;
  ends.reserve(2 * lines.size());
  for (const LineSegment& line : lines) {
    ends.push_back(line.begin);
    ends.push_back(line.end);
  }
  return ends;
}

}  // namespace

PanePictures::PanePictures(const std::filesystem::path& shaders)
    : shaders_(shaders), samples_(shaders) {}

void PanePictures::reloadShaders(const std::filesystem::path& shaders) {
  render::SamplesPass samples(shaders);
  if (programs_) programs_.emplace(Programs(shaders, programs_->wrap));
  samples_ = std::move(samples);
}

std::optional<study::MeshChoice> PanePictures::meshOf(const DrawnScene& scene,
                                                      const PaneContent& content) {
  std::optional<study::MeshChoice> mesh;
  for (const PaneSource& source : {content.shown, content.against.value_or(tracedTruth)}) {
    if (!source.isMethod()) continue;
    const auto ready = scene.method(source.label);
    if (!ready || (mesh && *mesh != ready->data->mesh)) return std::nullopt;
    mesh = ready->data->mesh;
  }
  return mesh ? mesh : scene.data()->standardMesh();
}

surface::SampleGrid PanePictures::samplesOf(const DrawnScene& scene, study::MeshChoice mesh,
                                            const Camera& camera) const {
  const render::RenderView view = render::cameraView(camera, scene.data()->meshes.at(mesh)->mesh());
  return samples_.render(view, scene.mesh(mesh).gpu);
}

const Answers* PanePictures::methodAnswers(const DrawnScene& scene, const ViewState& state,
                                           const std::string& label, std::uint64_t serial) {
  const auto found = answers_.find(label);
  if (found != answers_.end() && found->second.serial == serial) return &found->second.answers;
  const auto ready = scene.method(label);
  if (!ready) return nullptr;
  const study::MeshChoice mesh = ready->data->mesh;
  const render::RenderView view =
      render::cameraView(state.camera, scene.data()->meshes.at(mesh)->mesh());
  const Light light = makeLight(state.light);
  const render::Drawing drawing = scene.drawing(*ready->data, light);
  CachedAnswers& kept = answers_[label];
  kept = {serial, light.isSoft()
                      ? Answers(ready->pass->renderVisibility(view, drawing, ready->tables).drawn)
                      : Answers(ready->pass->render(view, drawing, ready->tables).drawn)};
  return &kept.answers;
}

void PanePictures::shade(Pane& pane, const DrawnScene& scene, const ViewState& state,
                         study::MeshChoice mesh, const Answers& answers) {
  const relief::Wrap wrap = scene.data()->heights->wrap();
  if (!programs_ || programs_->wrap != wrap) programs_.emplace(shaders_, wrap);
  const render::RenderView view =
      render::cameraView(state.camera, scene.data()->meshes.at(mesh)->mesh());
  if (!pane.target || pane.target->width() != view.width || pane.target->height() != view.height) {
    pane.target =
        std::make_unique<render::Target>(view.width, view.height, std::vector<GLenum>{GL_RGBA8});
  }
  const render::ShadePass& pass =
      mesh.kind == render::DrawnMesh::displaced ? programs_->shadeDisplaced : programs_->shadeBase;
  const render::Drawing drawing = scene.drawing(mesh, makeLight(state.light));
  std::visit([&](const auto& map) { pass.draw(view, drawing, map, *pane.target); }, answers);
  if (const auto& lines = scene.data()->lines; lines && state.overlays.directions) {
    programs_->lines.draw(view, endsOf(lines->larger), {0.70F, 0.10F, 0.35F}, *pane.target);
    programs_->lines.draw(view, endsOf(lines->smaller), {0.05F, 0.35F, 0.60F}, *pane.target);
  }
  pane.shown.texture = pane.target->colourTexture(0);
  pane.shown.topDown = false;
}

void PanePictures::showImage(Pane& pane, const image::Image& image) {
  const render::gl::TextureSize size{image.width, image.height};
  if (pane.imageWidth != image.width || pane.imageHeight != image.height) {
    pane.image = render::gl::makeTexture(GL_TEXTURE_2D, GL_RGB8, size, GL_NEAREST);
    pane.imageWidth = image.width;
    pane.imageHeight = image.height;
  }
  render::gl::fill(pane.image, size, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  pane.shown.texture = pane.image.name();
  pane.shown.topDown = true;
}

void PanePictures::measure(Pane& pane, const PaneContent& content, const DrawnScene& scene,
                           const ViewState& state, const KnownTruth& truth, std::uint64_t serial) {
  pane.shown.figures.reset();
  pane.shown.partFigures.reset();
  const auto mesh = meshOf(scene, content);
  if (!mesh || !content.shown.isMethod()) return;
  const Answers* candidate = methodAnswers(scene, state, content.shown.label, serial);
  if (candidate == nullptr) return;
  const auto compare = [&](const Answers& a, const Answers& b,
                           std::span<const std::uint8_t> traced) {
    pane.shown.figures = paneFigures(a, b, traced);
    if (state.part) pane.shown.partFigures = paneFigures(a, b, traced, *state.part);
  };
  if (content.against && content.against->isMethod()) {
    const Answers* other = methodAnswers(scene, state, content.against->label, serial);
    if (other == nullptr) return;
    const auto [a, b] = comparable(*candidate, *other, false);
    compare(
        a, b,
        std::vector<std::uint8_t>(std::visit([](const auto& map) { return map.size(); }, a), 1));
    return;
  }
  const PartialTruth* partial = truth.stale ? nullptr : truthOf(truth, *mesh, state.camera);
  if (partial == nullptr || partial->tracedCount == 0) return;
  compare(*candidate, partial->answers, partial->traced);
}

void PanePictures::drawPane(Pane& pane, const PaneContent& content, const DrawnScene& scene,
                            const ViewState& state, const KnownTruth& truth, std::uint64_t serial) {
  pane.shown.note.clear();
  if (content.shown == displacedSurface) {
    if (truth.picture) showImage(pane, *truth.picture);
    if (!truth.picture) {
      shade(pane, scene, state, scene.data()->standardMesh(), noAnswers(state));
    }
    return;
  }
  const auto mesh = meshOf(scene, content);
  if (!mesh) {
    pane.shown.note = noteOfNone(scene, content);
    if (!pane.shown.note.empty()) {
      shade(pane, scene, state, scene.data()->standardMesh(), noAnswers(state));
    }
    return;  // what was there stays until the tables are ready
  }
  const PartialTruth* partial = truthOf(truth, *mesh, state.camera);
  const auto operand = [&](const PaneSource& source) -> std::optional<Answers> {
    // A truth of the light before is no measure: until there is another, nothing differs.
    const bool usable = partial != nullptr && !(truth.stale && content.isDifference());
    if (source == tracedTruth) return usable ? partial->preview : noAnswers(state);
    const Answers* answers = methodAnswers(scene, state, source.label, serial);
    return answers != nullptr ? std::optional(*answers) : std::nullopt;
  };
  const auto first = operand(content.shown);
  if (!first) return;
  if (content.against) {
    const auto second = operand(*content.against);
    if (!second) return;
    const bool hasTruth = content.shown == tracedTruth || *content.against == tracedTruth;
    const auto [a, b] = comparable(*first, *second, hasTruth);
    showImage(pane, differenceOf(a, b));
  } else {
    shade(pane, scene, state, *mesh, *first);
  }
}

bool PanePictures::draw(const DrawnScene& scene, const ViewState& state, const KnownTruth& truth,
                        std::uint64_t serial) {
  serial_ = serial;
  bool drawn = false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.paneCount); ++i) {
    Pane& pane = panes_.at(i);
    const Key key{state.panes.at(i), serial, truth.serial, state.overlays.directions};
    const bool isDrawn = pane.key == key;
    if (isDrawn && pane.part == state.part) continue;
    try {
      if (!isDrawn) drawPane(pane, key.content, scene, state, truth, serial);
      measure(pane, key.content, scene, state, truth, serial);
    } catch (const Error& error) {
      pane.shown.note = error.what();
      pane.shown.figures.reset();
      pane.shown.partFigures.reset();
    }
    pane.key = key;
    pane.part = state.part;
    drawn = true;
  }
  return drawn;
}

const Answers* PanePictures::answersOf(const DrawnScene& scene, const ViewState& state,
                                       const KnownTruth& truth, const PaneContent& content) {
  if (content.isDifference() || content.shown == displacedSurface) return nullptr;
  const auto mesh = meshOf(scene, content);
  if (!mesh) return nullptr;
  const PartialTruth* partial = truth.stale ? nullptr : truthOf(truth, *mesh, state.camera);
  if (content.shown == tracedTruth) {
    return partial != nullptr ? &partial->answers : nullptr;
  }
  return methodAnswers(scene, state, content.shown.label, serial_);
}

}  // namespace gnomon::app
