#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "study/record/budget_record.h"

namespace gnomon {

/// A part of an error as it is drawn: its number in the key, its colour by that number.
struct BudgetPart {
  std::string name;
  std::string
      colour;  ///< #rrggbb; those of a key are kept apart by the common colour vision deficiencies
};

/// The parts of all budgets of a key: the causes in the order in which they first appear, then what
/// is left.
std::vector<BudgetPart> budgetParts(std::span<const BudgetRecord> budgets);

/// A piece of a bar: a part's share, drawn from one value to another.
struct BudgetBox {
  std::size_t part = 0;  ///< index among the parts
  double share = 0;
  double from = 0, to = 0;  ///< from < to, unless there is no share
};

/// The bar of one order: shares above 0 stand to the right of zero one after the other, those below
/// it to its left.
/// @param way  forward or backward
std::vector<BudgetBox> budgetBoxes(const BudgetRecord& budget, const std::vector<BudgetPart>& parts,
                                   BudgetShare BudgetCause::*way);

/// The bars, as SVG: two a budget, forward and backward. Shares above 0 stand to the right of the
/// zero line one after the other, those below it to its left; a mark stands where both together
/// end, at the method's error. All bars have one scale.
/// @param budgets  of one light
std::string budgetBars(std::span<const BudgetRecord> budgets, const std::vector<BudgetPart>& parts);

/// The key of the colours, as an HTML list.
std::string budgetKey(const std::vector<BudgetPart>& parts);

}  // namespace gnomon
