#pragma once

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "study/spec/study_file.h"
#include "support/columns_study.h"
#include "support/error_messages.h"
#include "support/replaced.h"
#include "support/temporary_folder.h"

namespace gnomon::study {

/// A study to change one thing of.
inline const std::string plainStudy = test::planeStudy("plain") + R"(
[[view]]
type = "camera"
width = 200
height = 100
eye = [0, 0, 90]

[[view]]
type = "atlas"
samples = 8

[[light]]
azimuth = 20
elevation = 30

[[method]]
name = "max-forsyth"

[[method]]
name = "onoue-2004"
label = "ours"
)";

/// Reads studies that are written for the test.
class StudyFile : public TemporaryFolder {
 protected:
  StudySpec read(const std::string& text, const StudyOptions& options = {}) {
    std::ofstream(file("plain.toml"), std::ios::binary) << text;
    return readStudy(file("plain.toml"), options);
  }
  StudySpec readWith(std::vector<std::string> overrides) {
    return read(plainStudy, {std::move(overrides), {}, false});
  }
  /// The error's message, without the folder.
  template <typename ErrorType = InputError>
  std::string failure(const std::string& text, const StudyOptions& options = {}) {
    return withoutFolder(messageOf<ErrorType>([&] { (void)read(text, options); }));
  }
  std::string failureWith(std::vector<std::string> overrides) {
    return failure(plainStudy, {std::move(overrides), {}, false});
  }
  std::string failureOf(const std::string& from, const std::string& to) {
    return failure(test::replaced(plainStudy, from, to));
  }
};

}  // namespace gnomon::study
