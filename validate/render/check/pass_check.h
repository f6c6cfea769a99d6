#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "render/passes/method_pass.h"

namespace gnomon::render {

/// The kinds of passes, each of which a driver may draw wrongly.
enum class PassKind {
  cameraSamples,
  atlasSamples,
  tables,
  filteredTables,
  angles,
  ellipses,
  bakes,
  filteredBakes,
  facets,
  texture,
  lightDepth,
  shadowVolumes,
  ownPasses,
  ownLightPasses,
  cameraPasses,
  shares,
  pictures,
};

/// The kind's name in messages: "shadow volumes".
std::string_view passName(PassKind kind);

/// The kinds that a method's answers are made by, apart from the samples of the views.
/// @param isSoft  whether any of its lights has a radius
std::vector<PassKind> passesOf(const Method& method, TableFilter filter, bool isSoft = false);

/// Draws a floor and a box that floats over it (known_scene.h) with the shaders, by a pass of this
/// kind, and compares every pixel with rays and with the maps' values:
///   cameraSamples   what two cameras see: the nearest face, and the place on it
///   atlasSamples    the faces side by side: every sample's face, s and t, exactly
///   tables          on the atlas, heights, horizons and distances of random zeros and ones, in 8,
///                   16 and 32 bits; and both answers, by bumped normals
///   filteredTables  the same by the GPU's filter
///   angles          the same of horizon angles, with their lookup maps
///   ellipses        the same of ellipses
///   bakes           the map and its negative, baked by a method, read with their coarser levels
///   filteredBakes   the same by the GPU's filter
///   facets          which of the sides are turned from the light
///   texture         a random value a texel, drawn in the texture's plane and read again
///   lightDepth      the box's shadow on the floor, from the depth that the light sees
///   shadowVolumes   the same, and from a camera inside the shadow, from counts
///   ownPasses       as texture, in two channels of a method's own pass, through a filter
///   ownLightPasses  as lightDepth, from a method's own pass from the light, through a filter
///   cameraPasses    the camera's depth, and a method's own pass in its picture: where a pixel is
///   shares          on the atlas, a known share of a disc; and what the bumped normals leave of it
///   pictures        a chequered mask: dark where it is shadowed, brighter elsewhere
/// Pixels beside an edge of anything are left out.
/// @return  empty if all pixels are right, else how many are not: "37 of 5124 pixels are wrong"
/// @throws InputError for a shader that does not compile
std::string passFault(PassKind kind, const std::filesystem::path& shaders);

}  // namespace gnomon::render
