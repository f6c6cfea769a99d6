#include "render/bakes/method_bake.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "render/declaration.h"
#include "render/gl_context.h"

namespace gnomon::render {

namespace {

using horizon::TableBits;

constexpr int mostBakes = 8;

TableBits readBits(const Declaration& declaration, const toml::table& table) {
  const toml::node* found = table.get("bits");
  if (found == nullptr) return TableBits::eight;
  for (const TableBits bits : {TableBits::eight, TableBits::sixteen, TableBits::thirtyTwo}) {
    if (found->value_exact<std::int64_t>() == static_cast<int>(bits)) return bits;
  }
  declaration.fail(*found, "`bits`: 8, 16 or 32 expected");
}

/// A list of numbers from low to high.
glm::vec2 readRange(const Declaration& declaration, const toml::node& node) {
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) {
    declaration.fail(node, "`range`: [low, high] expected, or one such pair a channel");
  }
  const double low = declaration.numberOf(*pair->get(0), "range");
  const double high = declaration.numberOf(*pair->get(1), "range");
  if (!(low < high)) declaration.fail(node, "`range`: a low end below the high end expected");
  return {low, high};
}

std::vector<glm::vec2> readRanges(const Declaration& declaration, const toml::table& table,
                                  const MethodBake& bake) {
  const auto channels = static_cast<std::size_t>(bake.channels);
  const toml::node* found = table.get("range");
  if (bake.bits == TableBits::thirtyTwo) {
    if (found != nullptr) declaration.fail(*found, "`range` needs bits = 8 or 16");
    return {};
  }
  if (found == nullptr) return std::vector<glm::vec2>(channels, {0, 1});
  const toml::array* list = found->as_array();
  const bool isList = list != nullptr && !list->empty() && list->get(0)->is_array();
  if (!isList) return std::vector<glm::vec2>(channels, readRange(declaration, *found));
  std::vector<glm::vec2> ranges;
  for (const toml::node& node : *list) ranges.push_back(readRange(declaration, node));
  if (ranges.size() != channels) {
    declaration.fail(*found, fmt::format("`range`: {} pairs found, one for each of {} channels "
                                         "expected",
                                         ranges.size(), channels));
  }
  return ranges;
}

MipRule readRule(const Declaration& declaration, const toml::node& node) {
  const auto name = node.value_exact<std::string>().value_or("");
  if (name == "average") return MipRule::average;
  if (name == "minimum") return MipRule::minimum;
  if (name == "maximum") return MipRule::maximum;
  declaration.fail(node, "`mips`: average, minimum or maximum expected, or one of them a channel");
}

std::vector<MipRule> readMips(const Declaration& declaration, const toml::table& table,
                              std::size_t channels) {
  const toml::node* found = table.get("mips");
  if (found == nullptr) return {};
  const toml::array* list = found->as_array();
  if (list == nullptr) return std::vector<MipRule>(channels, readRule(declaration, *found));
  std::vector<MipRule> rules;
  for (const toml::node& node : *list) rules.push_back(readRule(declaration, node));
  if (rules.size() != channels) {
    declaration.fail(*found, fmt::format("`mips`: {} found, one for each of {} channels expected",
                                         rules.size(), channels));
  }
  return rules;
}

std::optional<glm::ivec2> readSize(const Declaration& declaration, const toml::table& table) {
  const toml::node* found = table.get("size");
  if (found == nullptr) return std::nullopt;
  const toml::array* pair = found->as_array();
  const auto side = [&](std::size_t axis) {
    constexpr int most = 65536;
    const auto value = pair->get(axis)->value_exact<std::int64_t>();
    if (!value || *value < 1 || *value > most) {
      declaration.fail(*found, fmt::format("`size`: whole numbers from 1 to {} expected", most));
    }
    return static_cast<int>(*value);
  };
  if (pair == nullptr || pair->size() != 2) {
    declaration.fail(*found, "`size`: [width, height] expected");
  }
  return glm::ivec2(side(0), side(1));
}

double readScale(const Declaration& declaration, const toml::table& table) {
  const toml::node* found = table.get("scale");
  if (found == nullptr) return 1;
  if (table.contains("size")) declaration.fail(*found, "`scale` and `size`, one expected");
  const double scale = declaration.numberOf(*found, "scale");
  if (!(scale > 0 && scale <= 64)) {
    declaration.fail(*found, "`scale`: a number above 0 and up to 64 expected");
  }
  return scale;
}

MethodBake readBake(const Declaration& declaration, const std::string& name,
                    const toml::node& node) {
  requireOwnName(declaration, node, "bake", name);
  const toml::table* table = node.as_table();
  if (table == nullptr) declaration.fail(node, fmt::format("bake `{}`: a table expected", name));
  declaration.allowOnly(
      *table, {"channels", "bits", "range", "scale", "size", "layers", "mips", "filter", "about"});
  MethodBake bake;
  bake.name = name;
  bake.channels = declaration.count(*table, "channels", 1, 4).value_or(1);
  bake.bits = readBits(declaration, *table);
  bake.ranges = readRanges(declaration, *table, bake);
  bake.scale = readScale(declaration, *table);
  bake.size = readSize(declaration, *table);
  bake.layers = declaration.count(*table, "layers", 1, 2048).value_or(1);
  bake.mips = readMips(declaration, *table, static_cast<std::size_t>(bake.channels));
  bake.isFiltered = declaration.isLinear(*table, "filter");
  bake.about = declaration.about(*table);
  return bake;
}

/// The type of a bake's values.
std::string typeOf(const MethodBake& bake) {
  return bake.channels == 1 ? "float" : fmt::format("vec{}", bake.channels);
}

std::string_view swizzle(const MethodBake& bake) {
  return std::string_view("rgba").substr(0, static_cast<std::size_t>(bake.channels));
}

/// A number of the declaration, to the last bit of a float.
std::string literal(float value) {
  return fmt::format("{:.9e}", value);
}

/// The values of a channel's lowest code, or of the codes' whole range, as a constant.
std::string constants(const MethodBake& bake, const std::function<float(glm::vec2)>& of) {
  std::string list;
  for (const glm::vec2& range : bake.ranges) {
    list += (list.empty() ? "" : ", ") + literal(of(range));
  }
  return fmt::format("{}({})", typeOf(bake), list);
}

/// What the functions `nameAt` and `nameTexel` return of a stored value.
std::string decoded(const MethodBake& bake, const std::string& stored) {
  std::string value = fmt::format("{}.{}", stored, swizzle(bake));
  if (bake.ranges.empty()) return value;
  const auto low = constants(bake, [](glm::vec2 range) { return range.x; });
  const auto span = constants(bake, [](glm::vec2 range) { return range.y - range.x; });
  return fmt::format("{} + {} * {}", low, span, value);
}

}  // namespace

