#include "report/paper_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "common/lists.h"
#include "common/text.h"
#include "compare/counts.h"
#include "report/plots/line_plot.h"
#include "report/plots/study_plots.h"
#include "report/suite/suite_plots.h"
#include "report/suite/suite_tables.h"
#include "report/tables/confidence.h"
#include "report/tables/latex_table.h"
#include "report/tables/ranked_table.h"
#include "report/tables/sweep_tables.h"
#include "report/terminal_page.h"
#include "report/text/number_text.h"
#include "study/judge/ranking.h"
#include "study/record/cases.h"

namespace gnomon::report {

namespace {

std::string keyOf(const Column& column) {
  if (column.key.empty() && column.name == "95 %") return "interval";
  std::string key = column.key.empty() ? column.name : column.key;
  std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) {
    return c == ' ' ? '_' : static_cast<char>(std::tolower(c));
  });
  return key;
}

/// Whether a paper may have it, and it is more than the row's name.
bool isChoice(const Column& column) {
  return column.quantity != Quantity::name && column.quantity != Quantity::exact &&
         column.readers != onPage;
}

}  // namespace

std::vector<std::string> paperColumnKeys() {
  std::vector<std::string> keys;
  for (const Table& table : {rankedTable({}, {}), suiteRankedTable({})}) {
    for (const Column& column : table.columns) {
      if (isChoice(column) && !column.name.empty()) appendOnce(keys, keyOf(column));
    }
  }
  return keys;
}

Table withColumns(Table table, const std::vector<std::string>& keys) {
  const auto isChosen = [&](const Column& column) {
    return isChoice(column) && contains(keys, keyOf(column));
  };
  if (std::none_of(table.columns.begin(), table.columns.end(), isChosen)) return table;
  for (Column& column : table.columns) {
    constexpr unsigned papers = onPaper | inColumn;
    const bool isShown = column.quantity == Quantity::name || isChosen(column);
    column.readers = isShown ? column.readers | papers : column.readers & ~papers;
  }
  return table;
}

Table withRows(Table table, const std::vector<std::string>& names) {
  const auto isOther = [&](const Row& row) { return !contains(names, nameOf(table, row)); };
  if (std::all_of(table.rows.begin(), table.rows.end(), isOther)) return table;
  std::erase_if(table.rows, isOther);
  return table;
}

namespace {

/// The file, macro by macro.
class Numbers {
 public:
  explicit Numbers(const std::string& study) : prefix_("gnomon" + latexName(study)) {}

