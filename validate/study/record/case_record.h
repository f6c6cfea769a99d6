#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace gnomon::study {

/// A file that a run was made of.
struct InputRecord {
  enum class Kind { study, mesh, image, shader, mask };
  Kind kind = Kind::study;
  /// Relative to the run's folder; of a shader that comes with the program as `shaders/…`.
  std::string file;
  std::string sha256;  ///< of its bytes, 64 lowercase hexadecimal digits
};

/// What is needed to run the very case again.
struct CaseRecord {
  std::string file;      ///< name of the study's copy in the run's folder
  toml::table settings;  ///< what that copy holds
  std::vector<InputRecord> inputs = {};
};

}  // namespace gnomon::study
