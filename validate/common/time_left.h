#pragma once

#include <cstddef>
#include <string>

namespace gnomon {

/// The seconds that are left when `done` of `cases` took `elapsed` seconds, and the next one has
/// taken `current` seconds so far: as if each took as long as those did on average.
/// @param done  from 1, below `cases`
double secondsLeft(std::size_t done, std::size_t cases, double elapsed, double current);

/// A duration in its largest sensible unit: "45 s", "12 min", "3.4 h".
std::string durationText(double seconds);

}  // namespace gnomon
