#include "export/truth_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <utility>

#include "common/parallel.h"
#include "common/system/memory.h"
#include "image/mask_picture.h"
#include "report/json/json_values.h"
#include "report/view_images.h"
#include "truth/shadow_tracer.h"

namespace gnomon::exporting {

namespace {

std::string withEnding(const std::string& mapFile, const char* ending) {
  return mapFile.substr(0, mapFile.rfind('.')) + ending;
}

}  // namespace

std::string npyName(const std::string& mapFile) {
  return withEnding(mapFile, ".npy");
}

std::string layersName(const std::string& mapFile) {
  return withEnding(mapFile, "_layers.exr");
}

void writeSampleMap(report::RunFolder& folder, const std::string& mapFile,
                    image::ChannelImage map) {
  image::writeExr(folder.newFile(mapFile), map);
  folder.write(npyName(mapFile), npyBytes(map));
  const std::map<std::string, std::string> inLayers = {
      {"face", "place.X"}, {"s", "place.Y"}, {"t", "place.Z"}, {"weight", "texel.Z"}};
  for (std::string& channel : map.channels) {
    const auto other = inLayers.find(channel);
    if (other != inLayers.end()) channel = other->second;
  }
  image::writeExr(folder.newFile(layersName(mapFile)), map);
}

std::string npyBytes(const image::ChannelImage& image) {
  static_assert(std::endian::native == std::endian::little);
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, {}), }}",
                  image.height, image.width, image.channels.size());
  // Magic, version and the length's two bytes, then the header; all together in steps of 64.
  constexpr std::size_t before = 10;
  header.append(63 - (before + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() % 256);
  bytes += static_cast<char>(header.size() / 256);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(image.values.data()),
               image.values.size() * sizeof(float));
  return bytes;
}

namespace {

std::string regionFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("regions/{}_{}.png", names.views[view], names.lights[light]);
}

report::Json regionCountsJson(const truth::Truth& truth) {
  report::Json counts = report::Json::object();
  for (const truth::Region region : truth::reportedRegions) {
    counts[std::string(truth::regionName(region))] =
        std::count(truth.regions.begin(), truth.regions.end(), region);
  }
  return counts;
}

report::Json caseJson(study::RunScene& scene, const study::StudyRecord& record,
                      const study::CaseNames& names, std::size_t view, std::size_t light) {
  const truth::Truth& truth = scene.standardBase().views[view].truths[light];
  const auto count = [&](Shade shade) {
    return std::count(truth.mask.samples.begin(), truth.mask.samples.end(), shade);
  };
  const study::UncertaintyRecord& flip =
      record.truth.flips.at(view * scene.study.lights.size() + light);
  report::Json json = {{"view", scene.study.views[view].name},
                       {"light", scene.study.lights[light].name},
                       {"width", truth.mask.width},
                       {"height", truth.mask.height},
                       {"mask", truthMaskFile(names, view, light)},
                       {"regions", regionFile(names, view, light)},
                       {"lit", count(Shade::lit)},
                       {"shadowed", count(Shade::shadowed)},
                       {"undefined_samples", truth.undefinedSamples},
                       {"region_samples", regionCountsJson(truth)},
                       {"uncertainty", report::jsonNumber(flip.flipRate, "cases.uncertainty")}};
  if (truth.isSoft()) json["shares"] = truthShareFile(names, view, light);
  return json;
}

/// Calls `visit(view, light)` for every case of the study.
template <typename Visit>
void forEachCase(const study::StudySpec& study, const Visit& visit) {
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    for (std::size_t l = 0; l < study.lights.size(); ++l) visit(v, l);
  }
}

}  // namespace

std::string truthMaskFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("masks/{}_{}_truth.png", names.views[view], names.lights[light]);
}

std::string truthShareFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("shares/{}_{}_truth.exr", names.views[view], names.lights[light]);
}

void writeTruthMask(report::RunFolder& folder, const truth::Truth& truth,
                    const std::string& maskFile, const std::string& shareFile) {
  if (truth.isSoft()) {
    folder.write(maskFile, image::sharePng(truth.visibility));
    folder.write(shareFile, image::shareExr(truth.visibility));
  } else {
    folder.write(maskFile, image::pngOf(image::maskImage(truth.mask)));
  }
}

void writeTruthMasks(report::RunFolder& folder, study::RunScene& scene) {
  const study::CaseNames names = study::caseNames(scene.study);
  forEachCase(scene.study, [&](std::size_t v, std::size_t l) {
    writeTruthMask(folder, scene.standardBase().views[v].truths[l], truthMaskFile(names, v, l),
                   truthShareFile(names, v, l));
  });
}

