#pragma once

#include <opensubdiv/far/topologyRefiner.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/vec.h"
#include "surface/cage/cage.h"

// Shared by the sources of this component; no other component includes it.

namespace gnomon::surface {

/// Time and memory for the faces about a vertex grow as the cube of their number: half a second
/// here.
constexpr int mostVertexFaces = 256;

/// Faces of any size, the input of makeTopologyRefiner. Faces follow each other in `faceVertices`
/// and, corner by corner, in `faceUvs`.
struct Polygons {
  std::span<const Vec3> positions;
  std::span<const int> faceSizes;
  std::span<const int> faceVertices;
  std::span<const Vec2> uvs;
  std::span<const int> faceUvs;
  std::span<const Crease> creases;
  std::span<const SharpVertex> sharpVertices;
  CageBorder border = CageBorder::edgesAndCorners;
  SubdivisionScheme scheme = SubdivisionScheme::catmullClark;
};

/// What an error message calls the parts of a mesh.
struct PartNames {
  std::string source = "cage";
  int firstFace = 0;           ///< what faces, their vertices and uvs are counted from: 1 in an OBJ
  std::vector<int> faceLines;  ///< line of each face in the file; empty where there is no file
  std::vector<int> creaseLines;
  std::vector<int> sharpVertexLines;

  [[nodiscard]] std::string face(std::size_t index) const;
  [[nodiscard]] std::string crease(std::size_t index) const;
  [[nodiscard]] std::string sharpVertex(std::size_t index) const;
};

/// Checks the polygons and makes the OpenSubdiv refiner of their scheme.
/// @param withUvs  adds the texture coordinates as face-varying channel 0, linear everywhere
/// @throws InputError naming the part: an index out of range, a coordinate that is not finite or
///   beyond 1e12, a vertex of more than 256 faces, a face with fewer than three corners or with a
///   repeated vertex, an edge that more than two faces share or that two traverse in the same
///   direction, a vertex whose faces form more than one fan, a crease where no edge is, a sharpness
///   that is negative or not finite
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> makeTopologyRefiner(const Polygons& polygons,
                                                                      const PartNames& names,
                                                                      bool withUvs);

}  // namespace gnomon::surface
