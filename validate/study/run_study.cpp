#include "study/run_study.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "common/error.h"
#include "compare/counts.h"
#include "render/gpu_scene.h"
#include "render/method.h"
#include "render/passes.h"
#include "render/view.h"
#include "study/environment.h"
#include "study/thresholds.h"
#include "surface/base_mesh.h"
#include "truth/displaced_picture.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"

namespace gnomon {
namespace {

/// A base mesh and the views of it. Methods that draw another base mesh than the study's show other
/// samples in a camera view, so each has views and truths of its own.
struct BaseCase {
  BaseMesh mesh;
  GpuMesh gpu;
  std::vector<RenderView> views;
  std::vector<SampleGrid> samples;
  std::vector<std::vector<double>> weights;
  std::vector<std::vector<Truth>> truths;  ///< [view][light]
};

/// The tables of one bake in the bits of one method.
struct TableCase {
  GpuTable horizon;
  GpuTable distance;
};

struct MethodCase {
  Method method;
  MethodPass pass;
  const TableCase* tables;
  BaseCase* base;
};

using BakeKey = std::pair<int, double>;
using TableKey = std::tuple<int, double, int>;

BakeKey bakeKey(const BakeSpec& bake) {
  return {bake.settings.azimuths, bake.settings.radiusTexels};
}

TableKey tableKey(const BakeSpec& bake) {
  return {bake.settings.azimuths, bake.settings.radiusTexels, static_cast<int>(bake.bits)};
}

class StudyRun {
 public:
  StudyRun(const StudySpec& study, const GlContext& gl, RunWriter& writer,
           const StageProgress& progress)
      : study_(study),
        writer_(writer),
        clock_(progress),
        shaders_(shaderFolder()),
        surface_(clock_.measure("surface", [&](const Progress&) { return LimitSurface(study.cage); })),
        heights_(study.relief.field) {
    record_.environment = describeEnvironment(gl);
    record_.name = study.name;
    record_.title = study.title;
    record_.source = study.source;
    record_.file = study.file.string();
  }

  StudyRecord run() {
    prepareMethods();
    traceTruth();
    traceUncertainty();
    compareMethods();
    drawPanels();
    timeFrames();
    record_.thresholds = judgeThresholds(study_.thresholds, record_.results);
    record_.timings = clock_.timings();
    return std::move(record_);
  }

 private:
  // ---- before the truth: what depends on neither light nor micro-mesh

  void prepareMethods() {
    for (const MethodSpec& spec : study_.methods) {
      Method method = readMethod(spec.file);
      MethodPass pass(shaders_, method, study_.relief.field.wrap(), spec.filter, spec.parameters);
      record_.methods.push_back({spec.label, method.name, method.title, method.citation});
      const bool readsTables = method.tables.horizon || method.tables.distance;
      const TableCase* tables = readsTables ? &tablesFor(spec.bake) : nullptr;
      methods_.push_back(
          {std::move(method), std::move(pass), tables, &baseFor(spec.baseSubdivisions)});
    }
  }

  const TableCase& tablesFor(const BakeSpec& spec) {
    const auto found = tables_.find(tableKey(spec));
    if (found != tables_.end()) return found->second;
    const HeightField& field = study_.relief.field;
    auto bake = bakes_.find(bakeKey(spec));
    if (bake == bakes_.end()) {
      bake = bakes_
                 .emplace(bakeKey(spec), clock_.measure("bake",
                                                        [&](const Progress& progress) {
                                                          return bakeHorizons(field, spec.settings,
                                                                              progress);
                                                        }))
                 .first;
    }
    return clock_.measure("tables", [&](const Progress&) -> const TableCase& {
      const auto store = [&](const std::vector<float>& values) {
        return GpuTable(storeTable(values, spec.bits), field.width(), field.height(),
                        spec.settings.azimuths, field.wrap());
      };
      return tables_
          .emplace(tableKey(spec),
                   TableCase{store(bake->second.horizon), store(bake->second.distance)})
          .first->second;
    });
  }

  BaseCase& baseFor(int subdivisions) {
    const auto found = bases_.find(subdivisions);
    if (found != bases_.end()) return *found->second;
    return clock_.measure("samples", [&](const Progress&) -> BaseCase& {
      BaseMesh mesh = makeBaseMesh(surface_, study_.relief.texelsPerUv(), subdivisions);
      GpuMesh gpu(mesh);
      auto base = std::make_unique<BaseCase>(
          BaseCase{std::move(mesh), std::move(gpu), {}, {}, {}, {}});
      const SamplesPass pass(shaders_);
      for (const ViewSpec& view : study_.views) addView(*base, pass, view);
      return *bases_.emplace(subdivisions, std::move(base)).first->second;
    });
  }

