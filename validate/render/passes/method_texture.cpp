#include "render/passes/method_texture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <system_error>

#include "common/error.h"
#include "horizon/stored_table.h"
#include "image/grey_picture.h"
#include "render/declaration.h"
#include "render/gl_context.h"
#include "render/shader_files.h"

namespace gnomon::render {

namespace fs = std::filesystem;
namespace {

constexpr std::size_t mostTextures = 8;

MethodTexture readTexture(const Declaration& declaration, const std::string& name,
                          const toml::node& node, const fs::path& folder) {
  requireOwnName(declaration, node, "texture", name);
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    declaration.fail(node, fmt::format("texture `{}`: a table expected", name));
  }
  declaration.allowOnly(*table, {"file", "filter", "about"});
  const toml::node* file = table->get("file");
  if (file == nullptr) declaration.fail(node, "`file` is missing, a string expected");
  const fs::path named = declaration.textOf(*file, "file");
  const fs::path inside = named.lexically_normal();
  if (named.is_absolute() || inside.empty() || *inside.begin() == "..") {
    declaration.fail(*file, fmt::format("`file`: {}: a file in the folder of the method expected",
                                        named.string()));
  }
  MethodTexture texture{name, folder / inside};
  std::error_code failure;
  if (!fs::is_regular_file(texture.file, failure)) {
    declaration.fail(*file, fmt::format("`file`: no file {}", texture.file.string()));
  }
  texture.isFiltered = declaration.isLinear(*table, "filter");
  texture.about = declaration.about(*table);
  return texture;
}

/// The bits that hold the numbers of a picture.
horizon::TableBits bitsOf(const image::ImageFacts& facts) {
  horizon::TableBits bits = horizon::TableBits::eight;
  for (const std::string& number : facts.channelNumbers) {
    const bool isSmall = number == "uint8";
    const bool isWhole = isSmall || number == "uint16";
    bits = std::max(bits, isSmall   ? horizon::TableBits::eight
                          : isWhole ? horizon::TableBits::sixteen
                                    : horizon::TableBits::thirtyTwo);
  }
  return bits;
}

/// Refuses a pixel of row y that holds no finite number, or the file's "no data".
void requireNumbers(const image::ImageFile& image, const image::ImageFacts& facts,
                    std::span<const float> row, int y) {
  const auto channels = static_cast<std::size_t>(facts.channelCount());
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto x = static_cast<int>(i / channels);
    if (image::holdsNoData(facts, static_cast<int>(i % channels), row[i])) {
      image.refuse(image::noDataSentence(facts, x, y));
    }
    if (std::isfinite(row[i])) continue;
    image.refuse(fmt::format("pixel ({}, {}) holds {}, a finite number expected", x, y, row[i]));
  }
}

}  // namespace

std::vector<MethodTexture> readTextures(const Declaration& declaration, const fs::path& folder) {
  const toml::node* found = declaration.table().get("textures");
  if (found == nullptr) return {};
  const toml::table* tables = found->as_table();
  if (tables == nullptr) declaration.fail(*found, "`textures`: a table expected");
  if (tables->size() > mostTextures) {
    declaration.fail(*found, fmt::format("{} textures found, at most {} expected", tables->size(),
                                         mostTextures));
  }
  std::vector<MethodTexture> textures;
  for (const auto& [name, node] : *tables) {
    textures.push_back(readTexture(declaration, std::string(name.str()), node, folder));
  }
  return textures;
}

std::string textureAccess(const std::vector<MethodTexture>& textures) {
  std::string text;
  for (const MethodTexture& texture : textures) {
    const std::string sampler = texture.sampler();
    text += fmt::format(
        "uniform sampler2D {0};\n"
        "vec4 {1}Texel(ivec2 at) {{ return pictureTexel({0}, at); }}\n"
        "vec4 {1}At(vec2 at) {{ return {2}({0}, at); }}\n",
        sampler, texture.name, texture.isFiltered ? "pictureAt" : "pictureNear");
  }
  return text;
}

GpuTexture::GpuTexture(const MethodTexture& texture) {
  image::ImageFile image(texture.file);
  const image::ImageFacts facts = image.facts();
  const int channels = facts.channelCount();
  const int width = facts.display.width;
  const int height = facts.display.height;
  const int largest = gl::limit(GL_MAX_TEXTURE_SIZE);
  if (channels < 1 || channels > 4) {
    image.refuse(fmt::format("{} channels found, 1 to 4 expected", channels));
  }
  if (width > largest || height > largest) {
    image.refuse(fmt::format("{} × {} pixels found, OpenGL takes at most {} a side", width, height,
                             largest));
  }
  image::requireMeaning(image, image::PictureUse::method, 3.0 * sizeof(float) * channels);
  const std::size_t row = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  const horizon::TableBits bits = bitsOf(facts);
  horizon::StoredTable stored =
      horizon::emptyTable(row * static_cast<std::size_t>(height), bits, 0, 1);
  image.readPlaced(0, channels, [&](const float* values, int, int y, int) {
    const std::span<const float> line(values, row);
    requireNumbers(image, facts, line, y);
    stored.set(row * static_cast<std::size_t>(height - 1 - y), line);
  });
  const PixelFormat format = pixelFormat(bits);
  const auto channel = static_cast<std::size_t>(channels - 1);
  const gl::TextureSize size{width, height};
  texture_ = gl::makeTexture(GL_TEXTURE_2D, format.sized.at(channel), size,
                             texture.isFiltered ? GL_LINEAR : GL_NEAREST);
  gl::fill(texture_, size, channelFormats.at(channel), format.type, stored.bytes.data());
  setWrap(texture_.name(), relief::Wrap::repeat);
  byteCount_ = stored.bytes.size();
  throwOnGlError("taking a method's texture");
}

}  // namespace gnomon::render
