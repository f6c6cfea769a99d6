#include "study/run/stages/displaced_pictures.h"

#include <memory>

#include "study/run/scene/cached_fields.h"
#include "study/run/stages/shown_answer.h"
#include "truth/displaced_picture.h"

namespace gnomon::study {
namespace {

/// A picture as a file and as a page embeds it.
struct PictureBytes {
  std::string file;
  std::string embedded;
};

template <typename Stream, cache::SameAs<PictureBytes> T>
void fields(Stream& stream, T& bytes) {
  stream(bytes.file, bytes.embedded);
}

}  // namespace

void DisplacedPictures::queue(SurfaceOnDemand& surface) {
  const StudySpec& study = output_.scene.study;
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    const Camera* camera = cameraOf(study.views[v]);
    for (std::size_t l = 0; camera != nullptr && l < study.lights.size(); ++l) {
      queue(v, l, *camera, surface);
    }
  }
}

void DisplacedPictures::queue(std::size_t view, std::size_t light, const Camera& camera,
                              SurfaceOnDemand& surface) {
  RunScene& scene = output_.scene;
  const cache::ContentKey key = scene.keys.displacedPicture(view, light);
  const auto bytes = std::make_shared<PictureBytes>();
  const auto use = [this, bytes, view, light] {
    output_.writer.write(output_.path("images", view, light, "displaced"), bytes->file);
    embedded_[{view, light}] = std::move(bytes->embedded);
  };
  if (auto found = scene.cache.find<PictureBytes>(key)) {
    *bytes = std::move(*found);
    output_.queue.add({}, use, bytes->file.size() + bytes->embedded.size());
    return;
  }
  const std::vector<float> traced = trace(view, light, camera, surface.get());
  const auto rgb = scene.clock.measure("writing", [&](const Progress&) {
    return std::make_shared<const RgbPixels>(
        output_.writer.displaced(camera.width, camera.height, traced));
  });
  const RunWriter& writer = output_.writer;
  output_.queue.add(
      {[&writer, &camera, rgb, bytes] {
         bytes->embedded = writer.embedded(camera.width, camera.height, *rgb, EmbeddedSize::full);
       },
       [&writer, &camera, rgb, bytes] {
         bytes->file = writer.picture(camera.width, camera.height, *rgb);
       }},
      [&scene, key, bytes, use] {
        scene.cache.keep(key, *bytes);
        use();
      },
      rgb->size());
}

const std::string* DisplacedPictures::embedded(std::size_t view, std::size_t light) const {
  const auto found = embedded_.find({view, light});
  return found == embedded_.end() ? nullptr : &found->second;
}

std::vector<float> DisplacedPictures::trace(std::size_t view, std::size_t light,
                                            const Camera& camera, const TracedSurface& traced) {
  RunScene& scene = output_.scene;
  return scene.clock.measure("displaced picture", [&](const Progress& progress) {
    const auto bytes = [](const truth::SeenSurface& seen) {
      return sizeof(truth::SeenSurface::Point) * seen.points.size();
    };
    const auto seen = scene.store.get<truth::SeenSurface>(
        scene.keys.seenSurface(view),
        [&] {
          return std::make_shared<const truth::SeenSurface>(
              truth::seenSurface(traced.mesh, traced.scene, camera, progress));
        },
        bytes);
    return truth::displacedPicture(*seen, traced.scene, scene.study.lights[light].direction,
                                   progress);
  });
}

}  // namespace gnomon::study
