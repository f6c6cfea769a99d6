#pragma once

#include <filesystem>
#include <vector>

#include "report/text/html.h"
#include "study/judge/ranking.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The section of the places where methods err most: of each method `worstWindows` of 64 pixels a
/// side, three at most, in the view and under the light where its error is largest, each beside the
/// truth. A method that draws another mesh than the truth's picture is shown as masks, at its own
/// samples. The methods are the `highlights`. Under a light with a disc an error is |ΔV|. Nothing
/// without an error.
/// @param folder  the run's, where its pictures are
/// @throws InputError for a picture that cannot be read
Html worstSection(const study::StudyRecord& record, const std::vector<study::RankedMethod>& ranked,
                  const std::filesystem::path& folder);

}  // namespace gnomon::report
