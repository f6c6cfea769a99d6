#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cache/cache.h"
#include "compare/confidence_interval.h"
#include "compare/counts.h"
#include "compare/shadow_length.h"
#include "render/method.h"
#include "study/record/gate.h"

namespace gnomon::study {

/// One method's counts over the samples of a view, all lights together, whose value on one axis
/// lies in a bin. The bins of an axis hold every sample that has a value there, each in one of
/// them. Bins without a sample are left out.
struct BinRecord {
  std::string method;  ///< a MethodRecord's label
  std::string view;
  std::string light;           ///< "all": the sum over the lights
  std::string axis;            ///< the name of one of sampleAxes()
  std::optional<double> low;   ///< included; none where the bin has no lower end
  std::optional<double> high;  ///< excluded; none where the bin has no upper end
  compare::Counts counts;
};

/// The light of a record that speaks of all lights of its study together.
constexpr std::string_view allLights = "all";

/// A method's error rate with its confidence interval: over all samples of a view, under one light,
/// or the mean over all lights ("all"). Every view has the row "all"; a study with several lights
/// has one for each of them as well.
struct ConfidenceRecord {
  std::string method;  ///< a MethodRecord's label
  std::string view;
  std::string light;                          ///< its name, or "all"
  double rate = 0;                            ///< error rate, 0 to 1
  std::optional<compare::Interval> interval;  ///< 95 %; none where the view has too few blocks
  std::string reason;                         ///< why there is none; empty if there is one
  std::size_t blocks = 0;                     ///< that hold a sample
  int blockSide = 0;                          ///< samples
};

/// How the first of two methods compares with the second.
enum class DifferenceVerdict {
  better,
  worse,
  equal,               ///< both give the same answers, to the sample
  notDistinguishable,  ///< by the interval of the difference, or within the truth's uncertainty
  noInterval,          ///< too little is known to say any of these
};

/// Two methods of one view, paired block by block: under one light, or all lights together ("all").
/// Every view has the row "all"; a study with several lights has one for each of them as well. The
/// intervals are not corrected for the number of pairs: of twenty pairs that do not differ, one may
/// seem to.
struct DifferenceRecord {
  std::string view;
  std::string light;      ///< its name, or "all": the mean over the lights
  std::string first;      ///< a MethodRecord's label
  std::string second;     ///< likewise, later in the study
  double difference = 0;  ///< error rate of the first less that of the second: below 0 it is better
  std::optional<compare::Interval> interval;  ///< 95 %, of the difference
  std::string reason;                         ///< why there is none; empty if there is one
  double uncertainty = 0;                     ///< of the truth in this view, mean over these lights
  /// By `distinguish`.
  DifferenceVerdict verdict = DifferenceVerdict::noInterval;
};

/// A part of an error rate, as a share of all samples. Negative where correcting a cause made the
/// error larger: two errors of a method may cancel.
struct BudgetShare {
  double value = 0;
  std::optional<compare::Interval> interval;  ///< 95 %; none where the view is too small to tell
  std::string reason;                         ///< why there is none; empty if there is one
  /// How the share compares with none, by `distinguish`.
  DifferenceVerdict verdict = DifferenceVerdict::noInterval;
};

/// By how much a method's error falls when one cause is corrected.
struct BudgetCause {
  std::string name;
  std::string change;    ///< what was put in its place
  BudgetShare forward;   ///< after the causes before it
  BudgetShare backward;  ///< after the causes behind it
};

/// The error rates of a method with some causes corrected.
struct BudgetState {
  double errorRate = 0;
  double falseShadow = 0;
  double falseLight = 0;
};

/// A part of the error that remains when all causes are corrected.
struct BudgetRest {
  std::string name;  ///< as `budgetRestNames`
  BudgetShare share;
};

/// One method's error and where it comes from: `total` = Σ shares of either order + Σ `rest`.
struct BudgetRecord {
  std::string method;  ///< a MethodRecord's label
  std::string view;
  std::string light;       ///< its name, or "all": the mean over the study's lights
  double uncertainty = 0;  ///< of the truth in this view, mean over these lights
  std::size_t blocks = 0;  ///< of the view that hold a sample
  BudgetShare total;       ///< the method's error rate
  std::vector<BudgetCause> causes;
  std::vector<BudgetRest> rest;       ///< what remains
  std::vector<BudgetState> forward;   ///< one more than there are causes
  std::vector<BudgetState> backward;  ///< likewise
};

/// A file that a run was made of.
struct InputRecord {
  enum class Kind { study, mesh, image, shader, mask };
  Kind kind = Kind::study;
  /// Relative to the run's folder; of a shader that comes with the program as `shaders/…`.
  std::string file;
  std::string sha256;  ///< of its bytes, 64 lowercase hexadecimal digits
};

/// What is needed to run the very case again.
struct CaseRecord {
  std::string file;      ///< name of the study's copy in the run's folder
  toml::table settings;  ///< what that copy holds
  std::vector<InputRecord> inputs = {};
};

/// What one run of one study found: plain data, written by `report`. Every figure is one that the
/// run computed.

/// Where the run took place.
struct EnvironmentRecord {
  std::string gnomonVersion;
  std::string commit;  ///< of the sources, or empty outside a checkout
  std::string cpu;
  int threads = 0;  ///< 0 where the record tells nothing of its run
  std::string glRenderer;
  std::string glVersion;
  std::string embreeVersion;
  std::string openSubdivVersion;
  std::string frameClock;  ///< what measured the frame times: "wall clock", "GL timer queries"
};

/// The uncertainty of the truth in one view under one light.
struct UncertaintyRecord {
  std::string view;
  std::string light;
  /// Share of samples that change at half the micro-mesh's resolution; of a light with a disc the
  /// mean of |ΔV| at that and with half the directions.
  double flipRate = 0;
  /// By how much the median length ratio of that coarser truth's shadows to the truth's differs
  /// from 1; none where too few could be measured.
  std::optional<double> lengthError = std::nullopt;
  /// The boundary metrics of that coarser truth's mask, as if it were a method's.
  std::vector<compare::Metric> boundaries = {};
  /// Of a light with a disc: |ΔV| that 99 % of the samples do not exceed, and the share metrics of
  /// that coarser truth's V; none of a point light.
  std::optional<double> percentile99 = std::nullopt;
  std::vector<compare::Metric> shares = {};
  std::optional<double> percentile999 = std::nullopt;  ///< as `percentile99`, of 99.9 %
  /// By how much that coarser truth is brighter: the mean of ΔV, or the share of samples that turn
  /// lit less the share that turn shadowed. None where the record is of no run.
  std::optional<double> brightening = std::nullopt;
};

struct TruthRecord {
  std::uint64_t microTriangles = 0;
  double stepTexels = 0;   ///< longest micro-edge along s or t of any face, texels on the map
  double uncertainty = 0;  ///< the largest flip rate below
  std::optional<std::uint64_t> bvhBytes;  ///< none where the record tells nothing of its run
  std::uint64_t meshBytes = 0;
  std::vector<UncertaintyRecord> flips;
  double askedStepTexels = 0;  ///< the `truth.step` that gives this mesh: no micro-edge is longer
};

/// D, the search radius of tables and marches: occluders farther away are not found.
struct RadiusRecord {
  double texels = 0;
  std::string reason = {};  ///< "the study states it", or what the rule found (search_radius.h)
};

/// How the surface lies in its texture: see surface::TextureLayout.
struct TextureRecord {
  int charts = 0;
  bool chartsOverlap = false;
  double sharedArea = 0;  ///< share of the surface's area, 0 to 1
};

/// A method as this study runs it.
struct MethodRecord {
  std::string label;  ///< unique in the study; rows refer to it
  std::string name;   ///< the method's own name
  std::string title;
  std::string citation;
  render::MethodMark mark = {};
  /// The mean over all views and lights of the share of samples whose answer met a texel of another
  /// chart than their own; none where no charts overlap.
  std::optional<double> otherChartShare = std::nullopt;
};

/// A method of the study that was not measured, because the driver draws wrong what it needs.
struct RefusedMethod {
  std::string label;
  std::string reason;  ///< "this OpenGL gets shadow volumes wrong: …"
};

/// One answer of a method against the truth, for one light, view and region ("all" or a region's
/// name).
struct ResultRecord {
  std::string method;  ///< a MethodRecord's label
  std::string light;
  std::string view;
  std::string region;
  compare::Counts counts;
  std::optional<compare::ShadowLengths> lengths = std::nullopt;  ///< measured for the region "all"
  std::vector<compare::Metric> boundaries = {};  ///< likewise; empty for other regions
  Answer answer = Answer::drawn;
  std::vector<compare::Metric> shares = {};  ///< as `boundaries`; empty for a point light too
};

struct CostRecord {
  std::string method;
  std::uint64_t polygons = 0;     ///< triangles that camera and light see, each mesh once
  std::uint64_t tableBytes = 0;   ///< tables that a frame reads, and textures that its passes fill
  std::uint64_t heightBytes = 0;  ///< the height map, where the method reads it
  std::optional<double> frameMs;  ///< median time of one frame of the first camera view
  /// The same while the light stands still: without the passes that depend on the light alone.
  std::optional<double> stillMs = std::nullopt;
  /// Texels that the answer of a sample reads: the mean over the samples of the first camera view
  /// under the first light, without other passes (FrameCosts::texels).
  std::optional<double> texels = std::nullopt;
  int passes = 1;  ///< drawing passes a frame
  /// The day, "2026-11-21", on which an earlier run on this machine measured `frameMs`; empty if
  /// this run did.
  std::string keptSince = {};
};

struct TimingRecord {
  std::string stage;
  double seconds = 0;
};

/// A claim of a paper and whether the run confirms it.
struct ClaimRecord {
  std::string text;
  std::string source;
  Verdict verdict = Verdict::notEvaluated;
  std::string detail;  ///< the figures it was judged by
  /// Over the study's cases; none where the claim was not evaluated.
  std::optional<ClaimSpread> spread = std::nullopt;
  std::vector<std::string> methods = {};  ///< labels of those that it is about, in its own order
};

/// Files with the truth at the samples of one mesh, in one view under one light. With them and a
/// method's mask, the method's rows can be computed again: its counts over all samples, in each
/// region, and where the path to the light crosses a seam. In an atlas, counts are sums of weights,
/// added row by row from the top. Paths are relative to the run's folder.
struct TruthFilesRecord {
  std::string mask;
  std::string regions;  ///< a picture in regions' colours
  std::string seam;     ///< white where the path crosses a seam, else black; empty where none does
  std::string weights;  ///< EXR, channel "area": the weight of each sample of an atlas; else empty
};

/// A square of pixels where an answer errs much, beside the truth.
struct WorstPlace {
  int left = 0, top = 0;      ///< its corner at the left top, pixels
  int side = 0;               ///< pixels
  double error = 0;           ///< sum over its pixels: see compare::Window
  std::string answer, truth;  ///< WebP for a page
};

/// One picture of a panel. Paths are relative to the run's folder.
struct PictureRecord {
  enum class Kind { shaded, difference, displaced };
  Kind kind = Kind::shaded;
  std::string method;  ///< a label, or "truth"
  std::string caption;
  std::string path;
  std::string mask = {};      ///< of the answer that a shaded picture shows
  std::string embedded = {};  ///< WebP for a page; empty for a difference, which it shows as it is
  /// Of a shading: the index of the panel's layers from which a page composes it by its mask.
  /// `embedded` then has the small size (EmbeddedSize).
  std::optional<std::size_t> layers = std::nullopt;
  /// Of a shading: the truth at its own samples.
  std::optional<TruthFilesRecord> truth = std::nullopt;
  std::string testMask = {};  ///< of a method's shading: what its shadow test alone says
  /// Of a method's shading: where its error is largest, the worst first.
  std::vector<WorstPlace> worst = {};
};

/// Two pictures of a mesh in one view under one light: with all samples lit, and with all shadowed;
/// as WebP, for a page. At each pixel a method's shading equals one of the two, as its mask says,
/// so the two pictures and the masks replace the shadings at a fraction of their size.
struct LayersRecord {
  std::string lit;
  std::string dark;
  bool operator==(const LayersRecord&) const = default;
};

/// The pictures of one view under one light, in the order of Figure 8.
struct PanelRecord {
  std::string view;
  std::string light;
  int width = 0;
  int height = 0;
  std::vector<PictureRecord> pictures;
  std::vector<LayersRecord> layers = {};
};

/// The pictures of a row of results whose reference does not hold. Paths are relative to the run's
/// folder.
struct ReferencePictures {
  std::string method, view, light;
  std::string before;  ///< signed difference as committed; empty where none was kept
  std::string after;   ///< signed difference of this run
  std::string change;  ///< of the method's mask; empty likewise
  std::string note;    ///< why there is no picture of before
};

struct StudyRecord {
  std::string name;
  std::string title;
  std::string source;   ///< the figure or question the study stands for
  std::string file;     ///< the study file, as given
  std::string command;  ///< reproduces the run
  CaseRecord reproduction;
  EnvironmentRecord environment;
  RadiusRecord radius = {};
  TextureRecord texture = {};
  TruthRecord truth;
  std::vector<std::string> atlasViews;  ///< names of the views whose lengths are in texels
  std::vector<MethodRecord> methods;    ///< those that were measured
  std::vector<RefusedMethod> refused;   ///< the others: notices and problems name them
  std::vector<ResultRecord> results;
  std::vector<ConfidenceRecord> confidence;   ///< of every method in every view
  std::vector<DifferenceRecord> differences;  ///< of every two methods in every view
  std::vector<BinRecord> bins;
  std::vector<CostRecord> cost;
  std::vector<TimingRecord> timings;
  std::vector<Judgement> judgements;  ///< of the study's thresholds, then of references
  /// Where a check judged the run by references: their file, and what kept it from it.
  std::string baseline;
  std::vector<ProblemRecord> problems;
  std::vector<ReferencePictures> referencePictures;
  std::vector<ClaimRecord> claims;
  std::vector<BudgetRecord>
      budgets;  ///< a ladder for all lights together, then for each of several
  std::vector<PanelRecord> panels;
  std::vector<std::string> notices;         ///< to be read before the figures; see study/notices.h
  std::uint64_t undefinedSamples = 0;       ///< left out: their texture map is degenerate
  std::optional<cache::CacheCounts> cache;  ///< none where the run used no cache

  /// The title, or the name of a study without one.
  [[nodiscard]] const std::string& heading() const { return title.empty() ? name : title; }
  /// What thresholds, references and problems say of the run.
  [[nodiscard]] RunStatus status() const { return runStatus(judgements, problems); }
};

}  // namespace gnomon::study
