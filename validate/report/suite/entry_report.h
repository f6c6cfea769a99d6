#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/page/html_page.h"
#include "report/tables/table.h"

#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

/// What `gnomon rank` says of one entry, on the terminal and at the top of its page.

/// Families that a scene belongs to, by its name, beside the surface and the relief of its title.
using SceneFamilies = std::map<std::string, std::vector<std::string>>;

struct EntryReport {
  std::string entry;    ///< its label
  std::string place;    ///< "mine: place 7 of 54 (5 to 9 in 95 % of the resamples of the scenes)"
  std::string against;  ///< how many methods are better, worse and not distinguishable
  Table neighbours;     ///< the ranking around it, with the verdict on each beside it
  Table families;       ///< its mean and place in each family, and the best of the others there
  Table worst;          ///< its worst scenes, and who has the least error there
};

/// @param entry  a label of statistics.entries
EntryReport entryReport(const study::SuiteStatistics& statistics, const std::string& entry,
                        const SceneFamilies& families);

/// The same as a section of a page.
PageSection entrySection(const EntryReport& report);

/// The names of the ten scenes with the entry's largest errors, the worst first.
std::vector<std::string> worstScenes(const study::SuiteStatistics& statistics,
                                     const std::string& entry);

}  // namespace gnomon::report
