#include "cli/commands/compare_command.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "cli/output.h"
#include "common/files/atomic_file.h"
#include "common/lists.h"
#include "compare/answer_metrics.h"
#include "compare/metric.h"
#include "export/export_json.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "report/json/mask_comparison.h"
#include "study/judge/gates.h"
#include "study/spec/sections/method_section.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

using compare::MetricKind;

constexpr const char* compareExamples = R"(
White is lit, black is shadowed; Gnomon's grey (128) and alpha 0 mean no sample. All pixels count the
same. --max and --min take any metric of the table, shares as 0.02 or "2 %"; a metric that is not
defined fails. Of two folders, the pictures of one name are compared, whatever their formats; a name
that only one of them holds is an error. The ending `_truth` of a name is ignored.

A truth of more than 8 bits with values between black and white holds V, the share of a light's disc
that is seen: error_rate is then the mean of |V - V_truth|, and boundaries are those of both cut at
V < 0.5. --binarise 0.5 compares these two cuts alone.

Exit status: 0 all gates hold, 1 a gate failed, 2 usage, 3 the pictures cannot be compared.

Examples:
  gnomon compare mine.exr out/figure8/masks/camera_elevation-24-azimuth-165_truth.png
  gnomon compare mine.png truth.png --binarise 0.5 --roi roi.png --max error_rate=0.02 --min iou=0.9
  gnomon compare mine/ out/figure8/export/masks/ --max error_rate=0.05
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
  if (equals == std::string::npos) {
    throw UsageError(fmt::format("{} {}: METRIC=VALUE expected", option, text));
  }
  const std::string name = text.substr(0, equals);
  const std::vector<compare::MetricId> known =
      compare::metricsOfKinds({MetricKind::rate, MetricKind::boundary, MetricKind::share});
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](compare::MetricId id) { return id.name() == name; });
  if (found == known.end()) {
    throw UsageError(fmt::format("{} {}: no metric \"{}\", one of {} expected", option, text, name,
                                 fmt::join(compare::namesOf(known), ", ")));
  }
  constexpr double any = std::numeric_limits<double>::max();
  const auto value =
      compare::limitOfText(text.substr(equals + 1), compare::metricRange(*found, {any, any}));
  if (!value || !std::isfinite(*value)) {
    throw UsageError(
        fmt::format("{} {}: a number expected after =, or of a share a percentage", option, text));
  }
  study::Gate gate;
  gate.metric = *found;
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
                                 optionOf(gates.front()), gates.front().metric.name()));
  }
  return gates;
}

/// One of the metrics; without a value where only shares have it.
compare::Metric foundMetric(const std::vector<compare::Metric>& metrics, compare::MetricId id) {
  if (id.kind() == MetricKind::share && metrics.back().id.kind() != MetricKind::share) {
    return {id, std::nullopt, "measured of pictures that hold shares only"};
  }
  return compare::metricNamed(metrics, id);
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
    judgements.push_back(study::judge(gate, foundMetric(metrics, gate.metric)));
  }
  return judgements;
}

report::MaskFileRecord recordOf(const std::filesystem::path& file,
                                const image::MaskPicture& picture) {
  return {file.string(), picture.mask, picture.binarised};
}

/// The share that --uncertainty gives, if it does.
std::optional<double> givenUncertainty(const CompareRequest& request) {
  if (request.uncertainty.empty()) return std::nullopt;
  const auto share = compare::limitOfText(request.uncertainty, {});
  if (!share || !(*share >= 0 && *share <= 1)) {
    throw UsageError(fmt::format("--uncertainty {}: a share expected, as 0.001 or \"0.1 %\"",
                                 request.uncertainty));
  }
  return share;
}

/// What every picture of a command is compared with.
struct Comparing {
  const CompareRequest& request;
  std::vector<study::Gate> gates;
  std::optional<double> uncertainty;      ///< given by the command
  std::optional<image::MaskPicture> roi;  ///< likewise
};

Comparing comparingFor(const CompareRequest& request) {
  Comparing with{request, gatesOf(request), givenUncertainty(request), {}};
  if (request.threshold && !(*request.threshold > 0 && *request.threshold < 1)) {
    throw UsageError(
        fmt::format("--binarise {}: a value between 0 and 1 expected", *request.threshold));
  }
  if (request.difference && request.difference->extension() != ".png") {
    throw UsageError(fmt::format("--difference {}: a name that ends in .png expected",
                                 request.difference->string()));
  }
  if (request.roi) {
    with.roi =
        image::readMaskPicture(*request.roi, {.channel = {}, .threshold = request.threshold});
  }
  return with;
}

