#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "horizon/search_radius.h"
#include "study/spec/sections/bake_section.h"
#include "study/spec/sections/base_section.h"
#include "study/spec/sections/claim_section.h"
#include "study/spec/sections/ladder_spec.h"
#include "study/spec/sections/light_section.h"
#include "study/spec/sections/method_section.h"
#include "study/spec/sections/relief_section.h"
#include "study/spec/sections/surface_section.h"
#include "study/spec/sections/threshold_section.h"
#include "study/spec/sections/truth_section.h"
#include "study/spec/sections/view_section.h"
#include "study/spec/study_parts.h"
#include "study/spec/study_text.h"

namespace gnomon::study {

/// A study as its TOML file describes it, checked. Each section's structure and keys are in the
/// section's own header.

/// `[study]`
struct StudyHeader {
  std::string name = {}, title = {}, source = {};
  std::string suite = {};  ///< the population of scenes that it was drawn from; empty for none
  bool ranked = true;      ///< counts in a ranking over the studies of a run
  bool quick = false;      ///< the quick form, see StudyOptions
  int frames = 25;         ///< timed of every method, at most; 0: none, as in the quick form
};

inline StudyKeys keysOf(StudyHeader& header) {
  using enum Enters;
  return {
      studyKey("name", &header.name,
               "of the study and its folder: letters, digits, `-`, `_` and `.`", {}, required,
               nothing),
      studyKey("title", &header.title, "of its report", {}, required, nothing),
      studyKey("source", &header.source, "the figure or question that it stands for", {}, required,
               nothing),
      studyKey("suite", &header.suite,
               "the suite whose scenes it was drawn from: a run of 20 or more scenes of one suite "
               "ends with statistics over scenes",
               {}, "none", nothing),
      studyKey("ranked", &header.ranked, "whether it counts in the ranking over a run's studies",
               {}, {}, nothing),
      studyKey("quick", &header.quick, "whether it always has the form of `--quick`", {}, {},
               nothing),
      studyKey("frames", &header.frames,
               "timed of every method, at most; 0: none, as in the quick form", {0, 10000}, {},
               costs)};
}

struct StudySpec : StudyHeader {
  std::filesystem::path file = {};
  surface::Cage cage;
  relief::Relief relief;
  BakeSpec bake = {};
  BaseSpec base = {};
  TruthSpec truth = {};
  std::vector<ViewSpec> views = {};
  std::vector<Light> lights = {};
  std::vector<MethodSpec> methods = {};
  std::vector<Gate> thresholds = {};  ///< each with the origin Threshold
  std::vector<ClaimSpec> claims = {};
  /// Errors to attribute to their causes, in the first view with fixed samples: there all base
  /// meshes show the same.
  std::vector<LadderSpec> ladders = {};
  /// Thresholds excluded by command-line options: a check reports them as skipped.
  std::vector<Judgement> leftOut = {};
  std::vector<std::string> leftOutMethods = {};  ///< labels that command-line options exclude
  horizon::SearchRadius radius = {};             ///< of `bake`, and why
  SurfaceSection surfaceSection = {};            ///< what `cage` was made from
  ReliefSection reliefSection = {};              ///< what `relief` was made from
  std::string text = {};                         ///< the file's, as it is written
  std::size_t sweepCases = 1;                    ///< of the sweep that it is a case of
};

/// What the command line changes in a study.
struct StudyOptions {
  std::vector<std::string> overrides;  ///< `key.path=value`
  std::vector<std::string> methods;    ///< labels or names to keep; all, if empty
  /// A quarter of each view's side (in an atlas the odd number at or above it) and a sixteenth of
  /// the micro-mesh, and no frame timed: a preview, not a measurement.
  bool quick = false;
  /// `LABEL=NAME` or `LABEL=FILE.glsl`: another shader in a method's place, see replaceMethods.
  std::vector<std::string> replacements = {};
  /// Names of built-in methods after the study's own, where overrides may reach them.
  std::vector<std::string> addedMethods = {};
  std::size_t mostCases = 100'000;  ///< of a sweep: more are refused
  bool gatedOnly = false;  ///< only the methods that a gate names; all, if a gate names none
  /// An outline tells what a study asks for, but cannot be run: neither the map's border nor the
  /// rule's search radius is found, which takes longer than all the rest.
  bool isOutline = false;
};

/// Reads and checks a study: paths in it are relative to its folder, see studyFolder. A `[sweep]`
/// is left to `readStudyPlan`.
/// @throws InputError naming file, line, key, what was found and what was expected
StudySpec readStudy(const StudyText& text, const StudyOptions& options = {});
StudySpec readStudy(const std::filesystem::path& file, const StudyOptions& options = {});
/// @param parts  that another study was read with, and this one is: the same study in less time
StudySpec readStudy(const StudyText& text, const StudyOptions& options, StudyParts& parts);

}  // namespace gnomon::study
