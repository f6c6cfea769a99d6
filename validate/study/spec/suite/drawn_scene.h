#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "study/spec/suite/suite_file.h"

namespace gnomon::study {

enum class SuiteSplit { train, test };
std::string splitName(SuiteSplit split);

/// One scene of a suite.
struct DrawnScene {
  std::string name;  ///< "suite-1-test-0017"
  /// The study without methods: [study], [surface], [relief], [bake], [base], [truth], [[view]],
  /// [[light]].
  toml::table study;
  std::vector<std::string>
      files;          ///< meshes and images that it reads, relative to the folder above the suite's
  toml::table facts;  ///< what was drawn, for tables: surface, relief, kappa_height …
  int tries = 1;      ///< scenes that were drawn until one kept all limits
};

/// Draws one scene. It has a stream of its own: xoshiro256** from the SHA-256 of the text
///   SUITE \n SPLIT \n SEED \n NUMBER \n
/// so that it does not depend on how many scenes are drawn, and train and test have nothing in
/// common. Surface and relief are drawn once, by their weights; all else is drawn until every limit
/// of the file is kept, so that limits do not change how often a family comes.
/// @param seed    any text
/// @param number  from 1
/// @throws InputError naming the file where no scene keeps the limits in `suite.tries` tries
DrawnScene drawScene(const SuiteSpec& suite, SuiteSplit split, const std::string& seed, int number);

}  // namespace gnomon::study
