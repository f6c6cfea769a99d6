#pragma once

#include <span>

#include "report/tables/table.h"
#include "study/record/gate.h"

namespace gnomon::report {

/// Gates, each with its verdict, what it judges, the value and the limit; references also with
/// their committed value and the change.
/// @param judgements  one or more, of one origin
Table gateTable(std::span<const study::Judgement> judgements);

}  // namespace gnomon::report
