#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/camera.h"
#include "model/light_angles.h"
#include "study/spec/study_file.h"

namespace gnomon::app {

/// What sliders change of one bake; unset is as the file has it.
struct BakeChange {
  std::optional<int> azimuths;
  std::optional<int> bits;
  std::optional<double> radius;  ///< texels
  friend bool operator==(const BakeChange&, const BakeChange&) = default;
};

/// What sliders change of one method.
struct MethodChange {
  BakeChange bake;
  std::optional<int> subdivisions;           ///< of the mesh that it draws
  std::map<std::string, double> parameters;  ///< its own, by name
  friend bool operator==(const MethodChange&, const MethodChange&) = default;
};

/// What sliders change of a study.
struct StudyChanges {
  std::optional<double> height;     ///< `relief.height`
  std::optional<double> curvature;  ///< `surface.curvature`, of a sphere or cylinder, 1 / world
  BakeChange bake;                  ///< of the study; methods with their own keep it
  std::optional<int> subdivisions;  ///< of the study's base mesh; methods with their own keep it
  std::map<std::string, MethodChange> methods;  ///< by label
  friend bool operator==(const StudyChanges&, const StudyChanges&) = default;
};

/// The changes as overrides, `key.path=value`: what `readStudy` takes to read the file with them,
/// so that a changed study is checked as any other.
/// @param file  the study, for the places of its methods
/// @throws InputError as parseToml, or for a label that no method of the file bears
std::vector<std::string> overridesOf(const StudyChanges& changes, const std::filesystem::path& file,
                                     const study::StudyOptions& options = {});

/// A state of the viewer.
struct StudyState {
  std::filesystem::path file;  ///< the study that was opened
  /// What it was opened with, the step of a sweep as its override, and all changes after them.
  /// `quick` and `gatedOnly` do not enter a file: `gnomon run --quick` asks for them.
  study::StudyOptions options;
  std::vector<std::string> methods;  ///< labels of those to keep; all, if empty
  std::optional<Camera> camera;      ///< in place of the file's views; they stay, if unset
  std::optional<LightAngles> light;  ///< in place of the file's lights; they stay, if unset
};

/// The state as the text of a study file: reading it gives what reading the opened file with the
/// state's options gives, to the bit, but for
///   views and lights     one each, where the state has them;
///   `study.name`         the stem of the file it is saved to, other characters than letters,
///   digits,
///                        - and _ becoming -: a run of it does not overwrite the study's own;
///   `study.ranked`       false: a state is no study of its own in a ranking;
///   `bake.radius`        stated, where the state has a light of its own: the rule looks at the
///                        lights, and the tables shown are those of the file's;
///   `[sweep]`            gone: a state is one case, and the value shown is fixed in its key;
///   `[[threshold]]`, `[[claim]]`, `[[ladder]]`
///                        gone: they were chosen for the study's settings, and may name lights,
///                        views and methods that the state does not have;
///   comments             gone.
/// Paths are relative to where the file is saved.
/// @param target  the file it is to be saved to
/// @throws InputError as readStudy; UsageError for overrides as parseToml
std::string savedStudy(const StudyState& state, const std::filesystem::path& target);

/// Saves it, whole or not at all.
/// @throws InputError also where the file cannot be written
void saveStudy(const StudyState& state, const std::filesystem::path& target);

}  // namespace gnomon::app
