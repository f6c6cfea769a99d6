#include "study/spec/study_sections.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "compare/metric.h"
#include "render/shader_files.h"
#include "study/record/cases.h"
#include "study/spec/sweep/sweep.h"
#include "truth/region.h"

namespace gnomon::study {

namespace {

/// The keys of one section as the rows of a table.
class KeyTable {
 public:
  /// @param form  of the section that has these keys: `shape = "plane"`; empty for all forms
  KeyTable& add(const StudyKeys& keys, const std::string& form = {}) {
    for (const StudyKey& key : keys) add(key, form);
    return *this;
  }

  /// The key that tells the kinds of a table, and the keys of each.
  /// @param before  a kind's name among the forms
  template <typename Variant, std::size_t size>
  KeyTable& addKinds(const char* tag, const std::array<std::string_view, size>& names,
                     std::string_view meaning, std::string_view before = "") {
    std::string first;
    add({studyKey(tag, &first, meaning, {}, required, Enters::nothing,
                  {names.begin(), names.end()})});
    std::vector<Variant> kinds = allKinds<Variant>();
    for (std::size_t k = 0; k < size; ++k) {
      add(keysOf(kinds[k]), fmt::format("{}`{}`", before, names.at(k)));
    }
    return *this;
  }

  [[nodiscard]] std::string text(std::string_view heading) const {
    std::string text = fmt::format(
        "\n## `{}`\n\n| key | value | without it | meaning |\n|---|---|---|---|\n", heading);
    for (const Row& row : rows_) {
      const std::string forms =
          row.forms.empty() ? "" : fmt::format("{}: ", fmt::join(row.forms, ", "));
      text += fmt::format("| `{}` | {} | {} | {}{} |\n", row.key, row.type, row.otherwise, forms,
                          row.meaning);
    }
    return text;
  }

 private:
  struct Row {
    std::string key, type, otherwise, meaning;
    std::vector<std::string> forms = {};
  };

  void add(const StudyKey& key, const std::string& form) {
    const Row row{std::string(key.name), typeText(key), defaultText(key), std::string(key.meaning)};
    auto same = std::find_if(rows_.begin(), rows_.end(), [&](const Row& other) {
      return std::tie(row.key, row.type, row.otherwise, row.meaning) ==
             std::tie(other.key, other.type, other.otherwise, other.meaning);
    });
    if (same == rows_.end()) same = rows_.insert(rows_.end(), row);
    if (!form.empty()) same->forms.push_back(form);
  }

  std::vector<Row> rows_;
};

constexpr std::string_view keysOpening =
    R"(# The keys of a study

`gnomon list keys` prints this text from the declarations that studies are read by. A study is a TOML
file of these tables. `--set TABLE.KEY=VALUE` sets any key on the command line, `light.0.elevation=30`
one of a list of tables, counted from 0. Angles are in degrees; texels are those of the map before
`resample`. An unknown key is refused, with the one that was probably meant.
)";

}  // namespace

StudyKeys studySections() {
  const OwnCode table{"a table"};
  const OwnCode tables{"a list of tables"};
  return {studyKey("study", table, "what the study is called", {}, required),
          studyKey("surface", table, "the curved surface", {}, required),
          studyKey("relief", table, "the height map on it", {}, required),
          studyKey("bake", table, "tables of horizons", {}, "defaults"),
          studyKey("base", table, "the mesh that methods draw", {}, "defaults"),
          studyKey("truth", table, "the displaced surface that is traced", {}, "defaults"),
          studyKey("view", tables, "the samples that are compared", {}, required),
          studyKey("light", tables, "directional lights", {}, required),
          studyKey("method", tables, "the methods that are measured", {}, required),
          studyKey("threshold", tables, "gates of `gnomon check`", {}, "none"),
          studyKey("claim", tables, "what a paper states, to be judged", {}, "none"),
          studyKey("ladder", tables, "an error, taken apart by cause", {}, "none"),
          studyKey("sweep", tables, "keys and their values, a run each", {}, "none")};
}

std::vector<std::string> judgedRegions(const std::vector<std::string>& partNames) {
  std::vector<std::string> names = {std::string(wholeRegion)};
  for (std::string& name : truth::allRegions(partNames)) names.push_back(std::move(name));
  return names;
}

