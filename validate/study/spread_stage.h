#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/mask.h"
#include "compare/counts.h"
#include "study/confidence.h"
#include "study/method_case.h"
#include "study/record.h"
#include "study/run_scene.h"

namespace gnomon {

/// How the errors of all methods are spread over one view: block by block, for their confidence,
/// and by the bins of every axis. Masks are looked at one light at a time.
class SpreadStage {
 public:
  /// @param methods  of the study; they outlive the stage
  SpreadStage(RunScene& scene, std::span<const MethodCase> methods, std::size_t view);

  /// @param masks  of the methods under one light, each light once, in the study's order
  void measure(std::size_t light, const std::vector<std::optional<Mask>>& masks);

  /// Appends confidence, differences and bins of the view, all lights measured.
  void report(StudyRecord& record) const;

 private:
  [[nodiscard]] std::vector<BinRecord> bins() const;

  RunScene& scene_;
  std::span<const MethodCase> methods_;
  std::size_t view_;
  ViewErrors errors_;
  std::vector<std::size_t> answering_;  ///< which methods those of `errors_` are
  /// [method of errors_][axis][bin], lights summed
  std::vector<std::vector<std::vector<Counts>>> counts_;
};

}  // namespace gnomon
