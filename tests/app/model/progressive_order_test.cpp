#include "model/progressive_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "common/error.h"

namespace gnomon::app {
namespace {

/// A disc of samples, background about it.
surface::SampleGrid disc(int width, int height) {
  surface::SampleGrid grid{width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double x = 2.0 * column / width - 1;
      const double y = 2.0 * row / height - 1;
      grid.samples.push_back({x * x + y * y < 0.9 ? 0 : -1, 0.5F, 0.5F});
    }
  }
  return grid;
}

TEST(ProgressiveOrder, HasEverySampleOnce) {
  for (const auto& [width, height] : {std::pair{64, 64}, {97, 41}, {5, 3}, {1, 1}, {16, 130}}) {
    for (const int coarsest : {1, 4, 16}) {
      const surface::SampleGrid grid = disc(width, height);
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < grid.samples.size(); ++i) {
        if (grid.samples[i].face >= 0) expected.push_back(i);
      }
      ProgressiveOrder order = progressiveOrder(grid, coarsest);
      EXPECT_EQ(order.levelEnds.back(), order.samples.size());
      std::sort(order.samples.begin(), order.samples.end());
      EXPECT_EQ(order.samples, expected);
    }
  }
}

TEST(ProgressiveOrder, RisesInResolutionLevelByLevel) {
  const surface::SampleGrid grid = disc(90, 70);
  const ProgressiveOrder order = progressiveOrder(grid);
  ASSERT_EQ(order.levelEnds.size(), 5U);
  std::size_t begin = 0;
  int stride = 16;
  for (const std::size_t end : order.levelEnds) {
    ASSERT_GT(end, begin);
    for (std::size_t k = begin; k < end; ++k) {
      const int column = static_cast<int>(order.samples[k]) % grid.width;
      const int row = static_cast<int>(order.samples[k]) / grid.width;
      EXPECT_TRUE(column % stride == 0 && row % stride == 0);
      if (stride < 16) {
        EXPECT_FALSE(column % (2 * stride) == 0 && row % (2 * stride) == 0);
      }
    }
    begin = end;
    stride /= 2;
  }
}

/// Sixteen in a row, what a packet of rays takes, lie close together: in at most three tiles beside
/// each other. Row by row they would span 64 columns.
TEST(ProgressiveOrder, KeepsNeighboursTogether) {
  surface::SampleGrid grid{
      256, 256,
      std::vector<surface::SurfaceSample>(256 * 256, surface::SurfaceSample{0, 0.5F, 0.5F})};
  const ProgressiveOrder order = progressiveOrder(grid);
  const std::size_t begin = order.levelEnds[3];  // the last level, stride 1
  double width = 0;
  std::size_t packets = 0;
  for (std::size_t k = begin; k + 16 <= order.samples.size(); k += 16) {
    int least = grid.width;
    int most = 0;
    for (std::size_t i = k; i < k + 16; ++i) {
      least = std::min(least, static_cast<int>(order.samples[i]) % grid.width);
      most = std::max(most, static_cast<int>(order.samples[i]) % grid.width);
    }
    width += most - least + 1;
    ++packets;
  }
  EXPECT_LT(width / static_cast<double>(packets), 14);
}

TEST(ProgressiveOrder, RefusesAStrideThatIsNoPowerOfTwo) {
  EXPECT_THROW(progressiveOrder(disc(8, 8), 12), InternalError);
  EXPECT_THROW(progressiveOrder(disc(8, 8), 0), InternalError);
}

Mask randomTruth(const surface::SampleGrid& grid) {
  std::mt19937 random(4);
  Mask truth{grid.width, grid.height, {}};
  for (const surface::SurfaceSample& sample : grid.samples) {
    truth.samples.push_back(!sample.isOnSurface() ? Shade::none
                            : random() % 2 == 0   ? Shade::lit
                                                  : Shade::shadowed);
  }
  return truth;
}