  void addView(BaseCase& base, const SamplesPass& pass, const ViewSpec& view) {
    const auto* atlas = std::get_if<AtlasSpec>(&view.kind);
    base.views.push_back(atlas != nullptr
                             ? atlasView(surface_, atlas->samplesPerSide)
                             : cameraView(std::get<Camera>(view.kind), base.mesh));
    base.samples.push_back(pass.render(base.views.back(), base.gpu));
    if (std::all_of(base.samples.back().samples.begin(), base.samples.back().samples.end(),
                    [](const SurfaceSample& sample) { return sample.face < 0; })) {
      throw InputError(fmt::format("{}: view \"{}\" shows no surface: check eye, target and fov",
                                   study_.file.string(), view.name));
    }
    base.weights.push_back(
        atlas == nullptr ? std::vector<double>()
                         : sampleAreas(surface_, base.samples.back(),
                                       atlas->samplesPerSide * atlas->samplesPerSide));
  }

  // ---- the truth

  [[nodiscard]] Truth trace(const MicroMesh& mesh, const MicroScene& scene, const SampleGrid& samples,
                            const LightSpec& light, double liftShare, const Progress& progress) const {
    const TraceSettings settings{light.direction(), study_.bake.settings.radiusTexels, liftShare};
    return traceShadows(surface_, study_.relief, mesh, scene, samples, settings, progress);
  }

  void traceTruth() {
    const MicroMesh mesh = clock_.measure("micro-mesh", [&](const Progress& progress) {
      return MicroMesh(surface_, study_.relief, study_.truth, progress);
    });
    const auto scene = clock_.measure(
        "hierarchy", [&](const Progress&) { return std::make_unique<MicroScene>(mesh); });
    record_.truth.microTriangles = mesh.triangleCount();
    record_.truth.stepTexels = mesh.stepTexels();
    record_.truth.bvhBytes = scene->byteCount();
    record_.truth.meshBytes = mesh.coordinates().size() * sizeof(float);
    for (auto& [subdivisions, base] : bases_) {
      for (const SampleGrid& samples : base->samples) {
        std::vector<Truth> truths;
        for (const LightSpec& light : study_.lights) {
          truths.push_back(clock_.measure("truth", [&](const Progress& progress) {
            return trace(mesh, *scene, samples, light, standardLift, progress);
          }));
        }
        record_.undefinedSamples += truths.front().undefinedSamples;
        base->truths.push_back(std::move(truths));
      }
    }
    drawDisplaced(mesh, *scene);
  }

  /// The same rays at half the resolution and half the lift: what flips is the truth's own error.
  void traceUncertainty() {
    MicroMeshSettings half = study_.truth;
    half.stepTexels = 2 * record_.truth.stepTexels;
    const MicroMesh mesh = clock_.measure("uncertainty", [&](const Progress& progress) {
      return MicroMesh(surface_, study_.relief, half, progress);
    });
    const auto scene = clock_.measure(
        "uncertainty", [&](const Progress&) { return std::make_unique<MicroScene>(mesh); });
    const BaseCase& base = *bases_.at(study_.baseSubdivisions);
    for (std::size_t v = 0; v < study_.views.size(); ++v) {
      for (std::size_t l = 0; l < study_.lights.size(); ++l) {
        const Truth coarse = clock_.measure("uncertainty", [&](const Progress& progress) {
          return trace(mesh, *scene, base.samples[v], study_.lights[l], standardLift / 2, progress);
        });
        const double flips = flipRate(base.truths[v][l].mask, coarse.mask);
        record_.truth.flips.push_back({study_.views[v].name, study_.lights[l].name, flips});
        record_.truth.uncertainty = std::max(record_.truth.uncertainty, flips);
      }
    }
  }

  // ---- the methods

  [[nodiscard]] Drawing drawing(const BaseCase& base, std::size_t light) const {
    return {base.gpu, heights_, study_.relief.field.wrap(), study_.relief.space,
            study_.lights[light].direction()};
  }

  [[nodiscard]] static GpuTables gpuTables(const MethodCase& method) {
    if (method.tables == nullptr) return {};
    return {&method.tables->horizon, &method.tables->distance};
  }

