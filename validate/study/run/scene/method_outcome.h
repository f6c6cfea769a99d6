#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/mask.h"
#include "compare/confidence_interval.h"
#include "compare/counts.h"
#include "compare/shadow_length.h"
#include "study/run/scene/base_case.h"
#include "study/run/scene/method_case.h"
#include "study/run/scene/run_scene.h"
#include "study/run/scene/view_samples.h"

namespace gnomon::study {

/// The result of comparing one answer with the truth: under a light with a disc its shares; lengths
/// and boundaries are those of the masks that shares are cut to.
struct AnswerOutcome {
  std::vector<compare::Counts> regions;  ///< in the order of judgedRegions
  compare::ShadowLengths lengths;
  std::vector<compare::Metric> boundaries;
  std::vector<compare::Metric> shares;  ///< empty under a point light
};

/// The result of comparing one method with the truth, in one view under one light.
struct MethodOutcome {
  AnswerOutcome drawn;
  AnswerOutcome test;
  std::vector<std::vector<compare::Counts>>
      bins;                     ///< of the drawn answer: [axis][bin], as sampleAxes
  compare::BlockErrors blocks;  ///< likewise, in the cells of the view's tiling
  double otherChartShare = 0;   ///< as of render::MethodAnswers
};

/// A method to be compared, by the mesh that it draws.
struct ComparedMethod {
  const BaseCase* base;
  std::function<const CaseAnswers&()> answers;  ///< draws them if need be; called on this thread
};

/// Compares masks with the truth of one view under one light. Methods on one mesh, and in an atlas
/// those on meshes that show the same samples, are compared together: much of a comparison is the
/// truth's alone. Of methods that answer alike one is compared.
class OutcomeStage {
 public:
  /// @param cellSide  of the view's tiling, samples
  OutcomeStage(RunScene& scene, std::size_t view, std::size_t light, int cellSide)
      : scene_(scene), view_(view), light_(light), cellSide_(cellSide) {}

  /// @returns one a method
  std::vector<MethodOutcome> compare(std::span<const ComparedMethod> methods);

 private:
  /// What all methods on one mesh share.
  struct Shared {
    std::shared_ptr<const compare::LightField> field;
    SampleBins bins;
  };
  /// @param meanwhile  called on this thread
  [[nodiscard]] Shared makeShared(const BaseCase& base, const std::function<void()>& meanwhile);
  [[nodiscard]] std::vector<MethodOutcome> compareOnOne(
      const BaseCase& base, const std::vector<const CaseAnswers*>& answers,
      const Shared& shared) const;

  RunScene& scene_;
  std::size_t view_;
  std::size_t light_;
  int cellSide_;
};

}  // namespace gnomon::study
