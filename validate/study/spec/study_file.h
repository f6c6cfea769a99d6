#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/camera.h"
#include "common/vec.h"
#include "horizon/horizon_bake.h"
#include "horizon/search_radius.h"
#include "horizon/stored_table.h"
#include "relief/relief.h"
#include "render/method_pass.h"
#include "study/record/record.h"
#include "study/spec/study_text.h"
#include "surface/base_mesh.h"
#include "surface/cage.h"
#include "truth/micro_mesh.h"

namespace gnomon {

/// A study, as its TOML file asks for it, checked: what to measure, not what was found. The README
/// lists every key; here is what they become.

struct BakeSpec {
  BakeSettings settings;
  TableBits bits = TableBits::eight;
  double angleLimit = pi / 2;  ///< of horizon angles: the largest off the normal, radians
};

struct AtlasSpec {
  int samplesPerSide;  ///< of every face
};

struct ViewSpec {
  std::string name;
  std::variant<Camera, AtlasSpec> kind;
};

/// A directional light. Azimuth counter-clockwise from +x about +z, elevation over the xy plane.
struct LightSpec {
  std::string name;
  double azimuth;    ///< radians
  double elevation;  ///< radians
  /// The unit vector toward the light.
  [[nodiscard]] Vec3 direction() const;
};

struct MethodSpec {
  std::filesystem::path file;  ///< its GLSL
  std::string label;           ///< unique in the study
  BakeSpec bake;               ///< the study's, with the method's overrides
  int baseSubdivisions = 1;    ///< of the mesh that it draws
  CurvatureSource baseCurvature = CurvatureSource::limit;  ///< of its vertices
  TableFilter filter = TableFilter::exact;
  std::map<std::string, double> parameters;
};

/// A claim of one of two forms: that one method's metric is smaller than another's in every light
/// and view (or, with `gainExceeds`, that the mean difference between them is larger than in the
/// study of that name; or, with `gainGrows`, that it is larger at the last value of the file's
/// sweep than at the first); or that one method's metric lies between bounds in every light and
/// view.
struct ClaimSpec {
  std::string text, source;
  std::string less, than;  ///< method labels; empty in the second form
  std::string metric;
  std::string gainExceeds;
  std::string region = "all";
  std::string method = {};  ///< label; empty in the first form
  std::optional<double> above = std::nullopt, below = std::nullopt;
  bool gainGrows = false;
  Answer answer = Answer::drawn;
  toml::table written = {};  ///< its table in the study's file
};

/// What one cause of a ladder is, and what undoes it.
struct CauseSpec {
  std::string name;    ///< "azimuth count"
  std::string change;  ///< what is put in its place, "256"; may be empty
};

/// A method's way from what was published to the best that this study can make of it, one cause at
/// a time. Both ways begin at the method and end with all causes undone: `forward` undoes them in
/// the order given, `backward` from the last to the first. Each has one state more than there are
/// causes.
struct LadderSpec {
  std::string method;  ///< label of the study's method that both begin at
  std::vector<CauseSpec> causes;
  std::vector<MethodSpec> forward;
  std::vector<MethodSpec> backward;
  toml::table written = {};  ///< its table in the study's file
};

struct StudySpec {
  std::filesystem::path file;
  std::string name, title, source;
  Cage cage;
  Relief relief;
  BakeSpec bake;
  int baseSubdivisions = 1;
  CurvatureSource baseCurvature = CurvatureSource::limit;
  MicroMeshSettings truth;
  /// Largest flip rate that is wanted; the step is then found by refinement.
  std::optional<double> truthUncertainty = std::nullopt;
  std::vector<ViewSpec> views;
  std::vector<LightSpec> lights;
  std::vector<MethodSpec> methods;
  std::vector<Gate> thresholds;  ///< each with the origin Threshold
  std::vector<ClaimSpec> claims;
  /// Errors to attribute to their causes, in the first atlas view: there all base meshes show the
  /// same samples.
  std::vector<LadderSpec> ladders;
  bool ranked = true;  ///< counts in a ranking over the studies of a run
  bool quick = false;  ///< the quick form, see StudyOptions
  /// Thresholds excluded by command-line options: a check reports them as skipped.
  std::vector<Judgement> leftOut = {};
  std::vector<std::string> leftOutMethods = {};  ///< labels that the command line takes no part of
  SearchRadius radius = {};                      ///< of `bake`, and why
  /// The values of `[surface]` and `[relief]`, defaults among them; paths as the file has them.
  toml::table surfaceSection = {}, reliefSection = {};
  std::string text = {};  ///< the file's, as it is written
};

/// What the command line changes in a study.
struct StudyOptions {
  std::vector<std::string> overrides;  ///< `key.path=value`
  std::vector<std::string> methods;    ///< labels or names to keep; all, if empty
  /// A quarter of each view's side (in an atlas the odd number at or above it) and a sixteenth of
  /// the micro-mesh: a preview, not a measurement.
  bool quick = false;
  /// `LABEL=NAME` or `LABEL=FILE.glsl`: another shader in a method's place, see replaceMethods.
  std::vector<std::string> replacements = {};
  /// Names of built-in methods after the study's own, where overrides may reach them.
  std::vector<std::string> addedMethods = {};
  bool gatedOnly = false;  ///< only the methods that a gate names; all, if a gate leaves them free
};

/// Reads and checks a study: paths in it are relative to its folder, see studyFolder. A `[sweep]`
/// is left to `readStudyPlan`.
/// @throws InputError naming file, line, key, what was found and what was expected
StudySpec readStudy(const StudyText& text, const StudyOptions& options = {});
StudySpec readStudy(const std::filesystem::path& file, const StudyOptions& options = {});

}  // namespace gnomon
