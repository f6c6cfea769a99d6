#include "render/bakes/bake_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "common/error.h"
#include "common/system/memory.h"
#include "render/gl_context.h"
#include "render/gl_objects.h"
#include "render/passes/drawing.h"
#include "render/passes/texel_counter.h"

namespace gnomon::render {
namespace {

MethodStage bakeStage(const std::filesystem::path& shaders, const Method& method) {
  return {readShader(shaders / "common/plane.vert"),
          {readShader(shaders / "common/values.frag"),
           {method.source.file + " (calls of the bakes)", bakeMain(method.bakes), 1}}};
}

/// A texture of floats that rows of a bake are drawn into.
class Strip {
 public:
  Strip(int width, int rows) : width_(width) {
    colour_ = gl::makeTexture(GL_TEXTURE_2D, GL_RGBA32F, {width, rows}, GL_NEAREST);
    framebuffer_ = gl::makeFramebuffer();
    glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, colour_.name(), 0);
    if (glCheckNamedFramebufferStatus(framebuffer_.name(), GL_DRAW_FRAMEBUFFER) !=
        GL_FRAMEBUFFER_COMPLETE) {
      throw InternalError(fmt::format("no framebuffer of {} × {} texels", width, rows));
    }
  }

  /// Draws some rows, and reads them back: four values a texel.
  [[nodiscard]] std::vector<float> draw(GLuint program, int rows) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, width_, rows);
    drawPlane(program);
    std::vector<float> values(4 * static_cast<std::size_t>(width_) *
                              static_cast<std::size_t>(rows));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(colour_.name(), 0, 0, 0, 0, width_, rows, 1, GL_RGBA, GL_FLOAT,
                         static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
    return values;
  }

 private:
  int width_;
  gl::Texture colour_;
  gl::Framebuffer framebuffer_;
};

/// How many rows are drawn at once: about as many as take a twentieth of a second.
class RowCount {
 public:
  RowCount(int width, int height)
      : most_(std::clamp((1 << 22) / width, 1, height)), rows_(std::min(8, most_)) {}

  [[nodiscard]] int most() const { return most_; }
  [[nodiscard]] int rows() const { return rows_; }
  void took(double seconds) {
    constexpr double wanted = 0.05;
    if (seconds < wanted / 2) rows_ = std::min(2 * rows_, most_);
    if (seconds > wanted * 2) rows_ = std::max(rows_ / 2, 1);
  }

 private:
  int most_;
  int rows_;
};

/// Keeps the channels of the values of a texel that a bake has.
void appendTexels(const std::vector<float>& drawn, int channels, std::vector<float>& layer) {
  for (std::size_t i = 0; i < drawn.size(); i += 4) {
    layer.insert(layer.end(), drawn.begin() + static_cast<std::ptrdiff_t>(i),
                 drawn.begin() + static_cast<std::ptrdiff_t>(i) + channels);
  }
}

void requireNumbers(const std::string& method, const MethodBake& bake, int width, int layer,
                    const std::vector<float>& values) {
  const auto wrong =
      std::find_if(values.begin(), values.end(), [](float value) { return !std::isfinite(value); });
  if (wrong == values.end()) return;
  const auto texel = (wrong - values.begin()) / bake.channels;
  throw InputError(fmt::format(
      "method {}: bake `{}`: {} found at texel ({}, {}) of layer {}, a finite number expected; a "
      "bake may read heights, tables and the bakes declared before it, no pixel and no light",
      method, bake.name, *wrong, texel % width, texel / width, layer));
}

/// @param ended  what endlessStage draws, four values a texel
void requireEnds(const std::string& method, const MethodBake& bake,
                 const std::vector<float>& ended) {
  const auto count =
      std::count_if(ended.begin(), ended.end(), [](float one) { return one > 0; }) / 4;
  if (count == 0) return;
  throw InputError(
      fmt::format("method {}: bake `{}`: its loops turn {} times or more at {} of {} texels, fewer "
                  "expected: is "
                  "one without an end?",
                  method, bake.name, mostLoopIterations, count, ended.size() / 4));
}

/// Values as shares of the range that their codes stand for.
std::vector<float> sharesOf(const MethodBake& bake, const std::vector<float>& values) {
  if (bake.ranges.empty()) return values;
  std::vector<float> shares(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const glm::vec2 range = bake.ranges[i % bake.ranges.size()];
    shares[i] = std::clamp((values[i] - range.x) / (range.y - range.x), 0.0F, 1.0F);
  }
  return shares;
}

/// Stores a layer with its coarser levels.
void storeLayer(const MethodBake& bake, int layer, std::vector<float> values, StoredBake& stored) {
  for (int level = 0; level < stored.levels; ++level) {
    if (level > 0) values = coarser(values, stored.sizeOf(level - 1), bake.mips);
    const std::size_t place = stored.entry(level) + static_cast<std::size_t>(layer) * values.size();
    stored.values.set(place, sharesOf(bake, values));
  }
}

/// The number of texels of all first levels, layer by layer.
double texelsOf(const std::vector<MethodBake>& bakes, glm::ivec2 map) {
  double texels = 0;
  for (const MethodBake& bake : bakes) {
    const glm::dvec2 size = bake.sizeOver(map);
    texels += size.x * size.y * bake.layers;
  }
  return texels;
}

}  // namespace

