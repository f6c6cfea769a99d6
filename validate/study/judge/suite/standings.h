#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/judge/ranking.h"

namespace gnomon::study {

/// Committed errors, to rank a shader among all methods without measuring these again.

/// What an error is, by a name that changes with it: the share of the samples, all views and lights
/// together, on which the picture as drawn is wrong.
constexpr std::string_view errorDefinition = "drawn-1";

/// The control that every joined scene measures again: its error has to be the committed one to the
/// last bit, or truth, samples or comparison are others.
constexpr const char* control = "unshadowed";

/// The errors of all entries on the test scenes of a suite.
struct Standings {
  std::string suite;   ///< "suite-1"
  std::string seed;    ///< that drew the scenes
  int scenes = 0;      ///< 1 to this were measured
  std::string sha256;  ///< of all of them, as DrawnSuite has it
  /// One a scene, by name: each entry's error, parts and truth's uncertainty, without intervals.
  std::vector<StudyMeans> means;
};

/// `results` beside the program's shaders, where the committed errors are.
std::filesystem::path standingsFolder();

/// Reads `suites.csv`, whose rows say of each suite how its scenes were drawn, and
/// `SUITE/suite.csv`, as `gnomon gather` writes it.
/// @throws InputError for a suite that the first does not have, a file that cannot be read or is
///   damaged (naming the line), and errors of another definition
Standings readStandings(const std::filesystem::path& folder, const std::string& suite);

/// The measured scenes with all committed entries and, after these, the measured ones.
/// @param measured  scenes in which the control and the entries were measured
/// @param entries   labels, none of them a committed one
///   An entry may lack scenes, as one that needs a camera does: then it has no rank.
/// @throws InputError naming the scene where it has no committed errors, or the control's error,
/// its
///   parts or the truth's uncertainty are not the committed ones; for an entry without an error on
///   any scene
std::vector<StudyMeans> joined(const Standings& standings, std::span<const StudyMeans> measured,
                               const std::vector<std::string>& entries);

}  // namespace gnomon::study
