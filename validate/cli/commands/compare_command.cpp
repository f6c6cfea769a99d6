#include "cli/commands/compare_command.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/output.h"
#include "common/files/atomic_file.h"
#include "common/lists.h"
#include "compare/mask_metrics.h"
#include "compare/metric_range.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "report/json/mask_comparison.h"
#include "study/judge/gates.h"

namespace gnomon::cli {
namespace {

constexpr const char* compareExamples = R"(
White is lit, black is shadowed; Gnomon's grey (128) and alpha 0 mean no sample. All pixels count the
same. --max and --min take any metric of the table, shares as 0.02 or "2 %"; a metric that is not
defined fails.

Exit status: 0 all gates hold, 1 a gate failed, 2 usage, 3 the pictures cannot be compared.

Examples:
  gnomon compare mine.exr out/figure8/masks/camera_elevation-24-azimuth-165_truth.png
  gnomon compare mine.png truth.png --binarise 0.5 --roi roi.png --max error_rate=0.02 --min iou=0.9
  gnomon compare layers.exr truth.png --channel shadow.R --invert --json - )";

/// The option that a gate comes from, as typed.
const std::string& optionOf(const study::Gate& gate) {
  return std::get<study::CompareOption>(gate.origin).text;
}

/// @throws UsageError for a limit that no picture of that size could miss, or none could meet
void requireLimit(const study::Gate& gate, const compare::PictureExtent& picture) {
  const compare::MetricRange range = compare::metricRange(gate.metric, picture);
  try {
    compare::requireInRange(*(gate.maximum ? gate.maximum : gate.minimum), gate.metric, range);
    compare::requireMissable(gate.minimum, gate.maximum, gate.metric, range);
  } catch (const InputError& error) {
    throw UsageError(fmt::format("{}: {}", optionOf(gate), error.what()));
  }
}

/// @param option  "--max" or "--min"
study::Gate gateOf(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string metric = text.substr(0, equals);
  const auto& names = compare::maskMetricNames();
  if (equals == std::string::npos) {
    throw UsageError(fmt::format("{} {}: METRIC=VALUE expected", option, text));
  }
  if (!contains(names, metric)) {
    throw UsageError(fmt::format("{} {}: no metric \"{}\", one of {} expected", option, text,
                                 metric, fmt::join(names, ", ")));
  }
  constexpr double any = std::numeric_limits<double>::max();
  const auto value =
      compare::limitOfText(text.substr(equals + 1), compare::metricRange(metric, {any, any}));
  if (!value || !std::isfinite(*value)) {
    throw UsageError(
        fmt::format("{} {}: a number expected after =, or of a share a percentage", option, text));
  }
  study::Gate gate;
  gate.metric = metric;
  (option == "--max" ? gate.maximum : gate.minimum) = value;
  gate.origin = study::CompareOption{option + " " + text};
  requireLimit(gate, {any, any});
  return gate;
}

std::vector<study::Gate> gatesOf(const CompareRequest& request) {
  std::vector<study::Gate> gates;
  for (const std::string& text : request.maxima) gates.push_back(gateOf("--max", text));
  for (const std::string& text : request.minima) gates.push_back(gateOf("--min", text));
  const bool judgesNothing =
      !gates.empty() && std::all_of(gates.begin(), gates.end(), [](const study::Gate& gate) {
        return compare::isOfTruthAlone(gate.metric);
      });
  if (judgesNothing) {
    throw UsageError(fmt::format("{}: {} is the truth's alone, a gate on the candidate expected",
                                 optionOf(gates.front()), gates.front().metric));
  }
  return gates;
}

/// @throws UsageError for a limit that no picture of the truth's size could miss, or none could
///   meet
std::vector<study::Judgement> judged(const std::vector<study::Gate>& gates, const Mask& truth,
                                     const std::vector<compare::Metric>& metrics) {
  const compare::PictureExtent picture{std::hypot(truth.width, truth.height),
                                       static_cast<double>(truth.size())};
  std::vector<study::Judgement> judgements;
  for (const study::Gate& gate : gates) {
    requireLimit(gate, picture);
    judgements.push_back(study::judge(gate, compare::metricNamed(metrics, gate.metric)));
  }
  return judgements;
}

report::MaskFileRecord recordOf(const std::filesystem::path& file,
                                const image::MaskPicture& picture) {
  return {file.string(), picture.mask, picture.binarised};
}

compare::ComparedMasks common(const CompareRequest& request, const Mask& candidate,
                              const Mask& truth, const std::optional<image::MaskPicture>& roi) {
  try {
    return compare::commonPixels(candidate, truth, roi ? &roi->mask : nullptr);
  } catch (const InputError& error) {
    const std::string with = request.roi ? fmt::format(" with {}", request.roi->string()) : "";
    throw InputError(fmt::format("{} against {}{}: {}", request.candidate.string(),
                                 request.truth.string(), with, error.what()));
  }
}

void write(const CompareRequest& request, const report::MaskComparison& comparison,
           const compare::ComparedMasks& masks) {
  if (request.difference) {
    image::writePng(*request.difference, image::differenceImage(masks.candidate, masks.truth));
  }
  if (!request.json.empty() && request.json != "-") {
    writeTextAtomically(request.json, report::maskComparisonJson(comparison));
  }
  if (request.json == "-") {
    printUnchanged(report::maskComparisonJson(comparison));
  } else {
    printText(report::maskComparisonTable(comparison, coloursWanted()));
  }
}

}  // namespace

