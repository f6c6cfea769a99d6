#include "render/passes/own_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "render/declaration.h"

namespace gnomon::render {
namespace {

constexpr std::size_t mostPasses = 8;

const toml::table& passTable(const Declaration& declaration, std::size_t place) {
  return *declaration.table().get("pass")->as_array()->get(place)->as_table();
}

PassRaster rasterOf(const Declaration& declaration, const toml::table& table) {
  const toml::node* found = table.get("kind");
  if (found == nullptr) declaration.fail(table, "`kind` is missing, a string expected");
  const std::string kind = declaration.textOf(*found, "kind");
  if (kind == "texture") return PassRaster::texture;
  if (kind == "light") return PassRaster::light;
  if (kind == "camera") return PassRaster::camera;
  if (kind == "filter") return PassRaster::filter;
  declaration.fail(*found,
                   fmt::format("kind `{}`, expected texture, light, camera or filter", kind));
}

std::string nameOfPass(const Declaration& declaration, const toml::table& table,
                       const std::vector<OwnPass>& earlier) {
  const toml::node* found = table.get("name");
  if (found == nullptr) declaration.fail(table, "`name` is missing, a string expected");
  std::string name = declaration.textOf(*found, "name");
  requireOwnName(declaration, *found, "pass", name);
  const bool isTaken = std::any_of(earlier.begin(), earlier.end(),
                                   [&](const OwnPass& pass) { return pass.name == name; });
  if (isTaken) declaration.fail(*found, fmt::format("a second pass `{}`", name));
  return name;
}

/// Where a filter takes its texels from.
void readSource(const Declaration& declaration, const toml::table& table,
                const std::vector<OwnPass>& earlier, OwnPass& pass) {
  const toml::node* found = table.get("of");
  if (pass.raster != PassRaster::filter) {
    if (found != nullptr) declaration.fail(*found, "`of` needs kind = \"filter\"");
    pass.root = pass.raster;
    return;
  }
  if (found == nullptr) declaration.fail(table, "`of` is missing, the name of a pass expected");
  const std::string name = declaration.textOf(*found, "of");
  const auto source = std::find_if(earlier.begin(), earlier.end(),
                                   [&](const OwnPass& other) { return other.name == name; });
  if (source == earlier.end()) {
    declaration.fail(*found, fmt::format("`of`: no pass `{}` before this one", name));
  }
  pass.source = static_cast<std::size_t>(source - earlier.begin());
  pass.root = source->root;
}

horizon::TableBits readPassBits(const Declaration& declaration, const toml::table& table) {
  using horizon::TableBits;
  const toml::node* found = table.get("bits");
  if (found == nullptr) return TableBits::thirtyTwo;
  for (const TableBits bits : {TableBits::eight, TableBits::sixteen, TableBits::thirtyTwo}) {
    if (found->value_exact<std::int64_t>() == static_cast<int>(bits)) return bits;
  }
  declaration.fail(*found, "`bits`: 8, 16 or 32 expected");
}

std::array<float, 4> readClear(const Declaration& declaration, const toml::table& table,
                               const OwnPass& pass) {
  std::array<float, 4> clear = {};
  const toml::node* found = table.get("clear");
  if (found == nullptr) return clear;
  if (pass.root == PassRaster::texture || pass.raster == PassRaster::filter) {
    declaration.fail(*found, "`clear` needs kind = \"light\" or \"camera\"");
  }
  const toml::array* list = found->as_array();
  if (list != nullptr && list->size() != static_cast<std::size_t>(pass.channels)) {
    declaration.fail(*found, fmt::format("`clear`: {} numbers found, one for each of {} channels "
                                         "expected",
                                         list->size(), pass.channels));
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(pass.channels); ++c) {
    const toml::node& node = list == nullptr ? *found : *list->get(c);
    clear.at(c) = static_cast<float>(declaration.numberOf(node, "clear"));
  }
  return clear;
}

OwnPass readOwnPass(const Declaration& declaration, const toml::table& table,
                    const std::vector<OwnPass>& earlier) {
  declaration.allowOnly(table,
                        {"name", "kind", "of", "channels", "bits", "mips", "clear", "about"});
  OwnPass pass;
  pass.name = nameOfPass(declaration, table, earlier);
  pass.raster = rasterOf(declaration, table);
  readSource(declaration, table, earlier, pass);
  const int most = pass.isMarked() ? 3 : 4;
  pass.channels = declaration.count(table, "channels", 1, most).value_or(1);
  pass.bits = readPassBits(declaration, table);
  pass.clear = readClear(declaration, table, pass);
  pass.about = declaration.about(table);
  if (const toml::node* mips = table.get("mips")) {
    if (!mips->is_boolean()) declaration.fail(*mips, "`mips`: true or false expected");
    pass.mips = mips->value_or(false);
    if (pass.mips && pass.isMarked()) {
      declaration.fail(*mips, "`mips` needs a pass from the light or a camera, or a filter of one");
    }
  }
  const bool isLate = std::any_of(earlier.begin(), earlier.end(), [](const OwnPass& other) {
    return other.root == PassRaster::camera;
  });
  if (isLate && pass.root != PassRaster::camera) {
    declaration.fail(table, fmt::format("pass `{}` comes after a camera's, before them expected: "
                                        "it is kept while the light stands still",
                                        pass.name));
  }
  return pass;
}

std::string passType(const OwnPass& pass) {
  return pass.channels == 1 ? "float" : fmt::format("vec{}", pass.channels);
}

std::string passArguments(const OwnPass& pass) {
  if (pass.raster == PassRaster::filter) return "ivec2 texel";
  return pass.raster == PassRaster::light ? "Pixel pixel, float depth" : "Pixel pixel";
}

}  // namespace

std::string OwnPass::function() const {
  return resolves ? "resolveTexel" : "pass" + capitalised(name);
}

int OwnPass::storedChannels() const {
  const int all = channels + (isMarked() ? 1 : 0);
  return all == 3 ? 4 : all;
}

OwnPass resolvePass() {
  OwnPass pass;
  pass.name = "resolved";
  pass.bits = std::nullopt;
  pass.resolves = true;
  return pass;
}

std::vector<OwnPass> readOwnPasses(const Declaration& declaration) {
  const toml::node* found = declaration.table().get("pass");
  if (found == nullptr) return {};
  const toml::array* list = found->as_array();
  if (list == nullptr || !list->is_array_of_tables()) {
    declaration.fail(*found, "`pass`: tables `[[pass]]` expected");
  }
  if (list->size() > mostPasses) {
    declaration.fail(*found,
                     fmt::format("{} passes found, at most {} expected", list->size(), mostPasses));
  }
  std::vector<OwnPass> passes;
  for (const toml::node& node : *list) {
    passes.push_back(readOwnPass(declaration, *node.as_table(), passes));
  }
  return passes;
}

void requirePassFunctions(const Declaration& declaration, const std::vector<OwnPass>& passes,
                          const std::vector<ShaderPiece>& code) {
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const OwnPass& pass = passes[i];
    const bool isFilter = pass.raster == PassRaster::filter;
    if (definesFunction(code, pass.function(), isFilter ? "ivec2" : "Pixel")) continue;
    declaration.fail(passTable(declaration, i),
                     fmt::format("pass `{}` needs the function `{} {}({})`", pass.name,
                                 passType(pass), pass.function(), passArguments(pass)));
  }
}

