#pragma once

#include <string>
#include <vector>

#include "report/tables/table.h"
#include "study/judge/suite/chosen_settings.h"

namespace gnomon::report {

/// The settings that were tried on train: a row a value, with its mean error over the scenes and a
/// mark for the value that was chosen.
Table suiteSettingsTable(const study::SuiteMethods& methods,
                         const std::vector<study::TriedSetting>& tried);

/// The chosen methods as the file that `gnomon suite --settings` reads, with what they were chosen
/// from as a comment.
/// @param scenes  "suite-1, 200 scenes"
std::string chosenSettingsText(const study::SuiteMethods& methods,
                               const std::vector<study::TriedSetting>& tried,
                               const std::string& scenes);

}  // namespace gnomon::report