  /// @param words  the name behind the study's
  /// @param text   as people read it
  void add(const std::vector<std::string>& words, const std::string& text,
           const std::string& about) {
    std::string name = prefix_;
    for (const std::string& word : words) name += latexName(word);
    while (!names_.insert(name).second) name += 'X';
    text_ +=
        fmt::format("\\newcommand{{\\{}}}{{{}}}% {}\n", name, escapeLatex(text), oneLine(about));
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string prefix_;
  std::set<std::string> names_;
  std::string text_;
};

/// What a figure is called, and what it is counted in.
struct FigureWords {
  std::string name, about;
};

FigureWords wordsOf(const Column& column) {
  if (column.quantity == Quantity::rank) return {"rank", "rank"};
  const std::string name = column.name == "95 %" ? "interval" : column.name;
  switch (column.quantity) {
    case Quantity::percent:
      return {name, name + ", percent"};
    case Quantity::interval:
      return {name, column.name == "95 %" ? "95 % interval, percent" : name + ", percent"};
    default:
      return {name, heading(column)};
  }
}

/// Whether people read it, and any run gives it again.
bool isQuoted(const Column& column) {
  return column.quantity != Quantity::exact && column.quantity != Quantity::name &&
         column.key != "frame_ms";
}

/// Every figure of every row, and both ends of the intervals.
void addRows(Numbers& numbers, const Table& table) {
  for (const Row& row : table.rows) {
    const std::string name = nameOf(table, row);
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const Column& column = table.columns[i];
      const Cell& cell = row.cells.at(i);
      if (!isQuoted(column)) continue;
      const FigureWords words = wordsOf(column);
      const std::string about = name + ": " + words.about;
      numbers.add({name, words.name}, cellText(column.quantity, cell), about);
      if (column.quantity != Quantity::interval) continue;
      numbers.add({name, words.name, "low"}, intervalEndText(lowOf(cell.interval)),
                  about + ", its lower end");
      numbers.add({name, words.name, "high"}, intervalEndText(highOf(cell.interval)),
                  about + ", its upper end");
    }
  }
}

void addCount(Numbers& numbers, const std::string& name, std::size_t count,
              const std::string& about) {
  numbers.add({name}, groupedText(count), about);
}

/// What the truth counts in the cases of the first method.
void addSamples(Numbers& numbers, const study::StudyRecord& record,
                const study::RankedMethod& first) {
  std::size_t samples = 0;
  std::vector<std::optional<double>> shadowed;
  for (const study::ResultRecord* row :
       study::rankedRows(record, first.label, study::Answer::drawn)) {
    samples += row->counts.samples;
    shadowed.push_back(compare::rate(row->counts, compare::metrics::prevalence).value);
  }
  addCount(numbers, "samples", samples, "samples of all views and lights");
  numbers.add({"prevalence"}, percentText(study::meanOf(shadowed)),
              "share of the samples that the truth has in shadow, percent");
}

void addPlaces(Numbers& numbers, const study::StudyRecord& record) {
  std::set<std::string> views, lights;
  for (const study::Case& which : study::comparedCases(record)) {
    views.insert(which.view);
    lights.insert(which.light);
  }
  addCount(numbers, "views", views.size(), "how many views");
  addCount(numbers, "lights", lights.size(), "how many lights");
  if (views.size() == 1) numbers.add({"view"}, *views.begin(), "the view");
  if (lights.size() == 1) numbers.add({"light"}, *lights.begin(), "the light");
}

void addTruth(Numbers& numbers, const study::StudyRecord& record) {
  const study::TruthRecord& truth = record.truth;
  const bool isMeasured = !truth.flips.empty() || truth.uncertainty > 0;
  numbers.add({"largest uncertainty"},
              percentText(isMeasured ? std::optional(truth.uncertainty) : std::nullopt),
              std::string("largest uncertainty of the truth, percent of ") +
                  errorWhole(study::isSoft(record)));
  numbers.add({"step"}, stepText(truth.stepTexels), "longest side of a micro-triangle, texels");
  numbers.add({"micro triangles"}, groupedText(truth.microTriangles), "triangles of the truth");
}

}  // namespace

std::string latexName(std::string_view text) {
  constexpr std::array<const char*, 10> digits = {"Zero", "One", "Two",   "Three", "Four",
                                                  "Five", "Six", "Seven", "Eight", "Nine"};
  std::string name;
  bool isInWord = false;
  for (const char c : text) {
    const bool isSmall = c >= 'a' && c <= 'z';
    const bool isDigit = c >= '0' && c <= '9';
    if (isDigit) name += digits.at(static_cast<std::size_t>(c - '0'));
    if (isSmall) name += isInWord ? c : static_cast<char>(c - 'a' + 'A');
    if (c >= 'A' && c <= 'Z') name += c;
    isInWord = isSmall || (c >= 'A' && c <= 'Z');
  }
  return name;
}

