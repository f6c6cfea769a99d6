#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "report/plots/plot_sheet.h"
#include "study/judge/study_means.h"
#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

// How plots draw methods. A method looks the same in every plot of every report: its colour is that
// of its family, its symbol and dashes follow from its file, its name and its label alone.

/// The colour of a family on a white and on a dark page.
struct FamilyColours {
  std::string_view family;  ///< as render::methodFamilies has it; "own" of files that name none
  std::string_view onWhite, onDark;
};

/// The families' colours. Any two, and grey, differ by 20 or more in CIELAB to eyes with full
/// colour vision and to those with protanopia, deuteranopia or tritanopia (Machado, Oliveira &
/// Fernandes 2009, severity 1), and stand out from their page by a contrast of 3 or more (WCAG 2).
constexpr std::array<FamilyColours, 8> familyColours = {{
    {"control", "#1a1d21", "#e8eaed"},
    {"flat", "#c57500", "#c16309"},
    {"curvature", "#01684d", "#03ca87"},
    {"march", "#2a80ff", "#187cf5"},
    {"displaced", "#611263", "#ff89e8"},
    {"engine", "#ad8b58", "#d9bb05"},
    {"ours", "#840000", "#c9143e"},
    {"own", "#0e249b", "#884ea3"},
}};

/// The grey of the methods that a plot does not highlight.
constexpr FamilyColours otherMethods = {"other", "#8b929b", "#7b828b"};

/// How a method is drawn.
struct MethodStyle {
  std::string family;  ///< one of familyColours
  int point = 7;       ///< gnuplot's number of a point's shape
  int dash = 1;        ///< gnuplot's number of a line's dashes; 1 is solid
  bool operator==(const MethodStyle&) const = default;
};

/// A method under its own name has its file's symbol, filled, and a solid line. A variant, which is
/// any other label, has an outlined symbol and dashes that follow from its label. Where a file
/// names no symbol, that follows from the method's name.
/// @param name   the method's own
/// @param label  of its entry in the study
MethodStyle methodStyle(const std::string& name, const std::string& label,
                        const render::MethodMark& mark);

/// A method in a legend.
struct LegendEntry {
  std::string label;
  std::string text;  ///< the label, or more
};

/// The styles of a report's methods, and which of them it highlights. A label that is none of them
/// is drawn in grey.
class MethodStyles {
 public:
  /// @param study  of a run or a sweep
  explicit MethodStyles(const study::StudyMeans& study);
  explicit MethodStyles(const study::SuiteStatistics& statistics);

  [[nodiscard]] const std::vector<std::string>& highlighted() const { return highlighted_; }
  [[nodiscard]] bool isHighlighted(const std::string& label) const;
  /// The variable of its colour.
  [[nodiscard]] std::string variable(const std::string& label) const;
  /// Its colour, a gnuplot clause.
  [[nodiscard]] std::string colour(const std::string& label) const;
  /// The style of a line with points, a gnuplot clause.
  [[nodiscard]] std::string line(const std::string& label) const;
  /// Of a line alone, and of points alone.
  [[nodiscard]] std::string stroke(const std::string& label) const;
  [[nodiscard]] std::string points(const std::string& label) const;
  /// Of points that stand for all entries of a method: its own symbol, the colour of one of them.
  [[nodiscard]] std::string pointsOfMethod(const std::string& label) const;
  /// The colours that these clauses use, for the sheet.
  [[nodiscard]] std::vector<PlotColour> colours() const;
  /// A list of labels in the order to draw them: the highlighted ones last, so that no grey line
  /// hides them. Legends have them the other way round.
  [[nodiscard]] std::vector<std::string> drawnOrder(std::vector<std::string> labels) const;
  /// Entries of a legend, ", keyentry …" of a plot command: the highlighted ones first, else in the
  /// order given.
  /// @param style  of this class: `&MethodStyles::line`
  [[nodiscard]] std::string legend(const std::vector<LegendEntry>& entries, const char* with,
                                   std::string (MethodStyles::*style)(const std::string&)
                                       const) const;
  /// The same for a page.
  /// @param hasLine  whether the plot joins the method's values
  [[nodiscard]] std::vector<LegendItem> items(const std::vector<LegendEntry>& entries,
                                              bool hasLine) const;

 private:
  struct Styled {
    std::string label;
    MethodStyle style;
    MethodStyle own;  ///< under the method's own name
  };
  [[nodiscard]] std::string pointClause(const std::string& label, const MethodStyle& style) const;
  /// Of an unknown label the last.
  [[nodiscard]] std::size_t indexOf(const std::string& label) const;

  std::vector<Styled> methods_;  ///< and a last one, for labels that are none of theirs
  std::vector<std::string> highlighted_;
};

}  // namespace gnomon::report