std::string MethodBake::function() const {
  return "bake" + capitalised(name);
}

glm::ivec2 MethodBake::sizeOver(glm::ivec2 map) const {
  return size.value_or(glm::max(glm::ivec2(glm::round(scale * glm::dvec2(map))), glm::ivec2(1)));
}

int MethodBake::levelsOf(glm::ivec2 of) const {
  int levels = 1;
  for (int side = std::max(of.x, of.y); !mips.empty() && side > 1; side /= 2) ++levels;
  return levels;
}

std::vector<MethodBake> readBakes(const Declaration& declaration) {
  const toml::node* found = declaration.table().get("bakes");
  if (found == nullptr) return {};
  const toml::table* tables = found->as_table();
  if (tables == nullptr) declaration.fail(*found, "`bakes`: a table expected");
  if (tables->size() > mostBakes) {
    declaration.fail(*found,
                     fmt::format("{} bakes found, at most {} expected", tables->size(), mostBakes));
  }
  std::vector<std::pair<std::pair<std::size_t, std::size_t>, MethodBake>> places;
  for (const auto& [name, node] : *tables) {
    places.emplace_back(declaration.placeOf(node),
                        readBake(declaration, std::string(name.str()), node));
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<MethodBake> bakes;
  bakes.reserve(places.size());
  for (auto& [place, bake] : places) bakes.push_back(std::move(bake));
  return bakes;
}

void requireBakeFunctions(const Declaration& declaration, const std::vector<MethodBake>& bakes,
                          const std::vector<ShaderPiece>& code) {
  for (const MethodBake& bake : bakes) {
    if (definesFunction(code, bake.function(), bake.layers > 1 ? "int" : "vec2")) continue;
    declaration.fail(
        *declaration.table()["bakes"][bake.name].node(),
        fmt::format("bake `{}` needs the function `{} {}(vec2 texel{})`", bake.name, typeOf(bake),
                    bake.function(), bake.layers > 1 ? ", int layer" : ""));
  }
}

std::string bakeAccess(const std::vector<MethodBake>& bakes) {
  std::string text;
  for (const MethodBake& bake : bakes) {
    const std::string sampler = bake.sampler();
    const std::string layer = bake.layers > 1 ? ", int layer" : "";
    const std::string chosen = bake.layers > 1 ? "layer" : "0";
    const auto define = [&](const char* ending, const std::string& place, const std::string& level,
                            const std::string& stored) {
      text += fmt::format("{} {}{}({}{}{}) {{ return {}; }}\n", typeOf(bake), bake.name, ending,
                          place, layer, level, decoded(bake, stored));
    };
    text += fmt::format("uniform sampler2DArray {};\n", sampler);
    define("Texel", "ivec2 at", "", fmt::format("bakedTexel({}, at, {}, 0)", sampler, chosen));
    const char* filtered = bake.isFiltered ? "bakedAt" : "bakedNear";
    define("At", "vec2 at", "", fmt::format("{}({}, at, {}, 0)", filtered, sampler, chosen));
    if (bake.mips.empty()) continue;
    define("Texel", "ivec2 at", ", int level",
           fmt::format("bakedTexel({}, at, {}, level)", sampler, chosen));
    define("At", "vec2 at", ", float level",
           fmt::format("{}({}, at, {}, level)", filtered, sampler, chosen));
  }
  return text;
}

std::string bakeMain(const std::vector<MethodBake>& bakes) {
  std::string text = "void main() {\n  vec2 texel = bakeStep * (gl_FragCoord.xy + bakeCorner);\n";
  for (std::size_t i = 0; i < bakes.size(); ++i) {
    text += fmt::format("  if (bakeNumber == {}) stored = widened({}(texel{}));\n", i,
                        bakes[i].function(), bakes[i].layers > 1 ? ", bakeLayer" : "");
  }
  return text + "}\n";
}

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
