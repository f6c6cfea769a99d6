#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "study/record/cases.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The row of results whose reference fails by the most, with its pictures.
struct WorstCase {
  std::string study, method, view, light;
  double margin = 0;             ///< below 0: by how much its worst reference fails
  std::filesystem::path before;  ///< signed differences; empty where none was kept
  std::filesystem::path after;
  std::filesystem::path change;  ///< likewise empty
  std::string note;              ///< why there is no picture of before
};

/// Of all rows that have pictures (referencePictures) the one that fails by the most, of metrics
/// that are shares; lengths count only where no share fails. None without such a row.
/// @param out  the folder that holds the records' folders
std::optional<WorstCase> worstCase(std::span<const study::StudyRecord> records,
                                   const std::filesystem::path& out);

/// A check as the Markdown of a build server's job summary: the outcome, every gate that does not
/// hold with its value, limit and shader, all problems, the worst case as three mosaics
/// beside the names of the pictures, and the command that accepts the change.
/// @param accept  that command; empty where there are no references
/// @throws InputError where a picture cannot be read
std::string jobSummary(std::span<const study::CheckRecord> checks,
                       const std::optional<WorstCase>& worst, const std::string& accept);

/// A signed difference (image::DifferenceColours) as lines of coloured squares, for a page that
/// shows no pictures of its own: 🟧 false shadow, 🟦 false light, ⬜ both lit, ⬛ both
/// shadowed, 🟫 no samples. A square stands for a block of pixels of which it is the most
/// frequent kind; but where an eighth of the block's samples is wrong, the more frequent error.
/// @param columns  squares a line, at least 1; no more than the picture has pixels
/// @throws InputError naming the file for a picture with any other colour, and as readGreyPicture
std::string mosaicOf(const std::filesystem::path& difference, int columns);

/// A check as GitHub's workflow commands, one a line, that mark files in a pull request: of a gate
/// the user's own shader that it judges (faultPlace), of all else the study's:
/// `::error file=F,line=N,title=T::MESSAGE` for each gate that does not hold and each problem, then
/// `::notice …` for each limit that could be tightened. Nothing for what passed or was skipped.
/// What `xmlText` refuses becomes U+FFFD; in properties `%`, CR, LF, `:` and `,` are escaped, in
/// messages `%`, CR and LF, as GitHub's "Workflow commands" say. A problem's line is that of its
/// message, where it opens with `FILE:LINE:`, FILE the study or a user's own shader.
std::string githubAnnotations(std::span<const study::CheckRecord> checks);

/// Text of any number of lines in which GitHub's runner finds no command. It takes a line that
/// begins with `::`, behind spaces too, and whatever follows `##[` anywhere in a line: names that
/// stand there get a space inside these signs.
std::string withoutWorkflowCommands(std::string_view text);

/// A check as JUnit XML: a test suite a study, a test case a gate and a problem. A gate that failed
/// has a `failure`; one without a number to judge, and whatever kept a study from being judged, an
/// `error`; a gate that was left out is `skipped`. The counts in `testsuites` and `testsuite` are
/// those of the elements below; their `time` is the seconds that the runs took. Every failure and
/// error holds the command that reproduces it. Characters that XML 1.0 does not have become U+FFFD.
std::string junitXml(std::span<const study::CheckRecord> checks);

}  // namespace gnomon::report
