#include "render/bakes/gpu_bake.h"

#include <algorithm>
#include <cmath>

#include "render/gl_context.h"
#include "render/gl_objects.h"
#include "render/pixel_format.h"

namespace gnomon::render {
namespace {

/// The texels of a finer level below one of a coarser level, along one axis, each with its share.
struct Below {
  int first = 0;
  std::vector<double> shares;  ///< their sum is 1
};

Below below(int texel, int coarse, int fine) {
  const double width = static_cast<double>(fine) / coarse;
  const double begin = texel * width;
  const double end = begin + width;
  Below found;
  found.first = static_cast<int>(begin);
  const int last = std::min(static_cast<int>(std::ceil(end)), fine);
  for (int i = found.first; i < last; ++i) {
    found.shares.push_back((std::min<double>(end, i + 1) - std::max<double>(begin, i)) / width);
  }
  return found;
}

}  // namespace

std::size_t StoredBake::entriesOf(int level) const {
  const glm::ivec2 size = sizeOf(level);
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
         static_cast<std::size_t>(layers) * static_cast<std::size_t>(channels);
}

std::size_t StoredBake::entry(int level) const {
  std::size_t entries = 0;
  for (int finer = 0; finer < level; ++finer) entries += entriesOf(finer);
  return entries;
}

namespace {

StoredBake shapeOf(const MethodBake& bake, glm::ivec2 map) {
  const glm::ivec2 size = bake.sizeOver(map);
  return {size.x, size.y, bake.layers, bake.channels, bake.levelsOf(size), {}};
}

}  // namespace

std::uint64_t bytesOver(const MethodBake& bake, glm::ivec2 map) {
  const StoredBake shape = shapeOf(bake, map);
  return shape.entry(shape.levels) * static_cast<std::uint64_t>(bake.bits) / 8;
}

StoredBake emptyBake(const MethodBake& bake, glm::ivec2 map) {
  StoredBake stored = shapeOf(bake, map);
  stored.values = horizon::emptyTable(stored.entry(stored.levels), bake.bits, 0, 1);
  return stored;
}

std::vector<float> coarser(std::span<const float> values, glm::ivec2 size,
                           const std::vector<MipRule>& rules) {
  const glm::ivec2 half = glm::max(size / 2, glm::ivec2(1));
  const std::size_t channels = rules.size();
  std::vector<float> coarse;
  coarse.reserve(static_cast<std::size_t>(half.x) * static_cast<std::size_t>(half.y) * channels);
  for (int y = 0; y < half.y; ++y) {
    const Below rows = below(y, half.y, size.y);
    for (int x = 0; x < half.x; ++x) {
      const Below columns = below(x, half.x, size.x);
      for (std::size_t c = 0; c < channels; ++c) {
        double sum = 0;
        double lowest = INFINITY;
        double highest = -INFINITY;
        for (std::size_t j = 0; j < rows.shares.size(); ++j) {
          for (std::size_t i = 0; i < columns.shares.size(); ++i) {
            const auto texel =
                (static_cast<std::size_t>(rows.first) + j) * static_cast<std::size_t>(size.x) +
                static_cast<std::size_t>(columns.first) + i;
            const double value = static_cast<double>(values[texel * channels + c]);
            sum += rows.shares[j] * columns.shares[i] * value;
            lowest = std::min(lowest, value);
            highest = std::max(highest, value);
          }
        }
        const MipRule rule = rules[c];
        coarse.push_back(static_cast<float>(
            rule == MipRule::average ? sum : (rule == MipRule::minimum ? lowest : highest)));
      }
    }
  }
  return coarse;
}

GpuBake::GpuBake(const StoredBake& bake, relief::Wrap wrap, relief::Border border, bool isFiltered)
    : byteCount_(bake.values.bytes.size()) {
  const PixelFormat format = pixelFormat(bake.values.bits);
  const auto channel = static_cast<std::size_t>(bake.channels - 1);
  const std::size_t valueBytes = static_cast<std::size_t>(bake.values.bits) / 8;
  const gl::TextureSize size{bake.width, bake.height, bake.layers, bake.levels};
  texture_ = gl::makeTexture(GL_TEXTURE_2D_ARRAY, format.sized.at(channel), size,
                             isFiltered ? GL_LINEAR : GL_NEAREST);
  if (isFiltered && bake.levels > 1) {
    glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  } else if (bake.levels > 1) {
    glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  }
  for (int level = 0; level < bake.levels; ++level) {
    const glm::ivec2 side = bake.sizeOf(level);
    gl::fill(texture_, {side.x, side.y, bake.layers}, channelFormats.at(channel), format.type,
             bake.values.bytes.data() + valueBytes * bake.entry(level), level);
  }
  setWrap(texture_.name(), wrap, border);
  throwOnGlError("taking a method's bake");
}

}  // namespace gnomon::render