CLI::App* addCompareCommand(CLI::App& app, CompareRequest& request) {
  CLI::App* command = app.add_subcommand("compare", "Compare two mask pictures from any renderer");
  command->add_option("CANDIDATE", request.candidate, "Mask to judge: EXR, PNG, TIFF, …")
      ->required()
      ->type_name("FILE");
  command->add_option("TRUTH", request.truth, "Mask to compare it with")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--roi", request.roi, "Compare only the pixels that are white in this picture")
      ->type_name("FILE");
  const auto addGates = [&](const char* name, std::vector<std::string>& gates, const char* about) {
    command->add_option(name, gates, about)
        ->type_name("METRIC=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  addGates("--max", request.maxima, "Fail if a metric is larger; may be repeated");
  addGates("--min", request.minima, "Fail if a metric is smaller; may be repeated");
  command
      ->add_option("--binarise", request.threshold,
                   "For soft masks: values of at least VALUE are lit, all others are shadowed")
      ->type_name("VALUE");
  command->add_option("--channel", request.candidateChannel, "Channel of the candidate, by name")
      ->type_name("NAME");
  command->add_option("--truth-channel", request.truthChannel, "Channel of the truth, by name")
      ->type_name("NAME");
  command->add_flag("--invert", request.inverted, "White means shadowed in the candidate");
  command->add_flag("--flip", request.upward,
                    "The first row of the candidate is the lowest row of the picture");
  command
      ->add_option("--json", request.json,
                   "Write the result as JSON; - writes it to standard output instead of the table")
      ->type_name("FILE");
  command
      ->add_option("--difference", request.difference,
                   "Write the signed difference: orange is false shadow, blue is false light")
      ->type_name("FILE.png");
  command->footer(compareExamples);
  return command;
}

ExitStatus compareMasks(const CompareRequest& request) {
  const std::vector<study::Gate> gates = gatesOf(request);
  if (request.threshold && !(*request.threshold > 0 && *request.threshold < 1)) {
    throw UsageError(
        fmt::format("--binarise {}: a value between 0 and 1 expected", *request.threshold));
  }
  if (request.difference && request.difference->extension() != ".png") {
    throw UsageError(fmt::format("--difference {}: a name that ends in .png expected",
                                 request.difference->string()));
  }
  const image::MaskPicture candidate = image::readMaskPicture(
      request.candidate,
      {request.candidateChannel, request.threshold, request.inverted, request.upward});
  const image::MaskPicture truth = image::readMaskPicture(
      request.truth, {.channel = request.truthChannel, .threshold = request.threshold});
  std::optional<image::MaskPicture> roi;
  if (request.roi)
    roi = image::readMaskPicture(*request.roi, {.channel = {}, .threshold = request.threshold});
  const compare::ComparedMasks masks = common(request, candidate.mask, truth.mask, roi);
  report::MaskComparison comparison{recordOf(request.candidate, candidate),
                                    recordOf(request.truth, truth)};
  if (roi) comparison.roi = recordOf(*request.roi, *roi);
  comparison.command = request.command;
  comparison.width = truth.mask.width;
  comparison.height = truth.mask.height;
  comparison.withoutSample = masks.withoutSample;
  comparison.outsideRoi = masks.outsideRoi;
  comparison.counts = compare::countSamples(masks.candidate, masks.truth);
  comparison.metrics = compare::maskMetrics(masks.candidate, masks.truth);
  comparison.judgements = judged(gates, truth.mask, comparison.metrics);
  write(request, comparison, masks);
  return comparison.passed() ? ExitStatus::pass : ExitStatus::thresholdFailed;
}

}  // namespace gnomon::cli
