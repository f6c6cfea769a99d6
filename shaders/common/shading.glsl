// The normal that a method's picture is shaded with. One rule for all: where it is turned from the
// light the point is dark in the picture, whatever the shadow test says (attached shadow).

// Of the bump-mapped mesh: N' from the exact gradient of the bilinear relief (Blinn 1978). Of
// displaced geometry: the drawn triangle's own. Of a method that declares normal = "own": what its
// function of this name says.
#ifndef OWN_NORMAL
vec3 shadingNormal(Pixel pixel) {
#ifdef MESH_DISPLACED
  return facetNormal(pixel);
#else
  return bumpedNormal(pixel, heightGradient(pixel.texel));
#endif
}
#endif

// N' · L ≤ 0
bool isTurnedAway(Pixel pixel) { return !(dot(shadingNormal(pixel), lightDirection) > 0.0); }