  void compareMethods() {
    for (std::size_t v = 0; v < study_.views.size(); ++v) {
      for (std::size_t l = 0; l < study_.lights.size(); ++l) {
        std::vector<Mask> masks;
        for (std::size_t m = 0; m < methods_.size(); ++m) {
          masks.push_back(clock_.measure("methods", [&](const Progress&) {
            return answer(methods_[m], v, l);
          }));
          clock_.measure("compare", [&](const Progress&) { compare(m, v, l, masks.back()); });
        }
        masks_.push_back(std::move(masks));
      }
    }
  }

  /// A method's mask, without the samples for which no frame exists.
  [[nodiscard]] Mask answer(const MethodCase& method, std::size_t view, std::size_t light) const {
    const BaseCase& base = *method.base;
    Mask mask = method.pass.render(base.views[view], drawing(base, light), gpuTables(method));
    const Mask& truth = base.truths[view][light].mask;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (truth.samples[i] == Shade::none) mask.samples[i] = Shade::none;
    }
    return mask;
  }

  void compare(std::size_t method, std::size_t view, std::size_t light, const Mask& mask) {
    const BaseCase& base = *methods_[method].base;
    const Truth& truth = base.truths[view][light];
    const auto add = [&](std::string_view region, std::span<const std::uint8_t> selected) {
      record_.results.push_back({study_.methods[method].label, study_.lights[light].name,
                                 study_.views[view].name, std::string(region),
                                 countSamples(mask, truth.mask, base.weights[view], selected)});
    };
    add("all", {});
    std::vector<std::uint8_t> selected(mask.size());
    for (const Region region : reportedRegions) {
      std::transform(truth.regions.begin(), truth.regions.end(), selected.begin(),
                     [region](Region r) { return static_cast<std::uint8_t>(r == region); });
      add(regionName(region), selected);
    }
  }

  // ---- pictures

  [[nodiscard]] std::size_t panelIndex(std::size_t view, std::size_t light) const {
    return view * study_.lights.size() + light;
  }

  [[nodiscard]] std::string pictureStem(std::size_t view, std::size_t light) const {
    return viewFiles_[view] + "_" + lightFiles_[light];
  }

  void drawDisplaced(const MicroMesh& mesh, const MicroScene& scene) {
    for (std::size_t v = 0; v < study_.views.size(); ++v) {
      const auto* camera = std::get_if<Camera>(&study_.views[v].kind);
      if (camera == nullptr) continue;
      for (std::size_t l = 0; l < study_.lights.size(); ++l) {
        const auto picture = clock_.measure("displaced picture", [&](const Progress& progress) {
          return displacedPicture(mesh, scene, *camera, study_.lights[l].direction(), progress);
        });
        clock_.measure("writing", [&](const Progress&) {
          writer_.displaced(displacedPath(v, l), camera->width, camera->height, picture);
        });
      }
    }
  }

  [[nodiscard]] std::string displacedPath(std::size_t view, std::size_t light) const {
    return fmt::format("images/{}_displaced.png", pictureStem(view, light));
  }

  void drawPanels() {
    const ShadePass shade(shaders_, study_.relief.field.wrap());
    for (std::size_t v = 0; v < study_.views.size(); ++v) {
      for (std::size_t l = 0; l < study_.lights.size(); ++l) {
        record_.panels.push_back(drawPanel(shade, v, l));
      }
    }
  }

