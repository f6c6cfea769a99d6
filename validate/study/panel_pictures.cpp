#include "study/panel_pictures.h"

#include <fmt/core.h>

#include "common/parallel.h"
#include "study/file_names.h"
#include "truth/displaced_picture.h"

namespace gnomon {
namespace {

template <typename Entries, typename NameOf>
std::vector<std::string> namesOf(const Entries& entries, const NameOf& nameOf) {
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const auto& entry : entries) names.push_back(nameOf(entry));
  return names;
}

}  // namespace

/// An answer of a panel with the keys of its pictures. Its mask is asked for only where one of them
/// has to be made.
struct PanelPictures::Answer {
  ContentKey key;
  const BaseCase& base;
  const Mask* truth;  ///< what the mask is held against; null for the truth itself
  std::function<const Mask&()> mask;
};

PanelPictures::PanelPictures(RunScene& scene, RunWriter& writer)
    : scene_(scene),
      writer_(writer),
      viewFiles_(
          fileNames(namesOf(scene.study.views, [](const ViewSpec& view) { return view.name; }))),
      lightFiles_(fileNames(
          namesOf(scene.study.lights, [](const LightSpec& light) { return light.name; }))),
      methodFiles_(fileNames(
          namesOf(scene.study.methods, [](const MethodSpec& method) { return method.label; }),
          {"truth", "displaced"})) {}

std::string PanelPictures::path(const char* folder, std::size_t view, std::size_t light,
                                const std::string& name) const {
  return fmt::format("{}/{}_{}_{}.png", folder, viewFiles_[view], lightFiles_[light], name);
}

void PanelPictures::write(const std::string& path, const ContentKey& key,
                          const std::function<std::string()>& bytes) {
  scene_.clock.measure(
      "writing", [&](const Progress&) { writer_.write(path, scene_.cache.remember(key, bytes)); });
}

void PanelPictures::drawDisplaced(SurfaceOnDemand& surface) {
  for (std::size_t v = 0; v < scene_.study.views.size(); ++v) {
    const auto* camera = std::get_if<Camera>(&scene_.study.views[v].kind);
    if (camera == nullptr) continue;
    for (std::size_t l = 0; l < scene_.study.lights.size(); ++l) {
      write(path("images", v, l, "displaced"), scene_.keys.displacedPicture(v, l), [&] {
        const TracedSurface& traced = surface.get();
        const auto picture =
            scene_.clock.measure("displaced picture", [&](const Progress& progress) {
              return displacedPicture(traced.mesh, traced.scene, *camera,
                                      scene_.study.lights[l].direction(), progress);
            });
        return writer_.displaced(camera->width, camera->height, picture);
      });
    }
  }
}

std::vector<std::uint8_t> PanelPictures::shade(std::size_t view, std::size_t light,
                                               const BaseCase& base, const Mask& mask) {
  return scene_.clock.measure("pictures", [&](const Progress&) {
    if (!shade_) shade_.emplace(scene_.shaders, scene_.study.relief.field.wrap());
    return shade_->render(base.views[view].view, scene_.drawing(base, light), mask);
  });
}

void PanelPictures::writeAnswer(std::size_t view, std::size_t light, const std::string& name,
                                const Answer& answer) {
  struct Picture {
    const char* kind;
    std::string path;
    std::function<std::string()> make;
    ContentKey key = {};
    std::optional<std::string> bytes = {};
  };
  const Mask* mask = nullptr;
  std::vector<std::uint8_t> rgb;
  std::vector<Picture> pictures = {
      {"shaded", path("images", view, light, name),
       [&] { return writer_.shaded(mask->width, mask->height, rgb); }},
      {"mask", path("masks", view, light, name), [&] { return writer_.mask(*mask); }}};
  if (answer.truth != nullptr) {
    pictures.push_back({"difference", path("images", view, light, name + "_difference"),
                        [&] { return writer_.difference(*mask, *answer.truth); }});
  }
  std::vector<Picture*> missing;
  for (Picture& picture : pictures) {
    picture.key = KeyBuilder(picture.kind).add("answer", answer.key).key();
    picture.bytes = scene_.cache.find<std::string>(picture.key);
    if (!picture.bytes) missing.push_back(&picture);
  }
  if (!missing.empty()) {
    mask = &answer.mask();
    rgb = shade(view, light, answer.base, *mask);
  }
  scene_.clock.measure("writing", [&](const Progress&) {
    parallelFor(0, missing.size(), [&](std::size_t i) {
      missing[i]->bytes = missing[i]->make();
      scene_.cache.keep(missing[i]->key, *missing[i]->bytes);
    });
    for (const Picture& picture : pictures) writer_.write(picture.path, *picture.bytes);
  });
}

PanelRecord PanelPictures::draw(std::size_t view, std::size_t light,
                                std::span<const PanelAnswer> answers) {
  using Kind = PictureRecord::Kind;
  const StudySpec& study = scene_.study;
  const BaseCase& standard = scene_.standardBase();
  PanelRecord panel;
  panel.view = study.views[view].name;
  panel.light = study.lights[light].name;
  panel.width = standard.views[view].view.width;
  panel.height = standard.views[view].view.height;
  for (const PanelAnswer& answer : answers) {
    const std::string& label = study.methods[answer.place].label;
    const std::string& name = methodFiles_[answer.place];
    const BaseCase& base = *answer.method->base;
    writeAnswer(view, light, name,
                {answerKey(scene_, *answer.method, view, light), base,
                 &base.views[view].truths[light].mask, answer.mask});
    panel.pictures.push_back({Kind::shaded, label, label, path("images", view, light, name),
                              path("masks", view, light, name)});
  }
  if (std::holds_alternative<Camera>(study.views[view].kind)) {
    panel.pictures.push_back({Kind::displaced, "truth", "displaced mesh, ray-traced",
                              path("images", view, light, "displaced")});
  }
  writeAnswer(view, light, "truth",
              {scene_.keys.truth(standard.choice, view, light), standard, nullptr,
               [&]() -> const Mask& { return standard.views[view].truths[light].mask; }});
  panel.pictures.push_back({Kind::shaded, "truth", "truth", path("images", view, light, "truth"),
                            path("masks", view, light, "truth")});
  for (const PanelAnswer& answer : answers) {
    const std::string& label = study.methods[answer.place].label;
    panel.pictures.push_back(
        {Kind::difference, label, label,
         path("images", view, light, methodFiles_[answer.place] + "_difference")});
  }
  return panel;
}

}  // namespace gnomon
