#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "render/passes.h"
#include "study/base_case.h"
#include "study/record.h"
#include "study/run_writer.h"
#include "study/stage_clock.h"
#include "study/study_file.h"
#include "truth/micro_scene.h"

namespace gnomon {

/// What a pass needs to draw a base mesh under one of the study's lights.
Drawing drawingOf(const StudySpec& study, const GpuHeights& heights, const BaseCase& base,
                  std::size_t light);

/// One method's answer, to be shown in a panel.
struct PanelMask {
  const BaseCase* base;
  const Mask* mask;  ///< null where the method has no answer in this view
};

/// Makes the pictures of a study's panels and hands them to the writer. Files are named
/// `images/VIEW_LIGHT_METHOD.png`, the method being `truth` or `displaced` for those.
class PanelPictures {
 public:
  PanelPictures(const StudySpec& study, const GpuHeights& heights,
                const std::filesystem::path& shaders, RunWriter& writer, StageClock& clock);

  /// The displaced surface by its own rays, for every camera view and light.
  void drawDisplaced(const MicroMesh& mesh, const MicroScene& scene);

  /// One view under one light: every method's shading and mask, the truth's, and the signed
  /// differences.
  /// @param standard  the study's own base
  /// @param masks     one a method, as the study lists them
  PanelRecord draw(std::size_t view, std::size_t light, const BaseCase& standard,
                   std::span<const PanelMask> masks);

 private:
  /// `images/VIEW_LIGHT_NAME.png`, or in another folder.
  [[nodiscard]] std::string path(const char* folder, std::size_t view, std::size_t light,
                                 const std::string& name) const;
  void shadeMask(std::size_t view, std::size_t light, const BaseCase& base, const Mask& mask,
                 const std::string& name);

  const StudySpec& study_;
  const GpuHeights& heights_;
  ShadePass shade_;
  RunWriter& writer_;
  StageClock& clock_;
  std::vector<std::string> viewFiles_;
  std::vector<std::string> lightFiles_;
  std::vector<std::string> methodFiles_;
};

}  // namespace gnomon