void writeTruth(report::RunFolder& folder, study::RunScene& scene,
                const study::StudyRecord& record) {
  writeTruthMasks(folder, scene);
  const study::CaseNames names = study::caseNames(scene.study);
  report::Json cases = report::Json::array();
  forEachCase(scene.study, [&](std::size_t v, std::size_t l) {
    folder.write(regionFile(names, v, l),
                 image::pngOf(report::regionImage(scene.standardBase().views[v].truths[l])));
    cases.push_back(caseJson(scene, record, names, v, l));
  });
  const report::Json json = {{"schema", "gnomon-truth/1"},
                             {"study", report::jsonStudy(record)},
                             {"environment", report::jsonEnvironment(record.environment)},
                             {"truth", report::jsonTruth(record.truth)},
                             {"region_colours", report::jsonRegionColours()},
                             {"cases", std::move(cases)},
                             {"undefined_samples", record.undefinedSamples},
                             {"notices", record.notices}};
  folder.finish(report::jsonText(json));
}

namespace {

using Pixel = std::array<float, 18>;

Pixel pixelOf(const truth::SamplePlace& place, const Vec3& centre, double weight) {
  if (!place.defined) return {-1};
  const auto f = [](double value) { return static_cast<float>(value); };
  const Vec3 point = place.facet.point + centre;
  return {f(place.sample.face),
          place.sample.s,
          place.sample.t,
          f(place.frame.texel.x),
          f(place.frame.texel.y),
          f(place.frame.position.x),
          f(place.frame.position.y),
          f(place.frame.position.z),
          f(place.frame.normal.x),
          f(place.frame.normal.y),
          f(place.frame.normal.z),
          f(point.x),
          f(point.y),
          f(point.z),
          f(place.facet.normal.x),
          f(place.facet.normal.y),
          f(place.facet.normal.z),
          f(weight)};
}

image::ChannelImage sampleMap(const study::RunScene& scene, const study::ViewCase& view,
                              const truth::MicroMesh& mesh) {
  const surface::SampleGrid& grid = view.samples;
  image::ChannelImage map{grid.width, grid.height, sampleChannels(), {}};
  requireMemory(sizeof(Pixel) * static_cast<double>(grid.samples.size()),
                fmt::format("a sample map of {} × {} pixels", grid.width, grid.height));
  map.values.resize(grid.samples.size() * std::tuple_size_v<Pixel>);
  const Vec2 texelsPerUv = scene.study.relief.texelsPerUv();
  const auto width = static_cast<std::size_t>(grid.width);
  parallelFor(0, static_cast<std::size_t>(grid.height), [&](std::size_t row) {
    truth::SamplePlacer placer(scene.surface, texelsPerUv, mesh);
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      const truth::SamplePlace place = placer.place(grid.samples[i]);
      const Pixel pixel = pixelOf(place, mesh.centre(), view.weights.empty() ? 1 : view.weights[i]);
      std::copy(pixel.begin(), pixel.end(),
                map.values.begin() + static_cast<std::ptrdiff_t>(i * pixel.size()));
    }
  });
  return map;
}

}  // namespace

const std::vector<std::string>& sampleChannels() {
  static const std::vector<std::string> names = {
      "face",    "s",       "t",        "texel.X",  "texel.Y",  "base.X",
      "base.Y",  "base.Z",  "normal.X", "normal.Y", "normal.Z", "point.X",
      "point.Y", "point.Z", "facet.X",  "facet.Y",  "facet.Z",  "weight"};
  return names;
}

std::string sampleMapFile(const study::CaseNames& names, std::size_t view) {
  return fmt::format("samples/{}.exr", names.views[view]);
}

std::string roiFile(const study::CaseNames& names, std::size_t view) {
  return fmt::format("roi/{}.png", names.views[view]);
}

void writeHeights(report::RunFolder& folder, const relief::HeightField& field) {
  image::ChannelImage image{field.width(), field.height(), {"height"}, {}};
  image.values.reserve(field.texels().size());
  for (int row = field.height() - 1; row >= 0; --row) {
    for (int column = 0; column < field.width(); ++column) {
      image.values.push_back(field.texel(column, row));
    }
  }
  image::writeExr(folder.newFile("heights.exr"), image);
}

void writeSampleMaps(report::RunFolder& folder, study::RunScene& scene,
                     const truth::MicroMesh& mesh) {
  const study::CaseNames names = study::caseNames(scene.study);
  for (std::size_t v = 0; v < scene.study.views.size(); ++v) {
    writeSampleMap(folder, sampleMapFile(names, v),
                   sampleMap(scene, scene.standardBase().views[v], mesh));
  }
}

void writeRegionsOfInterest(report::RunFolder& folder, study::RunScene& scene) {
  const study::CaseNames names = study::caseNames(scene.study);
  for (std::size_t v = 0; v < scene.study.views.size(); ++v) {
    Mask roi = scene.standardBase().views[v].truths.front().mask;
    for (Shade& shade : roi.samples) {
      shade = shade == Shade::none ? Shade::shadowed : Shade::lit;
    }
    folder.write(roiFile(names, v), image::pngOf(image::maskImage(roi)));
  }
}

}  // namespace gnomon::exporting
