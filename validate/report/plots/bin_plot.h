#pragma once

#include <string_view>
#include <vector>

#include "report/plots/method_styles.h"
#include "report/plots/plot_sheet.h"
#include "study/record/record.h"

namespace gnomon::report {

/// "elevation of the light, degrees", or the name of an axis that is not known here.
std::string axisTitle(std::string_view axis);

/// The axes of a record that have bins, and the views that have several on an axis, in the record's
/// order: of one bin, as of the curvature of a plane, there is no curve to draw.
std::vector<std::string> binAxes(const study::StudyRecord& record);
std::vector<std::string> binViews(const study::StudyRecord& record, std::string_view axis);

/// The methods' error rates in the bins of one axis and view, all lights together: one curve a
/// method, each bin as wide as it is, those without an end as wide as their neighbours, over each
/// its share of the samples (of the first method's); the truth's uncertainty as a grey band. Bins
/// whose edges grow by one factor stand on a logarithmic axis. A method without samples in a bin
/// has a gap there.
/// @throws InternalError for a number that is not finite
PlotSheet binPlot(const study::StudyRecord& record, std::string_view axis, std::string_view view,
                  const MethodStyles& styles, PlotPlace place = PlotPlace::paper);

}  // namespace gnomon::report