/// Two pictures as masks, or as maps of visibility with the masks that these are cut to.
struct Pictures {
  image::MaskPicture candidate, truth;
  Visibility candidateShares = {}, truthShares = {};

  [[nodiscard]] bool areSoft() const { return truthShares.size() > 0; }
};

/// Maps, unless a threshold is given, where the truth holds shares. Against a mask a candidate's
/// values between are refused: they may be smoothed edges.
Pictures readPictures(const CompareRequest& request, const fs::path& candidateFile,
                      const fs::path& truthFile) {
  const image::MaskReading candidate{request.candidateChannel, request.threshold, request.inverted,
                                     request.upward};
  const image::MaskReading truth{.channel = request.truthChannel, .threshold = request.threshold};
  const bool areSoft = !request.threshold && image::holdsShares(truthFile, truth);
  if (!areSoft) {
    return {image::readMaskPicture(candidateFile, candidate),
            image::readMaskPicture(truthFile, truth)};
  }
  Visibility ours = image::readSharePicture(candidateFile, candidate);
  Visibility theirs = image::readSharePicture(truthFile, truth);
  return {{cutInHalf(ours)}, {cutInHalf(theirs)}, std::move(ours), std::move(theirs)};
}

compare::ComparedMasks common(const Comparing& with, const fs::path& candidate,
                              const fs::path& truth, const Pictures& pictures) {
  const Mask* roi = with.roi ? &with.roi->mask : nullptr;
  try {
    return pictures.areSoft()
               ? compare::commonPixels(pictures.candidateShares, pictures.truthShares, roi)
               : compare::commonPixels(pictures.candidate.mask, pictures.truth.mask, roi);
  } catch (const InputError& error) {
    const std::string inRoi =
        with.request.roi ? fmt::format(" with {}", with.request.roi->string()) : "";
    throw InputError(fmt::format("{} against {}{}: {}", candidate.string(), truth.string(), inRoi,
                                 error.what()));
  }
}

/// Two pictures, and what was found of them.
struct Compared {
  report::MaskComparison comparison;
  compare::ComparedMasks masks;
};

Compared compareTwo(const Comparing& with, const fs::path& candidateFile,
                    const fs::path& truthFile) {
  const CompareRequest& request = with.request;
  const Pictures pictures = readPictures(request, candidateFile, truthFile);
  // Before the record: GCC 12 destroys parts of an aggregate twice whose other parts throw.
  compare::ComparedMasks masks = common(with, candidateFile, truthFile, pictures);
  const auto& [candidate, truth, candidateShares, truthShares] = pictures;
  report::MaskComparison comparison{recordOf(candidateFile, candidate), recordOf(truthFile, truth)};
  comparison.isSoft = pictures.areSoft();
  if (with.roi) comparison.roi = recordOf(*request.roi, *with.roi);
  comparison.command = request.command;
  comparison.width = truth.mask.width;
  comparison.height = truth.mask.height;
  comparison.withoutSample = masks.withoutSample;
  comparison.outsideRoi = masks.outsideRoi;
  comparison.counts = compare::countsOf(masks);
  comparison.metrics = compare::maskMetrics(masks);
  comparison.confidence = compare::maskConfidence({&masks, 1});
  comparison.uncertainty =
      with.uncertainty ? with.uncertainty : exporting::exportedUncertainty(truthFile);
  if (auto notice = compare::invertedNotice(masks)) {
    comparison.notices.push_back(std::move(*notice));
  }
  comparison.judgements = judged(with.gates, truth.mask, comparison.metrics);
  return {std::move(comparison), std::move(masks)};
}

/// @throws InputError naming what only one of the folders holds
void requireSameNames(const CompareRequest& request,
                      const std::map<std::string, fs::path>& candidates,
                      const std::map<std::string, fs::path>& truths) {
  const auto missing = [](const auto& in, const auto& of) {
    std::vector<std::string> names;
    for (const auto& [name, file] : of) {
      if (!in.contains(name)) names.push_back(file.filename().string());
    }
    return names;
  };
  const std::vector<std::string> extra = missing(truths, candidates);
  const std::vector<std::string> lacking = missing(candidates, truths);
  if (truths.empty()) {
    throw InputError(
        fmt::format("{}: no mask found, at least one expected", request.truth.string()));
  }
  if (extra.empty() && lacking.empty()) return;
  const auto part = [](const fs::path& folder, const char* verb, const auto& names) {
    return names.empty() ? ""
                         : fmt::format("{} {} {}; ", folder.string(), verb, fmt::join(names, ", "));
  };
  throw InputError(fmt::format("{}{}the same names in both expected",
                               part(request.candidate, "lacks", lacking),
                               part(request.truth, "lacks", extra)));
}

