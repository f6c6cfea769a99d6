#pragma once

#include <opensubdiv/far/topologyRefiner.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/vec.h"

namespace gnomon::surface {

/// A semi-sharp edge between two vertices of a cage, OpenSubdiv's sharpness: 0 smooth, 10 sharp.
struct Crease {
  std::array<int, 2> vertices;
  double sharpness;
};

/// A semi-sharp vertex.
struct SharpVertex {
  int vertex;
  double sharpness;
};

/// What the limit surface does at the border of an open cage.
enum class CageBorder {
  edgesAndCorners,  ///< it interpolates border edges as curves, and corner vertices
  support,          ///< the outermost faces only support the inner ones and have no limit surface
};

/// Which surface a cage stands for.
enum class SubdivisionScheme {
  catmullClark,  ///< of quadrilaterals (Catmull & Clark 1978): bicubic B-splines where regular
  loop,          ///< of triangles (Loop 1987): quartic box splines where regular
  none,          ///< the polygons as they are: see polygon_cage.h
};

/// The faces with a limit surface form a regular grid: face `row * columns + column`, s along the
/// columns, t along the rows. uv is affine over the whole grid: uv = (column + s, row + t) /
/// (columns, rows).
struct GridChart {
  int columns;
  int rows;
};

/// What was joined of a mesh file whose vertices lie at the same places: see toCage.
struct JoinedVertices {
  int vertices = 0;    ///< for which another one stands
  int apartEdges = 0;  ///< edges with ends in common that stay apart: more than two faces meet
                       ///< there, or two that run along it in the same direction
};

/// More parts are too many to report the shadows of each on each.
constexpr std::size_t mostParts = 8;

/// A control cage with face-varying texture coordinates: n = 4 corners a face for Catmull-Clark, 3
/// for Loop. Corner k of face f is `faceVertices[n f + k]` with uv `uvs[faceUvs[n f + k]]`. Corners
/// run counter-clockwise seen from outside; (s, t) of a quadrilateral is (0,0), (1,0), (1,1), (0,1)
/// at corners 0 to 3. uv is interpolated bilinearly inside a quadrilateral and linearly inside a
/// triangle, as a GPU does on a mesh of the same faces.
struct Cage {
  std::vector<Vec3> positions;
  std::vector<int> faceVertices;
  std::vector<Vec2> uvs;
  std::vector<int> faceUvs;
  std::vector<Crease> creases;
  std::vector<SharpVertex> sharpVertices;
  CageBorder border = CageBorder::edgesAndCorners;
  SubdivisionScheme scheme = SubdivisionScheme::catmullClark;
  std::optional<GridChart> grid;
  /// What its parts are called, and the part of every face; both empty for a cage of one part.
  std::vector<std::string> partNames;
  std::vector<int> faceParts;
  JoinedVertices joined;
  /// Of scheme `none` only, which makePolygonCage fills: the direction in which each position is
  /// displaced; normals of shading, which corner k of face f has as `normals[faceNormals[4 f +
  /// k]]`; and how many faces, one after the other, a polygon became (3 for triangles; 1 for
  /// quadrilaterals, and where it differs). Middles of sides and of polygons have means of the
  /// corners' unit vectors, so that those interpolate as the corners' do.
  std::vector<Vec3> directions;
  std::vector<Vec3> normals;
  std::vector<int> faceNormals;
  int facesPerPolygon = 1;

  /// n: corners of a face.
  [[nodiscard]] std::size_t faceSize() const { return scheme == SubdivisionScheme::loop ? 3 : 4; }
  [[nodiscard]] int faceCount() const { return static_cast<int>(faceVertices.size() / faceSize()); }
  /// The part of every face of the limit surface of a cage that has parts, all of whose faces have
  /// one: three faces for each triangle of a Loop cage.
  [[nodiscard]] std::vector<int> limitFaceParts() const;
};

// Shared by the sources of this component; no other component includes it.

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
  std::span<const Crease> creases = {};
  std::span<const SharpVertex> sharpVertices = {};
  CageBorder border = CageBorder::edgesAndCorners;
  SubdivisionScheme scheme = SubdivisionScheme::catmullClark;
  std::span<const Vec3> normals = {};     ///< scheme `none` alone reads them
  std::span<const int> faceNormals = {};  ///< of each corner, below 0 where it has none; or empty
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

/// Checks what all schemes ask of polygons.
/// @throws InputError naming the part: an index out of range, a coordinate that is not finite or
///   beyond 1e12, a face with fewer than three corners or with a repeated vertex
void requirePolygons(const Polygons& polygons, const PartNames& names);

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
