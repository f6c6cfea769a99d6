#include "study/panel_pictures.h"

#include <fmt/core.h>

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

Drawing drawingOf(const StudySpec& study, const GpuHeights& heights, const BaseCase& base,
                  std::size_t light) {
  return {base.gpu,
          heights,
          study.relief.field.wrap(),
          study.relief.space,
          study.lights[light].direction(),
          base.volumes ? &*base.volumes : nullptr,
          &base.texture};
}

PanelPictures::PanelPictures(const StudySpec& study, const GpuHeights& heights,
                             const std::filesystem::path& shaders, RunWriter& writer,
                             StageClock& clock)
    : study_(study),
      heights_(heights),
      shade_(shaders, study.relief.field.wrap()),
      writer_(writer),
      clock_(clock),
      viewFiles_(fileNames(namesOf(study.views, [](const ViewSpec& view) { return view.name; }))),
      lightFiles_(
          fileNames(namesOf(study.lights, [](const LightSpec& light) { return light.name; }))),
      methodFiles_(
          fileNames(namesOf(study.methods, [](const MethodSpec& method) { return method.label; }),
                    {"truth", "displaced"})) {}

std::string PanelPictures::path(const char* folder, std::size_t view, std::size_t light,
                                const std::string& name) const {
  return fmt::format("{}/{}_{}_{}.png", folder, viewFiles_[view], lightFiles_[light], name);
}

void PanelPictures::drawDisplaced(const MicroMesh& mesh, const MicroScene& scene) {
  for (std::size_t v = 0; v < study_.views.size(); ++v) {
    const auto* camera = std::get_if<Camera>(&study_.views[v].kind);
    if (camera == nullptr) continue;
    for (std::size_t l = 0; l < study_.lights.size(); ++l) {
      const auto picture = clock_.measure("displaced picture", [&](const Progress& progress) {
        return displacedPicture(mesh, scene, *camera, study_.lights[l].direction(), progress);
      });
      clock_.measure("writing", [&](const Progress&) {
        writer_.displaced(path("images", v, l, "displaced"), camera->width, camera->height,
                          picture);
      });
    }
  }
}

void PanelPictures::shadeMask(std::size_t view, std::size_t light, const BaseCase& base,
                              const Mask& mask, const std::string& name) {
  const auto rgb = clock_.measure("pictures", [&](const Progress&) {
    return shade_.render(base.views[view].view, drawingOf(study_, heights_, base, light), mask);
  });
  clock_.measure("writing", [&](const Progress&) {
    writer_.shaded(path("images", view, light, name), mask.width, mask.height, rgb);
    writer_.mask(path("masks", view, light, name), mask);
  });
}

PanelRecord PanelPictures::draw(std::size_t view, std::size_t light, const BaseCase& standard,
                                std::span<const PanelMask> masks) {
  using Kind = PictureRecord::Kind;
  PanelRecord panel;
  panel.view = study_.views[view].name;
  panel.light = study_.lights[light].name;
  panel.width = standard.views[view].view.width;
  panel.height = standard.views[view].view.height;
  for (std::size_t m = 0; m < masks.size(); ++m) {
    if (masks[m].mask == nullptr) continue;
    const std::string& label = study_.methods[m].label;
    shadeMask(view, light, *masks[m].base, *masks[m].mask, methodFiles_[m]);
    panel.pictures.push_back({Kind::shaded, label, label,
                              path("images", view, light, methodFiles_[m]),
                              path("masks", view, light, methodFiles_[m])});
  }
  if (std::holds_alternative<Camera>(study_.views[view].kind)) {
    panel.pictures.push_back({Kind::displaced, "truth", "displaced mesh, ray-traced",
                              path("images", view, light, "displaced")});
  }
  shadeMask(view, light, standard, standard.views[view].truths[light].mask, "truth");
  panel.pictures.push_back({Kind::shaded, "truth", "truth", path("images", view, light, "truth"),
                            path("masks", view, light, "truth")});
  for (std::size_t m = 0; m < masks.size(); ++m) {
    if (masks[m].mask == nullptr) continue;
    const std::string file = path("images", view, light, methodFiles_[m] + "_difference");
    clock_.measure("writing", [&](const Progress&) {
      writer_.difference(file, *masks[m].mask, masks[m].base->views[view].truths[light].mask);
    });
    const std::string& label = study_.methods[m].label;
    panel.pictures.push_back({Kind::difference, label, label, file});
  }
  return panel;
}

}  // namespace gnomon
