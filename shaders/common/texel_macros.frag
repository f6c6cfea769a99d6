// Counts the texels that a pixel reads: one a texelFetch, four a gather, and those that a linear filter
// mixes in one level of a texture: four, or eight of a volume.

uint texelsRead = 0u;

uint linearTexels(sampler2D source) { return 4u; }
uint linearTexels(sampler2DArray source) { return 4u; }
uint linearTexels(sampler3D source) { return 8u; }

#define texelFetch(source, at, level) (++texelsRead, texelFetch(source, at, level))
#define textureGather(source, at) (texelsRead += 4u, textureGather(source, at))
#define texture(source, at) (texelsRead += linearTexels(source), texture(source, at))
#define textureLod(source, at, level) \
  (texelsRead += linearTexels(source), textureLod(source, at, level))
