#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/confidence_interval.h"
#include "report/tables/table.h"
#include "study/record/record.h"

namespace gnomon::report {

/// Texts about intervals of error rates, the same in every kind of report.

/// The views that have intervals, in the record's order.
std::vector<std::string> confidenceViews(const study::StudyRecord& record);

/// The methods of a view from the lowest error rate to the highest, all lights together; equal ones
/// keep the record's order.
std::vector<study::ConfidenceRecord> rankedIn(const study::StudyRecord& record,
                                              const std::string& view);

/// The verdict on the best method of a view, as sentences: "A is better than B by 1.06 % of the
/// samples (95 % interval 0.75 to 1.32)", where B is the next method that is distinguishable from
/// A; then the methods that answer alike, those that are not distinguishable, and those whose
/// difference from A has no interval. Empty where there is nothing to compare.
std::string verdictText(const study::StudyRecord& record, const std::string& view);

/// Of a view's methods to the best, all lights together, from the lowest error to the highest.
std::vector<study::DifferenceRecord> differencesToBest(const study::StudyRecord& record,
                                                       const std::string& view);

/// "The intervals come from 175 to 195 blocks of 54 × 54 samples."; empty of a view without any.
std::string blocksText(const study::StudyRecord& record, const std::string& view);

/// What the errors of a view are shares of, its blocks, and the truth's uncertainty.
std::string confidenceNote(const study::StudyRecord& record, const std::string& view);

/// Texts of an error budget, the same in every kind of report.

/// Of an error that remains when all causes are corrected, "left: seam".
/// @param rest  as BudgetRest::name
std::string restName(std::string_view rest);

/// What the figures mean, of how many lights and blocks they are, and the truth's uncertainty.
/// @param isSoft  whether errors are shares of light (study::isSoft)
std::string budgetNote(const study::BudgetRecord& budget, bool isSoft = false);

/// How much of a method's error is assigned to another cause in the other order.
std::string orderText(const study::BudgetRecord& budget, bool isSoft = false);

/// The lights of a record's budgets, each once: all together first.
std::vector<std::string> budgetLights(const study::StudyRecord& record);

/// The budgets of one light, in the order of the record.
std::vector<study::BudgetRecord> budgetsOf(const study::StudyRecord& record,
                                           const std::string& light);

/// Both ends as percent with two decimals: "−1.20 to 50.00"; "–" where there is no interval.
std::string intervalText(const std::optional<compare::Interval>& interval);

/// One end likewise: "−1.20"; "–" for none.
std::string intervalEndText(std::optional<double> end);

/// What an interval means, in one sentence: the same in every kind of report.
constexpr std::string_view intervalMeaning =
    "In 95 of 100 cases a 95 % interval contains the mean over all random draws of the bumps, on "
    "the same surface, in the same view, under the same lights.";

/// An end, or nothing.
std::optional<double> lowOf(const std::optional<compare::Interval>& interval);
std::optional<double> highOf(const std::optional<compare::Interval>& interval);

/// "83 texels: a ray to the light …".
std::string radiusText(const study::RadiusRecord& radius);

/// The truth's own error, of the view and light where it is largest: in the mean, at 99.9 % of the
/// samples of a soft light, and whether coarse facets darken or brighten. Empty where it was not
/// measured.
std::string truthErrorText(const study::TruthRecord& truth);

/// A flip rate in percent with three significant digits, since it may be far below a hundredth:
/// "0.0831"; "–" for none.
std::string flipText(std::optional<double> rate);

/// A step with as many digits as it needs, at most four: "0.25".
std::string stepText(double texels);

/// One method's error by cause, forward and backward: every share with its interval, and ≈ behind
/// one that is not distinguishable from none; then what is left, and all of the error.
Table budgetTable(const study::BudgetRecord& budget);

/// All budgets for programs, one row a method, view, light and part of its error: "total", the
/// causes, "distant" and "other". What is not a cause has one share, written as forward and
/// backward alike.
Table budgetPartsTable(const study::StudyRecord& record);

/// The methods of a view from the lowest error rate to the highest, each with its interval, and how
/// much worse than the best it is, with the interval of that; signs as differenceSign has them.
/// Without rows if the record has no intervals.
Table confidenceTable(const study::StudyRecord& record, const std::string& view);

}  // namespace gnomon::report
