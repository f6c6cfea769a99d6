#include "study/spec/sections/view_section.h"

#include <algorithm>
#include <cmath>

namespace gnomon::study {

std::vector<Light> readLights(const TomlReader& section) {
  LightSection light;
  section.allow(namesOf(keysOf(light)));
  readKeys(section, keysOf(light));
  const bool isSingle = light.elevations.size() * light.azimuths.size() == 1;
  if (section.has("name") && !isSingle) {
    section.fail("name", "a name found for several lights, which are named by their angles");
  }
  if (section.has("sun") && section.has("radius")) {
    section.fail("sun", "`radius` found beside it, one of the two expected");
  }
  const double radius = light.sun ? sunRadius : light.radius;
  std::vector<Light> lights;
  for (const double azimuth : light.azimuths) {
    for (const double elevation : light.elevations) {
      lights.push_back(makeLight({azimuth, elevation, radius}, light.name));
    }
  }
  return lights;
}

LightSection sectionOf(const Light& light) {
  return {{light.angles.elevation}, {light.angles.azimuth}, light.name, light.angles.radius};
}

namespace {

/// The quick form of a side, and the longest side whose quick form it can be.
int quickSide(int side) {
  return std::max(1, side / 4);
}
int fullSide(int side, bool quick) {
  return quick ? 4 * side + 3 : side;
}

void makeQuick(ViewKind& kind) {
  std::visit(Overloaded{[](Camera& camera) {
                          camera.width = quickSide(camera.width);
                          camera.height = quickSide(camera.height);
                        },
                        // An odd number keeps the samples off the micro-edges.
                        [](AtlasSpec& atlas) {
                          atlas.samplesPerSide = quickSide(atlas.samplesPerSide) | 1;
                        }},
             kind);
}

}  // namespace

ViewSpec readView(const TomlReader& section, bool quick) {
  ViewSpec view;
  KeyNames names = namesOfAllKinds<ViewKind>("type", keysOf);
  names.merge(namesOf(keysOf(view)));
  section.allow(names);
  view.kind = readKind<ViewKind>(section, "type", viewKindNames, keysOf);
  view.name = viewKindNames.at(view.kind.index());
  readKeys(section, keysOf(view));
  section.finish();
  if (quick) makeQuick(view.kind);
  return view;
}

toml::table tableOf(ViewSpec view) {
  toml::table table = tableOf(keysOf(view.kind));
  table.insert("type", viewKindNames.at(view.kind.index()));
  table.insert("name", view.name);
  return table;
}

compare::PictureExtent fullExtent(const ViewSpec& view, bool quick, Vec2 texelsPerUv, int faces) {
  return std::visit(Overloaded{[&](const Camera& camera) -> compare::PictureExtent {
                                 const double width = fullSide(camera.width, quick);
                                 const double height = fullSide(camera.height, quick);
                                 return {std::hypot(width, height), width * height};
                               },
                               [&](const AtlasSpec& atlas) -> compare::PictureExtent {
                                 const double side = fullSide(atlas.samplesPerSide, quick);
                                 return {glm::length(texelsPerUv), faces * side * side};
                               }},
                    view.kind);
}

ViewTraits traitsOf(const ViewSpec& view) {
  using Traits = ViewTraits;
  return std::visit(Overloaded{[](const Camera& camera) {
                                 return Traits{&camera, false, render::PassKind::cameraSamples};
                               },
                               [](const AtlasSpec&) {
                                 return Traits{nullptr, true, render::PassKind::atlasSamples};
                               }},
                    view.kind);
}

render::RenderView pictureSize(const ViewSpec& view, const surface::LimitSurface& surface) {
  return std::visit(Overloaded{[](const Camera& camera) {
                                 render::RenderView size;
                                 size.width = camera.width;
                                 size.height = camera.height;
                                 return size;
                               },
                               [&](const AtlasSpec& atlas) {
                                 return render::atlasView(surface, atlas.samplesPerSide);
                               }},
                    view.kind);
}

render::RenderView renderView(const ViewSpec& view, const surface::LimitSurface& surface,
                              const surface::BaseMesh& mesh) {
  return std::visit(
      Overloaded{
          [&](const Camera& camera) { return render::cameraView(camera, mesh); },
          [&](const AtlasSpec& atlas) { return render::atlasView(surface, atlas.samplesPerSide); }},
      view.kind);
}

std::vector<double> sampleWeights(const ViewSpec& view, const surface::LimitSurface& surface,
                                  const surface::SampleGrid& samples) {
  return std::visit(Overloaded{[](const Camera&) { return std::vector<double>(); },
                               [&](const AtlasSpec& atlas) {
                                 return surface::sampleAreas(surface, samples,
                                                             atlas.samplesPerSide);
                               }},
                    view.kind);
}

}  // namespace gnomon::study