std::string numbersTex(const study::StudyRecord& record,
                       const std::vector<study::RankedMethod>& ranked) {
  Numbers numbers(record.name);
  addPlaces(numbers, record);
  addCount(numbers, "methods", ranked.size(), "how many methods");
  if (!ranked.empty()) {
    numbers.add({"best"}, ranked.front().label, "the method of the first row");
    numbers.add({"uncertainty"}, percentText(ranked.front().uncertainty),
                std::string("mean uncertainty of the truth, percent of ") +
                    errorWhole(study::isSoft(record)));
    addSamples(numbers, record, ranked.front());
  }
  addTruth(numbers, record);
  numbers.add({"radius"}, stepText(record.radius.texels), "search radius, texels");
  addRows(numbers, rankedTable(record, ranked));
  return numbers.text();
}

std::string numbersTex(const study::SweepRecord& sweep) {
  Numbers numbers(sweep.name);
  addCount(numbers, "cases", sweep.cases.size(), "how many cases");
  addRows(numbers, sweepSpreadTable(sweep));
  constexpr std::size_t mostCases = 100;
  if (sweep.cases.size() <= mostCases) addRows(numbers, sweepErrorsTable(sweep));
  return numbers.text();
}

std::string numbersTex(const study::SuiteStatistics& statistics) {
  Numbers numbers(statistics.suite);
  addCount(numbers, "scenes", statistics.table.scenes.size(), "how many scenes");
  addRows(numbers, suiteRankedTable(statistics));
  return numbers.text();
}

namespace {

/// figures/column/NAME.pdf, and likewise of a page.
void writeFigures(const std::vector<LinePlot>& plots, const PaperOptions& options,
                  RunFolder& folder) {
  for (const PaperWidth width : options.widths) {
    const std::vector<std::string> pdfs = paperPdfs(plots, width, options.fontSize);
    for (std::size_t i = 0; i < plots.size(); ++i) {
      folder.write(fmt::format("figures/{}/{}.pdf", paperWidthName(width), plots[i].name), pdfs[i]);
    }
  }
}

/// The table for a column, and where figures for a page are wanted that for a page.
/// @param prefix   of the files' names
/// @param tableOf  what fits a room
template <typename TableOf>
void writeTables(const std::string& prefix, const PaperOptions& options, const TableOf& tableOf,
                 RunFolder& folder) {
  const auto write = [&](const std::string& name, PaperWidth width) {
    const TabularRoom room = roomOf(width, options.fontSize);
    folder.write(prefix + name, latexTabular(tableOf(room), room));
  };
  write("table.tex", PaperWidth::column);
  const bool isWide = std::find(options.widths.begin(), options.widths.end(), PaperWidth::page) !=
                      options.widths.end();
  if (isWide) write("table-page.tex", PaperWidth::page);
}

}  // namespace

void writePaperFiles(const study::StudyRecord& record, const PaperOptions& options,
                     RunFolder& folder) {
  const std::vector<study::RankedMethod> ranked = study::rankMethods(record);
  Table table =
      withRows(withColumns(rankedTable(record, ranked), options.columns), options.methods);
  writeTables(
      "", options, [&](const TabularRoom&) { return table; }, folder);
  folder.write("numbers.tex", numbersTex(record, ranked));
  if (options.widths.empty()) return;
  const auto shown = plottedMethods(study::studyMeans(record), options.methods);
  writeFigures(studyPlots(record, shown), options, folder);
}

void writePaperFiles(const study::SweepRecord& sweep, const PaperOptions& options,
                     RunFolder& folder) {
  const study::SweepRecord chosen = withMethods(sweep, options.methods);
  writeTables(
      "", options, [&](const TabularRoom& room) { return sweepPaperTable(chosen, room); }, folder);
  folder.write("numbers.tex", numbersTex(sweep));
  if (options.widths.empty()) return;
  const auto shown = plottedMethods(study::studyMeans(sweep), options.methods);
  writeFigures(sweepPlots(sweep, shown), options, folder);
}

void writePaperFiles(const study::SuiteStatistics& statistics, const PaperOptions& options,
                     RunFolder& folder) {
  Table table =
      withRows(withColumns(suiteRankedTable(statistics), options.columns), options.methods);
  writeTables(
      "suite-", options, [&](const TabularRoom&) { return table; }, folder);
  folder.write("suite-numbers.tex", numbersTex(statistics));
  if (options.widths.empty()) return;
  writeFigures(suitePlots(statistics, plottedMethods(statistics, options.methods)), options,
               folder);
}

