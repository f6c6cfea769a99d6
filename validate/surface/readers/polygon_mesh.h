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
  PartNames names;  ///< for messages
  std::vector<Vec3> positions;
  std::vector<int> faceSizes;
  std::vector<int> faceVertices;
  std::vector<Vec2> uvs;
  std::vector<int> faceUvs;
  std::vector<Crease> creases;
  std::vector<SharpVertex> sharpVertices;
  std::vector<std::string> faceNames;  ///< the part that each face is of; empty in a file of none
};

/// The mesh as a control cage.
/// - Vertices in the very same place become one where faces meet there: an edge of one face and an
///   edge of another that have the same ends and run in opposite directions are one edge, unless
///   more edges lie there. An edge without length joins nothing. Writers cut a mesh apart at seams
///   of its texture or at sharp edges, and its surface continues there. Numbers stay the file's:
///   the first of joined vertices stands for all.
/// - Faces without texture coordinates get some without area, so that no frame exists on them.
/// - Parts are numbered in the order of their first faces. A mesh with one part, or more than
///   `mostParts`, has none to tell apart.
/// - A Catmull-Clark cage with any face that is not a quadrilateral is refined once, so that every
///   face of the result is one; the limit surface is the same, and texture coordinates are halved
///   linearly.
/// @throws InputError naming the part: no face, or none with texture coordinates; for Loop's scheme
///   a face that is no triangle; and all that `makeTopologyRefiner` refuses
Cage toCage(PolygonMesh mesh, SubdivisionScheme scheme);

}  // namespace gnomon::surface
