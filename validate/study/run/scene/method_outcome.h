#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "common/mask.h"
#include "compare/block_errors.h"
#include "compare/counts.h"
#include "compare/rates.h"
#include "compare/shadow_length.h"
#include "render/passes/method_pass.h"
#include "study/run/scene/base_case.h"
#include "study/run/scene/run_scene.h"
#include "study/run/scene/sample_axes.h"

namespace gnomon {

/// The regions that results are reported for, in order: "all", those of `reportedRegions`, "seam".
const std::vector<std::string_view>& outcomeRegions();

/// The result of comparing one answer with the truth.
struct AnswerOutcome {
  std::vector<Counts> regions;  ///< in the order of outcomeRegions
  ShadowLengths lengths;
  std::vector<Metric> boundaries;
};

/// The result of comparing one method with the truth, in one view under one light.
struct MethodOutcome {
  AnswerOutcome drawn;
  AnswerOutcome test;
  std::vector<std::vector<Counts>> bins;  ///< of the drawn answer: [axis][bin], as sampleAxes
  BlockErrors blocks;                     ///< likewise, in the cells of the view's tiling
};

/// Compares masks with the truth of one view under one light. Data that all methods on one mesh
/// share are computed once, when the first of them is compared.
class OutcomeStage {
 public:
  /// @param cellSide  of the view's tiling, samples
  OutcomeStage(RunScene& scene, std::size_t view, std::size_t light, int cellSide)
      : scene_(scene), view_(view), light_(light), cellSide_(cellSide) {}

  /// @param base       the mesh that the method draws
  /// @param answersOf  gives the method's answers; called once, on this thread
  MethodOutcome compare(const BaseCase& base,
                        const std::function<const MethodAnswers&()>& answersOf);

 private:
  struct Shared {
    const BaseCase* base;
    LightField field;
    SampleBins bins;
  };
  [[nodiscard]] const Shared* findShared(const BaseCase& base) const;
  const Shared& makeShared(const BaseCase& base, LightField field);

  RunScene& scene_;
  std::size_t view_;
  std::size_t light_;
  int cellSide_;
  std::vector<Shared> shared_;
};

}  // namespace gnomon