namespace {

/// The rows whose method is among the labels.
template <typename Rows, typename ValueIn>
Rows rowsOf(const Rows& rows, const std::vector<std::string>& labels, const ValueIn& valueIn) {
  Rows kept;
  for (const auto& row : rows) {
    if (contains(labels, valueIn(row))) kept.push_back(row);
  }
  return kept;
}

template <typename Rows>
bool holdsAny(const Rows& methods, const std::vector<std::string>& labels) {
  return std::any_of(methods.begin(), methods.end(),
                     [&](const auto& method) { return contains(labels, method.label); });
}

constexpr auto methodIn = [](const auto& row) { return row.method; };
constexpr auto labelIn = [](const auto& row) { return row.label; };

study::StudyRecord ofMethods(const study::StudyRecord& record,
                             const std::vector<std::string>& labels) {
  study::StudyRecord kept;
  kept.name = record.name;
  kept.title = record.title;
  kept.truth = record.truth;
  kept.atlasViews = record.atlasViews;
  const bool isChoice = holdsAny(record.methods, labels);
  std::vector<std::string> all;
  for (const study::MethodRecord& method : record.methods) all.push_back(method.label);
  const std::vector<std::string>& shown = isChoice ? labels : all;
  kept.methods = rowsOf(record.methods, shown, labelIn);
  kept.results = rowsOf(record.results, shown, methodIn);
  kept.confidence = rowsOf(record.confidence, shown, methodIn);
  kept.cost = rowsOf(record.cost, shown, methodIn);
  return kept;
}

}  // namespace

study::SweepRecord withMethods(const study::SweepRecord& sweep,
                               const std::vector<std::string>& labels) {
  study::SweepRecord kept;
  kept.name = sweep.name;
  kept.title = sweep.title;
  kept.keys = sweep.keys;
  kept.cases = sweep.cases;
  kept.hasStepReports = sweep.hasStepReports;
  for (const study::StudyRecord& step : sweep.steps) {
    kept.steps.push_back(ofMethods(step, labels));
  }
  return kept;
}

std::vector<std::string> paperPdfs(const std::vector<LinePlot>& plots, PaperWidth width,
                                   double fontSize) {
  constexpr double inch = 25.4;  // millimetres
  const double points = millimetresOf(width) * pointsOfMillimetre;
  std::vector<std::string> scripts;
  for (const LinePlot& plot : plots) {
    std::size_t longest = 24;  // "uncertainty of the truth"
    for (const PlotCurve& curve : plot.curves) {
      longest = std::max(longest, displayWidth(shortLegend(curve.label)));
    }
    // A character is half as wide as the font is high; the symbol takes as much as six.
    const double room = points / (0.5 * fontSize * static_cast<double>(longest + 6));
    const auto columns = static_cast<std::size_t>(std::clamp(room, 1.0, 4.0));
    const std::size_t rows = (plot.curves.size() + columns) / columns;
    const double height = (width == PaperWidth::column ? 70 : 84) +
                          1.3 * fontSize * static_cast<double>(rows) / pointsOfMillimetre;
    // At 0.8 its points are points. Small letters of the usual plain fonts are higher than a
    // paper's: at 0.68 they look alike.
    scripts.push_back(
        fmt::format("set encoding utf8\nset terminal pdfcairo size {:.3f}in,{:.3f}in noenhanced "
                    "font 'sans-serif,{:g}' fontscale 0.68 linewidth 0.5\n{}",
                    millimetresOf(width) / inch, height / inch, fontSize,
                    paperCommands(plot, fontSize, columns)));
  }
  return undatedPdfs(scripts);
}

}  // namespace gnomon::report
