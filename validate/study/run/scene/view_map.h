#pragma once

#include "common/vec.h"
#include "render/view.h"
#include "surface/limit_surface.h"

namespace gnomon {

/// How a view shows the surroundings of a surface point.
class ViewMap {
 public:
  /// Both must outlive it.
  ViewMap(const LimitSurface& surface, const RenderView& view);

  [[nodiscard]] bool isAtlas() const { return view_.atlasTiles.x > 0; }
  /// A face's side in samples, in an atlas; 0 in a camera.
  [[nodiscard]] int samplesPerSide() const { return samplesPerSide_; }
  /// The same where neighbouring tiles are no neighbours on the surface: in the atlas of a surface
  /// whose faces form no grid. 0 otherwise.
  [[nodiscard]] int tileSide() const { return tileSide_; }

  /// Columns and rows (downward) a world unit along a tangent: in a camera view by the Jacobian of
  /// the projection at P, in an atlas by solving for the tangent as a P_s + b P_t, since there
  /// columns run along s and rows against t. Not finite where the view shows no such thing.
  [[nodiscard]] Vec2 image(const TangentPoint& point, const Vec3& tangent) const;

 private:
  [[nodiscard]] Vec2 imageInAtlas(const TangentPoint& point, const Vec3& tangent) const;
  [[nodiscard]] Vec2 imageInCamera(const Vec3& position, const Vec3& tangent) const;

  const RenderView& view_;
  glm::dmat4 clip_;
  int samplesPerSide_ = 0;
  int tileSide_ = 0;
};

/// How far from a sample's point a neighbouring sample's can lie in the world, where the surface
/// goes on between them: 3 times the world lengths of a column and of a row together, since
/// rounding to the nearest sample at both ends moves a step by less than 2 of either. Not finite
/// where the surface is seen edge-on.
/// @param image, imageAcross  of two unit tangents at right angles
double sampleSpacing(Vec2 image, Vec2 imageAcross);

}  // namespace gnomon
