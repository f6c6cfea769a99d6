#include "report/picture_layers.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"

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
  return std::equal(a.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel),
                    a.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel + 3),
                    b.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
}

void copyColour(const Image& from, std::size_t source, Image& to, std::size_t target) {
  std::copy_n(from.rgb.begin() + static_cast<std::ptrdiff_t>(3 * source), 3,
              to.rgb.begin() + static_cast<std::ptrdiff_t>(3 * target));
}

bool agrees(const PictureLayers& layers, const std::vector<std::uint8_t>& known,
            const Image& shaded, const Mask& mask) {
  if (layers.lit.width != shaded.width || layers.lit.height != shaded.height) return false;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const std::uint8_t bits = bitsOf(mask.samples[i]);
    if ((bits & noSample) != (known[i] & noSample)) return false;
    if ((bits & known[i] & litKnown) != 0 && !sameColour(layers.lit, shaded, i)) return false;
    if ((bits & known[i] & darkKnown) != 0 && !sameColour(layers.dark, shaded, i)) return false;
  }
  return true;
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
    for (std::size_t i = 0; i < mask.size(); ++i) known[i] = bitsOf(mask.samples[i]) & noSample;
    mesh = meshes_.insert(meshes_.end(), Mesh{{empty, empty}, std::move(known)});
  }
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const std::uint8_t bits = bitsOf(mask.samples[i]);
    if ((bits & litKnown) != 0) copyColour(shaded, i, mesh->layers.lit, i);
    if ((bits & darkKnown) != 0) copyColour(shaded, i, mesh->layers.dark, i);
    mesh->known[i] |= bits;
  }
  return static_cast<std::size_t>(mesh - meshes_.begin());
}

std::vector<PictureLayers> LayerBuilder::layers() const {
  std::vector<PictureLayers> all;
  for (const Mesh& mesh : meshes_) {
    PictureLayers layers = mesh.layers;
    fillUnknown(layers.lit, mesh.known, litKnown);
    fillUnknown(layers.dark, mesh.known, darkKnown);
    all.push_back(std::move(layers));
  }
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