Mask previewMask(const surface::SampleGrid& grid, const Mask& truth,
                 const std::vector<std::uint8_t>& traced) {
  return std::get<Mask>(preview(grid, truth, traced));
}

std::vector<std::uint8_t> tracedUpTo(const ProgressiveOrder& order, std::size_t end,
                                     std::size_t count) {
  std::vector<std::uint8_t> traced(count, 0);
  for (std::size_t k = 0; k < end; ++k) traced[order.samples[k]] = 1;
  return traced;
}

TEST(PreviewMask, IsTheTruthWhereTracedAndAllOfItInTheEnd) {
  const surface::SampleGrid grid = disc(70, 50);
  const Mask truth = randomTruth(grid);
  const ProgressiveOrder order = progressiveOrder(grid);
  for (const std::size_t end : {order.levelEnds[1], order.levelEnds[3] + 17}) {
    const auto traced = tracedUpTo(order, end, truth.size());
    const Mask preview = previewMask(grid, truth, traced);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (traced[i] != 0 || grid.samples[i].face < 0) {
        EXPECT_EQ(preview.samples[i], truth.samples[i]);
      }
    }
  }
  EXPECT_EQ(previewMask(grid, truth, std::vector<std::uint8_t>(truth.size(), 1)).samples,
            truth.samples);
  const Mask nothing = previewMask(grid, truth, std::vector<std::uint8_t>(truth.size(), 0));
  for (const Shade shade : nothing.samples) EXPECT_EQ(shade, Shade::none);
}

/// With one level whole, each sample has the answer of the nearest node of its stride, by search
/// over all of them.
TEST(PreviewMask, OfAWholeLevelIsTheNearestTracedSample) {
  const surface::SampleGrid grid{
      61, 47, std::vector<surface::SurfaceSample>(61 * 47, surface::SurfaceSample{0, 0.5F, 0.5F})};
  const Mask truth = randomTruth(grid);
  const ProgressiveOrder order = progressiveOrder(grid);
  const auto traced = tracedUpTo(order, order.levelEnds[2], truth.size());  // stride 4
  const Mask preview = previewMask(grid, truth, traced);
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      int least = 1 << 20;
      for (std::size_t i = 0; i < traced.size(); ++i) {
        const int x = static_cast<int>(i) % grid.width - column;
        const int y = static_cast<int>(i) / grid.width - row;
        if (traced[i] != 0) least = std::min(least, x * x + y * y);
      }
      bool found = false;
      const Shade shown = preview.samples[static_cast<std::size_t>(row * grid.width + column)];
      for (std::size_t i = 0; i < traced.size(); ++i) {
        const int x = static_cast<int>(i) % grid.width - column;
        const int y = static_cast<int>(i) / grid.width - row;
        found = found || (traced[i] != 0 && x * x + y * y == least && truth.samples[i] == shown);
      }
      EXPECT_TRUE(found) << column << " " << row;
    }
  }
}

/// Shares are chosen as answers of a mask are: those that every mask cut from them has.
TEST(Preview, OfSharesIsThatOfTheMasksThatTheyAreCutTo) {
  const surface::SampleGrid grid = disc(70, 50);
  std::mt19937 random(7);
  Visibility truth{grid.width, grid.height, {}};
  for (const surface::SurfaceSample& sample : grid.samples) {
    truth.shares.push_back(sample.isOnSurface() ? static_cast<float>(random() % 257) / 256
                                                : noSample);
  }
  const ProgressiveOrder order = progressiveOrder(grid);
  const auto traced = tracedUpTo(order, order.levelEnds[2] + 31, truth.size());
  const auto shown = std::get<Visibility>(preview(grid, truth, traced));
  EXPECT_EQ(cutInHalf(shown).samples, previewMask(grid, cutInHalf(truth), traced).samples);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (traced[i] != 0) {
      EXPECT_EQ(shown.shares[i], truth.shares[i]);
    }
  }
}

}  // namespace
}  // namespace gnomon::app
