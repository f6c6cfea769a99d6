// Counts the texture instructions that a pixel runs: each call below, once. A gather counts as one.

uint fetchesCounted = 0u;

#define texelFetch(source, at, level) (++fetchesCounted, texelFetch(source, at, level))
#define textureLod(source, at, level) (++fetchesCounted, textureLod(source, at, level))
#define textureGather(source, at) (++fetchesCounted, textureGather(source, at))
#define texture(source, at) (++fetchesCounted, texture(source, at))