/// Writes and prints what was found, as the options say.
template <typename Found>
void write(const CompareRequest& request, const Found& found, std::string (*jsonOf)(const Found&),
           std::string (*tableOf)(const Found&, bool)) {
  if (request.json == "-") {
    printUnchanged(jsonOf(found));
    return;
  }
  if (!request.json.empty()) writeTextAtomically(request.json, jsonOf(found));
  printText(tableOf(found, coloursWanted()));
}

ExitStatus statusOf(bool passed) {
  return passed ? ExitStatus::pass : ExitStatus::thresholdFailed;
}

/// @throws UsageError for a result that would replace a picture that is compared, what says how
///   uncertain it is, or the other result
void requireOwnResults(const CompareRequest& request, const std::vector<fs::path>& pictures) {
  std::vector<fs::path> inputs = pictures;
  if (request.roi) inputs.push_back(*request.roi);
  for (const fs::path& picture : pictures) {
    for (const fs::path& index : exporting::exportIndices(picture)) inputs.push_back(index);
  }
  if (!request.json.empty() && request.json != "-") {
    requireNoInput("--json", request.json, inputs);
    if (request.difference) {
      requireOther("--json", request.json, "--difference", *request.difference);
    }
  }
  if (request.difference) requireNoInput("--difference", *request.difference, inputs);
}

ExitStatus compareFolders(const CompareRequest& request) {
  if (request.difference) {
    throw UsageError("--difference: two pictures expected, two folders found");
  }
  const Comparing with = comparingFor(request);
  const std::map<std::string, fs::path> candidates = study::masksIn(request.candidate);
  const std::map<std::string, fs::path> truths = study::masksIn(request.truth);
  requireSameNames(request, candidates, truths);
  std::vector<fs::path> pictures;
  for (const auto* folder : {&candidates, &truths}) {
    for (const auto& [name, file] : *folder) pictures.push_back(file);
  }
  requireOwnResults(request, pictures);
  report::MaskFolders folders{request.candidate.string(), request.truth.string(), request.command};
  std::vector<compare::ComparedMasks> masks;
  for (const auto& [name, truth] : truths) {
    Compared found = compareTwo(with, candidates.at(name), truth);
    folders.pairs.push_back({name, std::move(found.comparison)});
    masks.push_back(std::move(found.masks));
  }
  folders.confidence = compare::maskConfidence(masks);
  write(request, folders, &report::maskFoldersJson, &report::maskFoldersTable);
  return statusOf(folders.passed());
}

}  // namespace

CLI::App* addCompareCommand(CLI::App& app, CompareRequest& request) {
  CLI::App* command = app.add_subcommand(
      "compare", "Compare two mask pictures, or two folders of them, from any renderer");
  command
      ->add_option("CANDIDATE", request.candidate,
                   "Mask to judge: EXR, PNG, TIFF, …; or a folder of masks")
      ->required()
      ->type_name("FILE");
  command->add_option("TRUTH", request.truth, "Mask, or folder of masks, to compare it with")
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
      ->add_option(
          "--uncertainty", request.uncertainty,
          "Uncertainty of the truth, a share as 0.001 or \"0.1 %\"; by default the one that "
          "export.json states for an exported mask")
      ->type_name("SHARE");
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
  std::error_code failure;  // then it is no folder
  const bool isFolder = fs::is_directory(request.candidate, failure);
  if (isFolder != fs::is_directory(request.truth, failure)) {
    const fs::path& folder = isFolder ? request.candidate : request.truth;
    throw InputError(
        fmt::format("{}: a folder found, two pictures or two folders expected", folder.string()));
  }
  if (isFolder) return compareFolders(request);
  requireOwnResults(request, {request.candidate, request.truth});
  const Compared found = compareTwo(comparingFor(request), request.candidate, request.truth);
  if (request.difference) {
    const compare::ComparedMasks& masks = found.masks;
    if (found.comparison.isSoft) {
      image::writePng(*request.difference,
                      image::shareDifferenceImage(masks.candidateShares, masks.truthShares));
    } else {
      image::writePng(*request.difference, image::differenceImage(masks.candidate, masks.truth));
    }
  }
  write(request, found.comparison, &report::maskComparisonJson, &report::maskComparisonTable);
  return statusOf(found.comparison.passed());
}

}  // namespace gnomon::cli
