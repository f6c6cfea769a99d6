#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/text/html.h"
#include "study/judge/ranking.h"
#include "study/record/record.h"

namespace gnomon::report {

/// How a study's page opens: its title, the question, the answer in a sentence or two, whether it
/// passed, and the pictures of `openingFigures`.
Html openingHtml(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked);

/// "it is wrong at 1.2 % of the samples", or of a soft light "its share of the light is off by 1.2
/// %".
Html errorHtml(bool isSoft, std::optional<double> errorRate);

/// A picture of the opening.
struct OpeningFigure {
  std::string method;  ///< a label, or "truth"
  std::string role;    ///< "flat horizon map", "claimed and best"
};

/// At most four, of the first panel, in this order; a method of two roles stands once, one without
/// a picture there does not:
///   flat     the method that costs are compared with, costReference
///   claimed  the first method that a claim is about and that is neither flat nor the control
///            `unshadowed`
///   best     the first of the ranking that is not the control
///   truth
std::vector<OpeningFigure> openingFigures(const study::StudyRecord& record,
                                          const std::vector<study::RankedMethod>& ranked);

}  // namespace gnomon::report
