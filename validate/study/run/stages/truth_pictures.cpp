#include "study/run/stages/truth_pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "study/run/scene/cached_fields.h"
#include "study/run/stages/shown_answer.h"

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

}  // namespace gnomon::study
