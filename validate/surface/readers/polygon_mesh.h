#pragma once

#include <string>
#include <vector>

#include "common/vec.h"
#include "surface/cage/cage.h"
#include "surface/cage/topology.h"

// Shared by the sources of this component; no other component includes it.

namespace gnomon::surface {

/// What `PolygonMesh::faceUvs` holds at every corner of a face without texture coordinates.
constexpr int noUv = -1;

/// Faces of any size, as a file has them. Faces follow each other in `faceVertices` and, corner by
/// corner, in `faceUvs`.
struct PolygonMesh {
  std::vector<Vec3> positions;
  std::vector<int> faceSizes;
  std::vector<int> faceVertices;
  std::vector<Vec2> uvs;
  std::vector<int> faceUvs;
  std::vector<Crease> creases;
  std::vector<SharpVertex> sharpVertices;
  std::vector<std::string> partNames;  ///< as in Cage
  std::vector<int> faceParts;
};

/// The mesh as a control cage. A Catmull-Clark cage with any face that is not a quadrilateral is
/// refined once, so that every face of the result is one; the limit surface is the same, and
/// texture coordinates are halved linearly. Faces without texture coordinates get some without
/// area, so that no frame exists on them.
/// @throws InputError naming the part: no face, or none with texture coordinates; for Loop's scheme
///   a face that is no triangle; and all that
///   `makeTopologyRefiner` refuses
Cage toCage(PolygonMesh mesh, const PartNames& names, SubdivisionScheme scheme);

}  // namespace gnomon::surface
