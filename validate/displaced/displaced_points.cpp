#include "displaced/displaced_points.h"

#include <algorithm>
#include <vector>

#include "common/counted_progress.h"
#include "common/parallel.h"
#include "surface/limit_face.h"
#include "surface/texel_frame.h"

namespace gnomon::displaced {
namespace {

/// Some rows of a face's grid: what one thread computes at once.
struct RowBlock {
  std::size_t face, firstRow, endRow;
};

/// All rows of all faces, so cut that even a single face keeps every thread busy.
std::vector<RowBlock> rowBlocks(const surface::FaceGrids& grids) {
  constexpr std::size_t mostRows = 32;
  std::vector<RowBlock> blocks;
  for (std::size_t face = 0; face < grids.faces().size(); ++face) {
    const auto rows = static_cast<std::size_t>(grids.faces()[face].rows);
    for (std::size_t row = 0; row < rows; row += mostRows) {
      blocks.push_back({face, row, std::min(row + mostRows, rows)});
    }
  }
  return blocks;
}

}  // namespace

void displaceGrids(const surface::LimitSurface& surface, const relief::Relief& relief,
                   const surface::FaceGrids& grids, const PointSink& sink,
                   const Progress& progress) {
  const Vec2 texelsPerUv = relief.texelsPerUv();
  const std::vector<RowBlock> blocks = rowBlocks(grids);
  CountedProgress done(progress, blocks.size());
  parallelFor(0, blocks.size(), [&](std::size_t b) {
    const RowBlock& block = blocks[b];
    const surface::FaceGrid& grid = grids.faces()[block.face];
    const std::vector<double>& s = grids.sLines(grid);
    const std::vector<double>& t = grids.tLines(grid);
    const surface::LimitFace face(surface, static_cast<int>(block.face),
                                  (block.endRow - block.firstRow) * s.size());
    std::vector<surface::TangentPoint> points(s.size());
    std::vector<Vec3> positions(s.size());
    for (std::size_t row = block.firstRow; row < block.endRow; ++row) {
      face.row(t[row], s, points);
      std::transform(points.begin(), points.end(), positions.begin(),
                     [&](const surface::TangentPoint& point) {
                       return relief::displaced(relief, surface::texelFrame(point, texelsPerUv));
                     });
      sink(grid.vertex(0, row), positions);
    }
    done.advance();
  });
}

}  // namespace gnomon::displaced
