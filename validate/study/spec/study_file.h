#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "horizon/search_radius.h"
#include "relief/relief.h"
#include "study/spec/sections/bake_section.h"
#include "study/spec/sections/method_section.h"
#include "study/spec/sections/relief_section.h"
#include "study/spec/sections/surface_section.h"
#include "study/spec/sections/threshold_section.h"
#include "study/spec/sections/view_section.h"
#include "study/spec/toml_reader.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"

namespace gnomon::study {

/// What the cases of a sweep share: parts that one study was read with, for the next one whose
/// tables say the same. A part is looked up by the text of the tables that it follows from. Maps
/// are not copied: studies share their texels.
struct StudyParts {
  /// The last surface: a sweep seldom comes back to one.
  std::string surfaceKey = {};
  std::shared_ptr<const surface::Cage> cage = {};
  std::shared_ptr<const surface::LimitSurface> limit = {};  ///< null until something needs it
  std::string reliefKey = {};                               ///< of the last relief
  std::map<std::string, relief::Relief> reliefs = {};       ///< without their borders
  std::map<std::string, horizon::SearchRadius> radii = {};
  DeclaredMethods methods = {};
};

/// The text of a study. A command reads it once, since a pipe can be read only once, and so that
/// everything in a run comes from the same text.
struct StudyText {
  std::filesystem::path file;  ///< as the command line names it
  std::string text;
};

/// Reads a study's file, or the pipe that /dev/stdin or the like stands for.
/// @throws InputError as readFileOrStream
StudyText readStudyText(const std::filesystem::path& file);

/// Where a study's relative paths begin: the folder of its file. One that comes from a stream has
/// none, so that they begin at the working directory.
std::filesystem::path studyFolder(const std::filesystem::path& file);

/// One cause of a ladder, and what corrects it.
struct CauseSpec {
  std::string name = {};    ///< "azimuth count"
  std::string change = {};  ///< what is put in its place, "256"; may be empty
};

/// `[[ladder.rung]]`
inline StudyKeys keysOf(CauseSpec& cause) {
  return {
      studyKey("cause", &cause.name, "of the error", {}, required, Enters::nothing),
      studyKey("change", &cause.change, "what is put in its place", {}, "none", Enters::nothing),
      studyKey("set", OwnCode{"a table"},
               "keys of `[[method]]` that correct it, all but `label`; no key in two rungs", {},
               required)};
}

/// A method from its published form to the best that this study can make of it, corrected one cause
/// at a time. Both orders begin at the method and end with all causes corrected: `forward` from the
/// first to the last, `backward` from the last to the first. Each has one state more than there are
/// causes.
struct LadderSpec {
  std::string method = {};  ///< label of the study's method
  std::vector<CauseSpec> causes;
  std::vector<MethodSpec> forward;
  std::vector<MethodSpec> backward;
  toml::table written = {};  ///< its table in the study's file
};

/// @param labels  of the study's methods
inline StudyKeys keysOf(LadderSpec& ladder, const std::vector<std::string>& labels) {
  StudyKeys keys = {
      studyKey("method", &ladder.method, "label of the `[[method]]` that it begins at", {},
               required, Enters::nothing, labels),
      studyKey("rung", OwnCode{"a list of tables"}, "the causes, in their order", {}, required)};
  MethodSpec method;
  for (StudyKey& key : keysOf(method)) {
    if (key.name == "label" || key.name == "masks") continue;
    key.place = OwnCode{typeText(key)};
    key.otherwise = "the method's";
    keys.push_back(std::move(key));
  }
  return keys;
}

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
  /// An outline tells what a study asks for, but cannot be run: it is parsed, not prepared.
  bool isOutline = false;
};

/// Reads and checks a study: paths in it are relative to its folder, see studyFolder. A `[sweep]`
/// is left to `readStudyPlan`. Its text is parsed; then, unless it is an outline, it is prepared to
/// be run: the limit surface gives the map's border, and the search radius of bakes that state none
/// (0 until then).
/// @throws InputError naming file, line, key, what was found and what was expected
StudySpec readStudy(const StudyText& text, const StudyOptions& options = {});
StudySpec readStudy(const std::filesystem::path& file, const StudyOptions& options = {});
/// @param parts  that another study was read with, and this one is: the same study in less time
StudySpec readStudy(const StudyText& text, const StudyOptions& options, StudyParts& parts);

/// The `[[ladder]]` tables of a study file.
///
/// `[[ladder]]` names in `method` the label of a `[[method]]`, and may change its keys (as
/// `changedMethod`) without changing its masks: to name a file that is the same method with
/// switches. Each `[[ladder.rung]]` names a `cause` and holds in `set` the keys that correct it.
/// @param root   of the file
/// @param study  with its views and methods
/// @throws InputError with file, line and key: for a ladder without an atlas view, two of one
///   method, a label that no method has, a rung that changes nothing, two of one cause, and where
///   correcting all causes forward and backward is not the same
std::vector<LadderSpec> readLadders(const TomlReader& root, const StudySpec& study,
                                    const MethodDefaults& defaults);

/// A study's file with the overrides and replacements of the options in it: what `readStudy` reads.
/// @throws InputError and UsageError as parseToml and replaceMethods
toml::table studyTable(const StudyText& study, const StudyOptions& options);
toml::table studyTable(const std::filesystem::path& file, const StudyOptions& options);

}  // namespace gnomon::study
