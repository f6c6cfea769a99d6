#pragma once

#include <string>

#include "report/plots/plot_sheet.h"
#include "report/text/html.h"

namespace gnomon::report {

/// gnuplot's SVG of a sheet for a page, as an element of the page: its colours are the page's
/// properties, "var(--plot-ink)", its size follows from the page, its shapes are those of
/// `plotSymbols`, and each value that a reader can point at is a group of class "value" with its
/// words as title. Curves of a method are groups with its property as `data-method`. Elements and
/// attributes that this knows nothing of are left out.
/// @throws InternalError for a document that is no SVG
Html pageSvg(const std::string& svg, const PlotSheet& sheet);

/// The shapes of points that gnuplot's SVG defines, once for a page: "#gpPt6" and so on.
Html plotSymbols(const std::string& svg);

/// CSS properties of the frame's and the families' colours, for white pages and dark ones.
Html plotProperties();

/// What a figure's style sets: its methods' colours, `--plot-method0:var(--plot-flat)`, or that of
/// the methods that are not highlighted.
std::string methodProperties(const PlotSheet& sheet);

}  // namespace gnomon::report
