#include "report/picture_layers.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>

#include "common/error.h"
#include "common/parallel.h"

namespace gnomon {
namespace {

constexpr std::uint8_t litKnown = 1;
constexpr std::uint8_t darkKnown = 2;
constexpr std::uint8_t noSample = 4;

std::uint8_t bitsOf(Shade shade) {
  if (shade == Shade::none) return litKnown | darkKnown | noSample;
  return shade == Shade::lit ? litKnown : darkKnown;
}

bool sameColour(const Image& a, const Image& b, std::size_t pixel) {
  const std::uint8_t* one = &a.rgb[3 * pixel];
  const std::uint8_t* other = &b.rgb[3 * pixel];
  return one[0] == other[0] && one[1] == other[1] && one[2] == other[2];
}

void copyColour(const Image& from, std::size_t source, Image& to, std::size_t target) {
  const std::uint8_t* colour = &from.rgb[3 * source];
  std::uint8_t* copy = &to.rgb[3 * target];
  copy[0] = colour[0];
  copy[1] = colour[1];
  copy[2] = colour[2];
}

/// Calls `body(first, end)` for strips of the pixels, on all threads.
template <typename Body>
void forStrips(std::size_t pixels, const Body& body) {
  constexpr std::size_t strip = 1 << 15;
  parallelFor(0, (pixels + strip - 1) / strip,
              [&](std::size_t i) { body(i * strip, std::min((i + 1) * strip, pixels)); });
}

bool agrees(const PictureLayers& layers, const std::vector<std::uint8_t>& known,
            const Image& shaded, const Mask& mask) {
  if (layers.lit.width != shaded.width || layers.lit.height != shaded.height) return false;
  std::atomic<bool> isAgreed = true;
  forStrips(mask.size(), [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const std::uint8_t bits = bitsOf(mask.samples[i]);
      const bool differs =
          (bits & noSample) != (known[i] & noSample) ||
          ((bits & known[i] & litKnown) != 0 && !sameColour(layers.lit, shaded, i)) ||
          ((bits & known[i] & darkKnown) != 0 && !sameColour(layers.dark, shaded, i));
      if (!differs) continue;
      isAgreed = false;
      return;
    }
  });
  return isAgreed;
}

void fillUnknown(Image& layer, const std::vector<std::uint8_t>& known, std::uint8_t bit) {
  for (std::size_t i = 1; i < known.size(); ++i) {
    if ((known[i] & bit) == 0) copyColour(layer, i - 1, layer, i);
  }
}

}  // namespace

std::size_t LayerBuilder::add(const Image& shaded, const Mask& mask) {
  if (shaded.width != mask.width || shaded.height != mask.height ||
      shaded.rgb.size() != 3 * mask.size()) {
    throw InternalError(fmt::format("picture: {} x {} pixels, but its mask has {} x {}",
                                    shaded.width, shaded.height, mask.width, mask.height));
  }
  auto mesh = std::find_if(meshes_.begin(), meshes_.end(), [&](const Mesh& candidate) {
    return agrees(candidate.layers, candidate.known, shaded, mask);
  });
  if (mesh == meshes_.end()) {
    const Image empty{shaded.width, shaded.height, std::vector<std::uint8_t>(shaded.rgb.size())};
    std::vector<std::uint8_t> known(mask.size());
    std::transform(mask.samples.begin(), mask.samples.end(), known.begin(),
                   [](Shade shade) { return static_cast<std::uint8_t>(bitsOf(shade) & noSample); });
    mesh = meshes_.insert(meshes_.end(), Mesh{{empty, empty}, std::move(known)});
  }
  forStrips(mask.size(), [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      // What is known it agrees with; where there is no sample, only the first picture is known.
      const int bits = bitsOf(mask.samples[i]) & ~mesh->known[i];
      if ((bits & litKnown) != 0) copyColour(shaded, i, mesh->layers.lit, i);
      if ((bits & darkKnown) != 0) copyColour(shaded, i, mesh->layers.dark, i);
      mesh->known[i] = static_cast<std::uint8_t>(mesh->known[i] | bits);
    }
  });
  return static_cast<std::size_t>(mesh - meshes_.begin());
}

std::vector<PictureLayers> LayerBuilder::layers() const {
  std::vector<PictureLayers> all;
  for (const Mesh& mesh : meshes_) all.push_back(mesh.layers);
  parallelFor(0, 2 * all.size(), [&](std::size_t i) {
    PictureLayers& layers = all[i / 2];
    const bool isLit = i % 2 == 0;
    fillUnknown(isLit ? layers.lit : layers.dark, meshes_[i / 2].known,
                isLit ? litKnown : darkKnown);
  });
  return all;
}

Image composed(const PictureLayers& layers, const Mask& mask) {
  Image image = layers.lit;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask.samples[i] == Shade::shadowed) copyColour(layers.dark, i, image, i);
  }
  return image;
}

}  // namespace gnomon
