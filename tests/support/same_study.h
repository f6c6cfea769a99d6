#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <variant>

#include "study/spec/sections/method_section.h"
#include "study/spec/study_file.h"

namespace gnomon::test {

inline bool sameCage(const surface::Cage& a, const surface::Cage& b) {
  return a.positions == b.positions && a.faceVertices == b.faceVertices && a.uvs == b.uvs &&
         a.faceUvs == b.faceUvs && a.creases.size() == b.creases.size() &&
         a.sharpVertices.size() == b.sharpVertices.size() && a.border == b.border &&
         a.scheme == b.scheme && a.grid.has_value() == b.grid.has_value();
}

inline bool sameRelief(const relief::Relief& a, const relief::Relief& b) {
  return a.field.width() == b.field.width() && a.field.height() == b.field.height() &&
         a.field.texels() == b.field.texels() && a.field.wrap() == b.field.wrap() &&
         a.space == b.space && a.repeats == b.repeats;
}

inline bool sameBake(const study::BakeSpec& a, const study::BakeSpec& b) {
  return a.settings.azimuths == b.settings.azimuths &&
         a.settings.radiusTexels == b.settings.radiusTexels && a.bits == b.bits &&
         a.angleLimit == b.angleLimit;
}

inline bool sameCamera(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.target == b.target && a.up == b.up && a.verticalFov == b.verticalFov &&
         a.width == b.width && a.height == b.height;
}

inline bool sameView(const study::ViewSpec& a, const study::ViewSpec& b) {
  if (a.name != b.name || a.kind.index() != b.kind.index()) return false;
  if (const auto* atlas = std::get_if<study::AtlasSpec>(&a.kind)) {
    return atlas->samplesPerSide == std::get<study::AtlasSpec>(b.kind).samplesPerSide;
  }
  return sameCamera(std::get<Camera>(a.kind), std::get<Camera>(b.kind));
}

inline bool sameMethod(study::MethodSpec a, study::MethodSpec b) {
  // The same file, whatever the way to it. A copy has the defaults of the parameters, too.
  a.file = std::filesystem::canonical(a.file);
  b.file = std::filesystem::canonical(b.file);
  for (const auto& [name, value] : a.parameters) EXPECT_EQ(b.parameters.at(name), value);
  a.parameters = b.parameters;
  return a.label == b.label && study::isSameMethod(a, b);
}

/// All that is measured, to the bit.
inline void expectSame(const study::StudySpec& a, const study::StudySpec& b) {
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.source, b.source);
  EXPECT_TRUE(sameCage(a.cage, b.cage));
  EXPECT_TRUE(sameRelief(a.relief, b.relief));
  EXPECT_TRUE(sameBake(a.bake, b.bake));
  EXPECT_EQ(a.base.subdivisions, b.base.subdivisions);
  EXPECT_EQ(a.base.curvature, b.base.curvature);
  EXPECT_EQ(a.truth.stepTexels, b.truth.stepTexels);
  if (!a.truth.stepTexels) {
    EXPECT_EQ(a.truth.leastTriangles, b.truth.leastTriangles);
  }
  EXPECT_EQ(a.truth.directions, b.truth.directions);
  ASSERT_EQ(a.views.size(), b.views.size());
  for (std::size_t k = 0; k < a.views.size(); ++k) EXPECT_TRUE(sameView(a.views[k], b.views[k]));
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t k = 0; k < a.lights.size(); ++k) {
    EXPECT_EQ(a.lights[k].name, b.lights[k].name);
    EXPECT_EQ(a.lights[k].angles, b.lights[k].angles);
    EXPECT_EQ(a.lights[k].radius, b.lights[k].radius);
  }
  ASSERT_EQ(a.methods.size(), b.methods.size());
  for (std::size_t k = 0; k < a.methods.size(); ++k) {
    EXPECT_TRUE(sameMethod(a.methods[k], b.methods[k])) << a.methods[k].label;
  }
}

}  // namespace gnomon::test
