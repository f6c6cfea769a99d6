/* gnomon-method
title = "Height map marched, the ray bent by the frame at each step"
citation = "Chen & Chang 2008"
family = "march"
symbol = "inverted-triangle"
tables = ["height"]

[parameters.stride]
default = 0.25
minimum = 0.01
maximum = 8
about = "distance between samples of the height map, texels of the pixel"
*/

// The ray is straight in space, but the surface's frame turns under it. So each step goes where the
// light is in the tangent space of the place that the ray has come to: L ≈ ℓ_x P_x + ℓ_y P_y + c n
// there, and a step of the length s moves the place by s (ℓ_x, ℓ_y) and the height over the surface
// by s c.
//
// Only the paper's abstract could be read. It does not say where the frame of a distant place comes
// from, nor how long steps are. Here the frame is the pixel's own with its screen derivatives, exact
// within the drawn triangle and extrapolated beyond; a step is `stride` texels of the pixel along e.
// The ray ends where it has left the relief's top for good on a convex surface, and elsewhere with
// the search.

// The frame's change per texel in x and y.
struct FrameChange {
  vec3 normalX, normalY;
  vec3 pxX, pxY;
  vec3 pyX, pyY;
};

// Calls derivatives: before any branch.
FrameChange frameChange() {
  vec2 texelX = dFdx(texel);
  vec2 texelY = dFdy(texel);
  float area = texelX.x * texelY.y - texelX.y * texelY.x;
  // A triangle seen from its edge tells nothing.
  bool known = area * area > 1e-8 * dot(texelX, texelX) * dot(texelY, texelY);
  float share = known ? 1.0 / area : 0.0;
  vec2 x = share * vec2(texelY.y, -texelX.y);  // of a texel along x on the screen
  vec2 y = share * vec2(-texelY.x, texelX.x);
  FrameChange change;
  change.normalX = x.x * dFdx(normal) + x.y * dFdy(normal);
  change.normalY = y.x * dFdx(normal) + y.y * dFdy(normal);
  change.pxX = x.x * dFdx(px) + x.y * dFdy(px);
  change.pxY = y.x * dFdx(px) + y.y * dFdy(px);
  change.pyX = x.x * dFdx(py) + x.y * dFdy(py);
  change.pyY = y.x * dFdx(py) + y.y * dFdy(py);
  return change;
}

// The frame `offset` texels from the pixel.
Pixel frameAt(Pixel pixel, FrameChange change, vec2 offset) {
  Pixel there = pixel;
  there.normal = normalize(normal + offset.x * change.normalX + offset.y * change.normalY);
  there.px += offset.x * change.pxX + offset.y * change.pxY;
  there.py += offset.x * change.pyX + offset.y * change.pyY;
  return there;
}

bool isShadowed(Pixel pixel, LocalLight light) {
  FrameChange change = frameChange();
  float farthest = min(searchRadius, knownDistance(pixel.texel, light.direction));
  bool isConvex = normalCurvature(pixel, light.tangent) >= 0.0;
  float height = pixel.worldPerHeight * heightAt(pixel.texel);  // over the surface, world
  float highest = pixel.worldPerHeight * heightBounds.y;
  vec2 offset = vec2(0.0);                                       // texels
  for (float t = stride; t <= farthest; t += stride) {
    Pixel there = frameAt(pixel, change, offset);
    LocalLight local = makeLocalLight(there, lightDirection);
    // A step: `stride` texels of the pixel, along the tangent plane, in the world.
    float along = stride * light.worldPerTexel;
    offset += along / local.worldPerTexel * local.direction;
    height += along * local.slope;
    if (height > highest && local.slope > 0.0 && isConvex) return false;
    if (pixel.worldPerHeight * heightAt(pixel.texel + offset) > height) return true;
  }
  return false;
}
