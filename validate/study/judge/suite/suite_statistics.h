#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/scenes/comparisons.h"
#include "compare/scenes/resampled_mean.h"
#include "study/judge/ranking.h"

namespace gnomon::study {

/// Statistics over the scenes of a suite: studies that were drawn from one population, of which
/// each is one observation. What an interval says of a method holds for new scenes of the suite,
/// where those of one study (confidence_interval.h) hold for new bumps of one scene.

/// One method over the scenes.
struct SuiteMethod {
  std::string label;
  std::vector<std::string> names;  ///< the methods' own, as a rule one
  compare::SceneSpread spread;     ///< over the scenes in which it has an error in every case
  std::string worstScene;
  std::optional<compare::Interval> interval;  ///< 95 % of the mean, within 0 to 1
  std::string reason;                         ///< why there is none; empty if there is one
  double uncertainty = 0;                     ///< of the truth, mean over these scenes
  /// None for a method that lacks a scene: means over other scenes cannot be compared.
  std::optional<compare::SceneRank> rank;
  render::MethodMark mark = {};  ///< of the first of `names`
};

/// Two methods over the scenes that both have, at least one.
struct SuitePair {
  std::string first, second;                  ///< labels
  compare::WinShare wins;                     ///< of the first
  double difference = 0;                      ///< mean error of the first less that of the second
  std::optional<compare::Interval> interval;  ///< 95 % of the difference, by itself
  std::string reason;                         ///< why there is none; empty if there is one
  double uncertainty = 0;                     ///< of the truth, mean over these scenes
  double probability = 1;                     ///< p of no difference
  double adjusted = 1;                        ///< p by Holm over all pairs of the suite
  /// The difference with the error that Holm allows this pair; `verdict` is `distinguish` of it, or
  /// of -1 to 1 where so small an error leaves everything open. Equal are methods that answer alike
  /// on each of these scenes.
  std::optional<compare::Interval> corrected;
  DifferenceVerdict verdict = DifferenceVerdict::noInterval;
};

/// A method's error in one bin of an axis, over all scenes.
struct SuiteBin {
  std::string method;  ///< a label
  std::string axis;    ///< as in BinRecord, likewise `low` and `high`
  std::optional<double> low, high;
  compare::BinnedError error;
};

/// One scene, by how hard it is for the methods with a rank; without figures where there are none.
struct SuiteScene {
  std::string name;
  std::string title;
  std::string report;                 ///< its page, relative to the suite's; empty without one
  std::optional<double> median;       ///< of their errors
  std::string best;                   ///< of them, label of that with the smallest error; of equal
                                      ///< ones the first by name
  std::optional<double> bestError;    ///< its error
  std::optional<double> leaderError;  ///< that of the method of rank 1
  double uncertainty = 0;             ///< of the truth
};

struct SuiteStatistics {
  std::string suite;
  compare::SceneTable table;         ///< sorted by name
  std::vector<SuiteMethod> methods;  ///< with a rank first, by mean; then by number of scenes
  std::vector<SuitePair> pairs;      ///< of every two, in the order of `methods`
  std::vector<SuiteBin> bins;        ///< by method, axis and lower end
  std::vector<SuiteScene> scenes;    ///< the largest median first
  std::size_t comparisons = 0;  ///< pairs that Holm's correction counts: those with an interval
  std::vector<std::string> entries = {};  ///< whose comparisons it counts by themselves
  bool isSoft = false;                    ///< a scene has a light with a disc: errors are `mae`
};

/// The one suite that studies of a run were drawn for; empty where there are fewer than
/// `leastScenes` of them or where they are of several suites.
std::string suiteOf(std::span<const StudyMeans> studies);

/// @param suite    suiteOf these studies; those that were not drawn for it are left out
/// @param studies  in any order, with methods in any order
/// @param entries  labels of methods that somebody asks about: Holm's correction counts the
///   comparisons with each of them by themselves, since they are another question than who is best
SuiteStatistics suiteStatistics(const std::string& suite, std::span<const StudyMeans> studies,
                                const std::vector<std::string>& entries = {});

/// The page of a scene; empty where there is no such scene.
std::string reportOf(const SuiteStatistics& statistics, std::string_view scene);

/// The pair of two methods, whichever of them comes first; none where they share no scene.
std::optional<SuitePair> findPair(const SuiteStatistics& statistics, std::string_view first,
                                  std::string_view second);

}  // namespace gnomon::study
