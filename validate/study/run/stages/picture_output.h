#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <string>

#include "study/run/scene/run_scene.h"
#include "study/run/stages/encoding_queue.h"
#include "study/run/stages/run_writer.h"
#include "study/spec/file_names.h"

namespace gnomon::study {

/// What all pictures of a run share: what they show, and where they go.
struct PictureOutput {
  PictureOutput(RunScene& of, RunWriter& to)
      : scene(of), writer(to), queue(of.clock), names(caseNames(of.study)) {}

  RunScene& scene;
  RunWriter& writer;
  EncodingQueue queue;
  CaseNames names;

  /// `FOLDER/VIEW_LIGHT_NAME.png`.
  [[nodiscard]] std::string path(const char* folder, std::size_t view, std::size_t light,
                                 const std::string& name) const {
    return fmt::format("{}/{}_{}_{}.png", folder, names.views[view], names.lights[light], name);
  }
};

}  // namespace gnomon::study
