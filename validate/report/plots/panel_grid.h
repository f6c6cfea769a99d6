#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/plots/plot_sheet.h"

namespace gnomon::report {

/// Panels of one size in rows, with the legend of the first beside them at the right: the frame of
/// a sheet that has a panel a method.
class PanelGrid {
 public:
  /// Three panels a row, on a phone one.
  /// @param legends  that the legend must hold; none for no legend
  PanelGrid(std::size_t panels, const std::vector<std::string>& legends, PlotPlace place);

  /// Of the page, pixels.
  [[nodiscard]] int width() const { return isNarrow_ ? 380 : 1000; }
  [[nodiscard]] int height() const { return static_cast<int>(rows_) * panelHeight + margin; }
  /// Commands before the first panel. The panels of the lowest row name the axis.
  [[nodiscard]] std::string opening(const std::string& axis) const;
  /// Commands before the panel of an index.
  [[nodiscard]] std::string panel(std::size_t index) const;

 private:
  static constexpr int panelHeight = 220;
  static constexpr int margin = 36;

  bool isNarrow_;
  std::size_t panels_, columns_, rows_;
  double right_;  ///< where the panels end, as a share of the page
};

}  // namespace gnomon::report
