#include "export/export_files.h"

#include <fmt/core.h>

#include <array>

#include "common/parallel.h"
#include "common/system/memory.h"
#include "export/sample_map.h"
#include "image/channel_image.h"
#include "image/images.h"
#include "truth/sample_place.h"

namespace gnomon::exporting {
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
