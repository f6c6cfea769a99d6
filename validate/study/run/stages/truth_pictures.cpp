#include "study/run/stages/truth_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "study/run/scene/cached_fields.h"
#include "study/run/stages/panel_pictures.h"
#include "truth/displaced_picture.h"

namespace gnomon::study {

namespace {

/// What tells the truth at the samples of a mesh, as files.
struct TruthBytes {
  std::string mask, regions, seam;
};

template <typename Stream, cache::SameAs<TruthBytes> T>
void fields(Stream& stream, T& bytes) {
  stream(bytes.mask, bytes.regions, bytes.seam);
}

/// Where a sample's path to the light crosses a seam: lit.
Mask seamMask(const truth::Truth& truth) {
  Mask mask = truth.mask;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask.samples[i] == Shade::none) continue;
    mask.samples[i] = truth.crossesSeam[i] != 0 ? Shade::lit : Shade::shadowed;
  }
  return mask;
}

}  // namespace

std::string TruthPictures::nameOf(const BaseCase& base, std::size_t view, std::size_t light) const {
  const BaseCase& standard = output_.scene.standardBase();
  if (&base == &standard) return "truth";
  const truth::Truth& own = base.views[view].truths[light];
  const truth::Truth& other = standard.views[view].truths[light];
  const bool looksSame = isSame(own.mask, other.mask) && own.regions == other.regions &&
                         own.crossesSeam == other.crossesSeam &&
                         isSame(own.visibility, other.visibility);
  if (looksSame) return "truth";
  const char* kind = base.choice.kind == render::DrawnMesh::displaced ? "displaced" : "base";
  return fmt::format("truth_{}-{}", kind, base.choice.base.subdivisions);
}

TruthFilesRecord TruthPictures::queue(std::size_t view, std::size_t light, const BaseCase& base) {
  RunScene& scene = output_.scene;
  const truth::Truth& truth = base.views[view].truths[light];
  const bool crosses =
      std::find(truth.crossesSeam.begin(), truth.crossesSeam.end(), 1) != truth.crossesSeam.end();
  const std::string name = nameOf(base, view, light);
  const bool hasMask = name != "truth";
  const cache::ContentKey key = cache::KeyBuilder("truth files")
                                    .add("truth", scene.keys.truth(base.choice, view, light))
                                    .add("mask", hasMask)
                                    .key();
  TruthFilesRecord paths{
      output_.path("masks", view, light, name), output_.path("regions", view, light, name),
      crosses ? output_.path("regions", view, light, name + "_seam") : "", writeWeights(view)};
  const auto write = [this, paths, hasMask, crosses](const TruthBytes& bytes) {
    if (hasMask) output_.writer.write(paths.mask, bytes.mask);
    output_.writer.write(paths.regions, bytes.regions);
    if (crosses) output_.writer.write(paths.seam, bytes.seam);
  };
  if (auto found = scene.cache.find<TruthBytes>(key)) {
    output_.queue.add({}, [write, bytes = std::move(*found)] { write(bytes); });
    return paths;
  }
  const auto made = std::make_shared<TruthBytes>();
  std::vector<EncodingQueue::Work> encodings = {
      [this, made, &truth] { made->regions = output_.writer.regions(truth); }};
  if (hasMask) {
    encodings.emplace_back(
        [this, made, &truth] { made->mask = maskFile(output_.writer, shownOf(truth)); });
  }
  if (crosses) {
    encodings.emplace_back(
        [this, made, &truth] { made->seam = output_.writer.mask(seamMask(truth)); });
  }
  output_.queue.add(std::move(encodings), [&scene, key, made, write] {
    scene.cache.keep(key, *made);
    write(*made);
  });
  return paths;
}

std::string TruthPictures::writeWeights(std::size_t view) {
  const BaseCase& standard = output_.scene.standardBase();
  const ViewCase& atlas = standard.views[view];
  if (atlas.weights.empty()) return "";
  std::string file = fmt::format("regions/{}_weights.exr", output_.names.views[view]);
  if (!viewsWithWeights_.insert(view).second) return file;
  const cache::ContentKey key =
      cache::KeyBuilder("weights")
          .add("samples", output_.scene.keys.samples(standard.choice, view))
          .key();
  const std::string bytes = output_.scene.cache.remember(key, [&] {
    return output_.scene.clock.measure("writing", [&](const Progress&) {
      return output_.writer.weights(atlas.samples.width, atlas.samples.height, atlas.weights);
    });
  });
  output_.writer.write(file, bytes);
  return file;
}

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
    const auto seen = scene.cache.share(
        scene.keys.seenSurface(view),
        [&] { return truth::seenSurface(traced.mesh, traced.scene, camera, progress); },
        [](const truth::SeenSurface& surface) {
          return sizeof(truth::SeenSurface::Point) * surface.points.size();
        });
    return truth::displacedPicture(*seen, traced.scene, scene.study.lights[light].direction,
                                   progress);
  });
}

namespace {

/// A square of a picture as a page embeds it.
std::string embeddedSquare(const compare::Window& window, int width, const SampleColour& colour,
                           const RunWriter& writer) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * static_cast<std::size_t>(window.side) * static_cast<std::size_t>(window.side));
  for (int y = window.top; y < window.top + window.side; ++y) {
    for (int x = window.left; x < window.left + window.side; ++x) {
      const auto found = colour(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x));
      rgb.insert(rgb.end(), found.begin(), found.end());
    }
  }
  return writer.embedded(window.side, window.side, std::move(rgb), EmbeddedSize::full);
}

}  // namespace

std::vector<std::uint8_t> sampleErrors(const Mask& answer, const Mask& truth) {
  std::vector<std::uint8_t> errors(answer.size());
  std::transform(answer.samples.begin(), answer.samples.end(), truth.samples.begin(),
                 errors.begin(), [](Shade ours, Shade theirs) {
                   const bool bothThere = (ours != Shade::none) & (theirs != Shade::none);
                   return static_cast<std::uint8_t>((ours != theirs) & bothThere);
                 });
  return errors;
}

std::vector<float> sampleErrors(const Visibility& answer, const Visibility& truth) {
  std::vector<float> errors(answer.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const float error = std::abs(answer.shares[i] - truth.shares.at(i));
    errors[i] = std::isnan(error) ? 0 : error;
  }
  return errors;
}

std::vector<WorstPlace> worstPlaces(std::span<const compare::Window> squares, int width,
                                    const SampleColour& own, const SampleColour& right,
                                    const RunWriter& writer) {
  std::vector<WorstPlace> places;
  for (const compare::Window& window : squares) {
    places.push_back({window.left, window.top, window.side, window.error,
                      embeddedSquare(window, width, own, writer),
                      embeddedSquare(window, width, right, writer)});
  }
  return places;
}

}  // namespace gnomon::study