void requireBakeSizes(const Method& method, glm::ivec2 map) {
  const int widest = gl::limit(GL_MAX_TEXTURE_SIZE);
  const int most = gl::limit(GL_MAX_ARRAY_TEXTURE_LAYERS);
  double bytes = 0;
  for (const MethodBake& bake : method.bakes) {
    const glm::dvec2 exact = bake.size ? glm::dvec2(*bake.size) : bake.scale * glm::dvec2(map);
    const std::string what = fmt::format("method {}: bake `{}`: {:.0f} × {:.0f} texels × {} layers",
                                         method.name, bake.name, exact.x, exact.y, bake.layers);
    if (!(exact.x <= widest && exact.y <= widest && bake.layers <= most)) {
      throw InputError(fmt::format("{} found, OpenGL takes at most {} a side and {} layers", what,
                                   widest, most));
    }
    constexpr double levels = 4.0 / 3;
    constexpr double copies = 3;  // the stored one, the driver's, and the one in the cache's hands
    const double texels = std::max(exact.x, 1.0) * std::max(exact.y, 1.0);
    bytes +=
        bake.channels * texels *
        (bake.layers * copies * levels * static_cast<double>(bake.bits) / 8 + 2 * sizeof(float));
    requireMemory(bytes, what);
  }
}

BakePass::BakePass(const std::filesystem::path& shaders, const Method& method, relief::Wrap wrap,
                   TableFilter filter, const std::map<std::string, double>& values, bool endsLoops)
    : name_(method.name),
      tables_(method.tables),
      bakes_(method.bakes),
      passes_(method.passes.own),
      textures_(method.textures),
      pictures_(gpuTextures(method)) {
  const std::map<std::string, double> all = parameterValues(method, values);
  const std::vector<std::string> defines = methodDefines(method, wrap, filter);
  program_ = makeMethodProgram(shaders, method, bakeStage(shaders, method), defines);
  setParameters(program_.name(), method, all);
  if (endsLoops) {
    check_ = makeMethodProgram(shaders, method, endlessStage(bakeStage(shaders, method)), defines);
    setParameters(check_->name(), method, all);
  }
  for (const auto& [name, value] : all) {
    if (glGetUniformLocation(program_.name(), name.c_str()) >= 0) used_.emplace(name, value);
  }
}

std::vector<StoredBake> BakePass::bake(const BakeScene& scene, const GpuTables& tables,
                                       const Progress& progress) const {
  const glm::ivec2 map = scene.heights.size();
  const gl::Texture nothing = makeNoNumber(GL_TEXTURE_2D_ARRAY);
  const gl::Texture noTarget = makeNoNumber(GL_TEXTURE_2D);
  const double all = texelsOf(bakes_, map);
  double done = 0;
  std::vector<StoredBake> found;
  std::vector<GpuBake> earlier;
  for (std::size_t number = 0; number < bakes_.size(); ++number) {
    const MethodBake& bake = bakes_[number];
    StoredBake stored = emptyBake(bake, map);
    RowCount rows(stored.width, stored.height);
    const Strip strip(stored.width, rows.most());
    for (int layer = 0; layer < stored.layers; ++layer) {
      std::vector<float> values;
      values.reserve(static_cast<std::size_t>(stored.width) *
                     static_cast<std::size_t>(stored.height) *
                     static_cast<std::size_t>(stored.channels));
      const auto drawRows = [&](GLuint program, int row, int count) {
        // Whoever watches may have drawn something else meanwhile.
        setRelief(program, scene.heights, scene.heightSpace, scene.texelsPerHeight);
        setUniform(program, "lightDirection", Vec3(NAN));
        setUniform(program, "lightRadius", static_cast<double>(NAN));
        bindTables(program, name_, tables_, tables);
        for (std::size_t k = 0; k < bakes_.size(); ++k) {
          bindTexture(program, bakeUnit(k), k < number ? earlier[k].texture() : nothing.name(),
                      bakes_[k].sampler().c_str());
        }
        for (std::size_t k = 0; k < passes_.size(); ++k) {
          bindTexture(program, passUnit(k), noTarget.name(), passes_[k].sampler().c_str());
        }
        bindOwnTextures(program, textures_, pictures_);
        setUniform(program, "bakeNumber", static_cast<int>(number));
        setUniform(program, "bakeLayer", layer);
        setUniform(program, "bakeStep",
                   glm::vec2(glm::dvec2(map) / glm::dvec2(stored.width, stored.height)));
        setUniform(program, "bakeCorner", glm::vec2(0, row));
        return strip.draw(program, count);
      };
      for (int row = 0; row < stored.height;) {
        const int count = std::min(rows.rows(), stored.height - row);
        if (check_) requireEnds(name_, bake, drawRows(check_->name(), row, count));
        const auto start = std::chrono::steady_clock::now();
        appendTexels(drawRows(program_.name(), row, count), stored.channels, values);
        throwOnGlError("baking a table of a method");
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        rows.took(taken.count());
        row += count;
        done += static_cast<double>(count) * stored.width;
        if (progress) progress(done / all);
      }
      requireNumbers(name_, bake, stored.width, layer, values);
      storeLayer(bake, layer, std::move(values), stored);
    }
    earlier.emplace_back(stored, scene.wrap, scene.heights.border(), bake.isFiltered);
    found.push_back(std::move(stored));
  }
  return found;
}

std::vector<GpuBake> gpuBakes(const Method& method, const std::vector<StoredBake>& stored,
                              const BakeScene& scene) {
  std::vector<GpuBake> bakes;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    bakes.emplace_back(stored[i], scene.wrap, scene.heights.border(),
                       method.bakes.at(i).isFiltered);
  }
  return bakes;
}

}  // namespace gnomon::render