std::string passAccess(const std::vector<OwnPass>& passes) {
  std::string text;
  for (const OwnPass& pass : passes) {
    if (pass.resolves) continue;  // passes.glsl has it
    const std::string_view channels =
        std::string_view("rgba").substr(0, static_cast<std::size_t>(pass.channels));
    const auto define = [&](const char* ending, const std::string& place,
                            const std::string& value) {
      text += fmt::format("{} {}{}({}) {{ return {}.{}; }}\n", passType(pass), pass.name, ending,
                          place, value, channels);
    };
    const std::string target = pass.sampler();
    const std::string corner = pass.origin();
    text += fmt::format("uniform sampler2D {};\nuniform ivec2 {};\n", target, corner);
    define("Texel", "ivec2 at", fmt::format("passTexel({}, at - {}, 0)", target, corner));
    define("At", "vec2 at",
           pass.isMarked() ? fmt::format("markedAt({}, {}, at, {})", target, corner, pass.channels)
                           : fmt::format("passAt({}, at, 0)", target));
    if (pass.isMarked()) {
      text +=
          fmt::format("bool {}OtherChartAt(vec2 at) {{ return otherChartAt({}, {}, at, {}); }}\n",
                      pass.name, target, corner, pass.channels);
    }
    if (!pass.mips) continue;
    define("Texel", "ivec2 at, int level", fmt::format("passTexel({}, at, level)", target));
    define("At", "vec2 at, float level", fmt::format("passAt({}, at, level)", target));
  }
  return text;
}

std::string passMain(const OwnPass& pass, const std::vector<OwnPass>& passes) {
  std::string argument = "makePixel()";
  std::string mark = "float(chart)";
  if (pass.raster == PassRaster::light) argument += ", gl_FragCoord.z";
  if (pass.source) {
    const OwnPass& source = passes.at(*pass.source);
    argument = fmt::format("ivec2(gl_FragCoord.xy) + {}", pass.origin());
    mark = fmt::format("texelFetch({}, ivec2(gl_FragCoord.xy), 0)[{}]", source.sampler(),
                       source.channels);
  }
  return fmt::format(
      "void main() {{\n  stored = widened({}({}));\n{}}}\n", pass.function(), argument,
      pass.isMarked() ? fmt::format("  stored[{}] = {};\n", pass.channels, mark) : "");
}

}  // namespace gnomon::render
