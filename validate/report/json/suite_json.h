#pragma once

#include <string>

#include "study/spec/suite/drawn_suite.h"

namespace gnomon::report {

/// The manifest of a drawn suite: its name, seed and split, its one SHA-256, and every file with
/// its own; of a study also that of its scene, and what was drawn. docs/suite.md names the keys.
std::string suiteManifest(const study::DrawnSuite& suite);

}  // namespace gnomon::report