std::string studyKeysText() {
  std::string text(keysOpening);
  const auto write = [&](std::string_view heading, const KeyTable& table) {
    text += table.text(heading);
  };
  StudyHeader header;
  SurfaceMesh mesh;
  ReliefSection relief;
  PatternMap pattern;
  SolidMap solid;
  ImageMap image;
  ProjectedMap projected;
  BakeSpec bake;
  BaseSpec base;
  TruthSpec truth;
  ViewSpec view;
  LightSection light;
  MethodSpec method;
  Gate gate = newThreshold();
  ClaimSpec claim;
  LadderSpec ladder;
  CauseSpec cause;
  SweepTable sweep;
  write("tables of a file", KeyTable().add(studySections()));
  write("[study]", KeyTable().add(keysOf(header)));
  write("[surface]", KeyTable()
                         .addKinds<Shape>("shape", shapeNames, "a built-in shape, or `mesh`")
                         .add(keysOf(mesh), "`mesh`"));
  write("[relief]",
        KeyTable()
            .add(keysOf(relief))
            .add(keysOf(image), "`image`")
            .add(keysOf(projected), "`projection`")
            .addKinds<Pattern>("pattern", patternNames,
                               "a built-in pattern of the plane, or `solid`, or `image`")
            .add(keysOf(pattern), "`pattern`")
            .addKinds<relief::SolidPattern>(
                "solid", solidNames, "a function of the point in space, carved into the surface",
                "solid ")
            .add(keysOf(solid), "`solid`"));
  write("[bake]", KeyTable().add(keysOf(bake, 1)));
  write("[base]", KeyTable().add(keysOf(base)));
  write("[truth]", KeyTable().add(keysOf(truth, 1)));
  write("[[view]]",
        KeyTable().addKinds<ViewKind>("type", viewKindNames, "the kind of view").add(keysOf(view)));
  write("[[light]]", KeyTable().add(keysOf(light)));
  write("[[method]]", KeyTable().add(keysOf(method)));
  write("[[threshold]]", KeyTable().add(keysOf(gate, {})));
  write("[[claim]]", KeyTable()
                         .add(keysOf(claim, {}))
                         .add(comparisonKeys(claim, {}), "comparison")
                         .add(boundKeys(claim, {}), "bounds"));
  write("[[ladder]]", KeyTable().add(keysOf(ladder, {})));
  write("[[ladder.rung]]", KeyTable().add(keysOf(cause)));
  write("[[sweep]]", KeyTable().add(keysOf(sweep)));
  return text;
}

namespace {

compare::PictureExtent largestExtent(const StudySpec& study, const std::string& view) {
  compare::PictureExtent largest;
  for (const ViewSpec& candidate : study.views) {
    if (!view.empty() && candidate.name != view) continue;
    const compare::PictureExtent extent =
        fullExtent(candidate, study.quick, study.relief.texelsPerUv(), study.cage.faceCount());
    largest.diagonal = std::max(largest.diagonal, extent.diagonal);
    largest.samples = std::max(largest.samples, extent.samples);
  }
  return largest;
}

/// Whether a metric has the same value in a region whatever a method answers: the truth lights all
/// of its samples, or shadows all.
bool isSettledIn(std::string_view region, compare::MetricId metric,
                 const std::vector<std::string>& partNames) {
  if (region == truth::regionName(truth::Region::lit)) return compare::isSettledByLight(metric);
  const bool isDark = std::any_of(
      truth::reportedRegions.begin(), truth::reportedRegions.end(), [&](truth::Region candidate) {
        return truth::isDark(candidate) && region == truth::regionName(candidate);
      });
  const std::vector<std::string> parts = truth::partRegions(partNames);
  const auto receivers = static_cast<std::ptrdiff_t>(partNames.size());
  const bool isShaded = std::find(parts.begin() + receivers, parts.end(), region) != parts.end();
  return (isDark || isShaded) && compare::isSettledByShadow(metric);
}

std::optional<double> readLimit(const TomlReader& section, const char* key,
                                const compare::MetricRange& range) {
  const toml::node* node = section.find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_string()) return section.number(key, anyNumber);
  const std::string text = section.text(key);
  const auto limit = text.ends_with('%') ? compare::limitOfText(text, range) : std::nullopt;
  if (!limit) {
    section.fail(key,
                 fmt::format("\"{}\" found, {} expected", text,
                             range.isShare ? "a number, or a percentage as \"5 %\"" : "a number"));
  }
  return limit;
}

}  // namespace

void readLimits(const TomlReader& section, const StudySpec& study, Gate& threshold) {
  const compare::MetricRange range =
      compare::metricRange(threshold.metric, largestExtent(study, threshold.view));
  threshold.minimum = readLimit(section, "min", range);
  threshold.maximum = readLimit(section, "max", range);
  if (!threshold.minimum && !threshold.maximum) section.fail("max", "`max` or `min` expected");
  if (isSettledIn(threshold.region, threshold.metric, study.cage.partNames)) {
    section.fail("region",
                 fmt::format("\"{}\" found, but there the region alone decides {}, whatever a "
                             "method answers",
                             threshold.region, threshold.metric.name()));
  }
  const auto require = [&](const char* key, std::optional<double> limit) {
    if (!limit) return;
    section.blame(key, [&] { compare::requireInRange(*limit, threshold.metric, range); });
  };
  require("max", threshold.maximum);
  require("min", threshold.minimum);
  section.blame(threshold.maximum ? "max" : "min", [&] {
    compare::requireMissable(threshold.minimum, threshold.maximum, threshold.metric, range);
  });
}

}  // namespace gnomon::study