  PanelRecord drawPanel(const ShadePass& shade, std::size_t view, std::size_t light) {
    const BaseCase& standard = *bases_.at(study_.baseSubdivisions);
    PanelRecord panel{study_.views[view].name, study_.lights[light].name,
                      standard.views[view].width, standard.views[view].height, {}};
    const std::string stem = pictureStem(view, light);
    const auto shadeMask = [&](const BaseCase& base, const Mask& mask, const std::string& name) {
      const auto rgb = clock_.measure("pictures", [&](const Progress&) {
        return shade.render(base.views[view], drawing(base, light), mask);
      });
      clock_.measure("writing", [&](const Progress&) {
        writer_.shaded(fmt::format("images/{}_{}.png", stem, name), mask.width, mask.height, rgb);
        writer_.mask(fmt::format("masks/{}_{}.png", stem, name), mask);
      });
    };
    const std::vector<Mask>& masks = masks_[panelIndex(view, light)];
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const std::string& label = study_.methods[m].label;
      shadeMask(*methods_[m].base, masks[m], methodFiles_[m]);
      panel.pictures.push_back({PictureRecord::Kind::shaded, label, label,
                                fmt::format("images/{}_{}.png", stem, methodFiles_[m])});
    }
    if (std::holds_alternative<Camera>(study_.views[view].kind)) {
      panel.pictures.push_back({PictureRecord::Kind::displaced, "truth", "displaced mesh, ray-traced",
                                displacedPath(view, light)});
    }
    shadeMask(standard, standard.truths[view][light].mask, "truth");
    panel.pictures.push_back({PictureRecord::Kind::shaded, "truth", "truth",
                              fmt::format("images/{}_truth.png", stem)});
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const std::string path = fmt::format("images/{}_{}_difference.png", stem, methodFiles_[m]);
      clock_.measure("writing", [&](const Progress&) {
        writer_.difference(path, masks[m], methods_[m].base->truths[view][light].mask);
      });
      const std::string& label = study_.methods[m].label;
      panel.pictures.push_back({PictureRecord::Kind::difference, label, label, path});
    }
    return panel;
  }

  // ---- cost

  /// On the first camera view under the first light; without a camera view there is no frame time.
  void timeFrames() {
    constexpr int frames = 5;
    const auto camera = std::find_if(study_.views.begin(), study_.views.end(), [](const ViewSpec& v) {
      return std::holds_alternative<Camera>(v.kind);
    });
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const MethodCase& method = methods_[m];
      CostRecord cost;
      cost.method = study_.methods[m].label;
      cost.polygons = method.base->gpu.triangleCount();
      if (method.method.tables.horizon) cost.tableBytes += method.tables->horizon.byteCount();
      if (method.method.tables.distance) cost.tableBytes += method.tables->distance.byteCount();
      if (method.method.tables.height) cost.heightBytes = heights_.byteCount();
      if (camera != study_.views.end()) {
        const auto view = static_cast<std::size_t>(camera - study_.views.begin());
        cost.frameMs = clock_.measure("frame times", [&](const Progress&) {
          return method.pass.frameMilliseconds(method.base->views[view], drawing(*method.base, 0),
                                               gpuTables(method), frames);
        });
      }
      record_.cost.push_back(cost);
    }
  }

  template <typename Entries, typename NameOf>
  static std::vector<std::string> fileNamesOf(const Entries& entries, const NameOf& nameOf) {
    std::vector<std::string> names;
    for (const auto& entry : entries) names.push_back(nameOf(entry));
    return fileNames(names);
  }

  static constexpr double standardLift = 1e-6;

  const StudySpec& study_;
  RunWriter& writer_;
  StageClock clock_;
  std::filesystem::path shaders_;
  LimitSurface surface_;
  GpuHeights heights_;
  std::map<BakeKey, HorizonTables> bakes_;
  std::map<TableKey, TableCase> tables_;
  std::map<int, std::unique_ptr<BaseCase>> bases_;
  std::vector<MethodCase> methods_;
  std::vector<std::vector<Mask>> masks_;  ///< [panel][method]
  std::vector<std::string> viewFiles_ = fileNamesOf(study_.views, [](const ViewSpec& v) { return v.name; });
  std::vector<std::string> lightFiles_ =
      fileNamesOf(study_.lights, [](const LightSpec& light) { return light.name; });
  std::vector<std::string> methodFiles_ =
      fileNamesOf(study_.methods, [](const MethodSpec& method) { return method.label; });
  StudyRecord record_;
};

}  // namespace

StudyRecord runStudy(const StudySpec& study, const GlContext& gl, RunWriter& writer,
                     const StageProgress& progress) {
  return StudyRun(study, gl, writer, progress).run();
}

std::vector<std::string> fileNames(const std::vector<std::string>& names) {
  std::vector<std::string> result;
  std::set<std::string> taken;
  for (const std::string& name : names) {
    std::string plain;
    for (const char c : name) {
      const bool keep = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
      if (keep) plain += c;
      else if (!plain.empty() && plain.back() != '-') plain += '-';
    }
    while (!plain.empty() && plain.back() == '-') plain.pop_back();
    if (plain.empty()) plain = "unnamed";
    std::string distinct = plain;
    for (int k = 2; !taken.insert(distinct).second; ++k) distinct = fmt::format("{}-{}", plain, k);
    result.push_back(distinct);
  }
  return result;
}

}  // namespace gnomon
