#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/confidence_interval.h"
#include "compare/counts.h"

namespace gnomon::report {

/// A table as data. The functions `…Table` make one of a record; the formats (formats.h) print it:
/// any format prints any table.

/// The kind of values in a column. It decides how they are printed and on which side of the column.
enum class Quantity {
  name,           ///< what the row is about; text, at the left as all text
  text,           ///< any other text
  code,           ///< text in letters of one width
  rank,           ///< 1, 2, …; at the left
  percent,        ///< a share, 0 to 1, in percent: percentText
  signedPercent,  ///< likewise with its sign: signedPercent
  interval,       ///< both ends in percent: intervalText
  correlation,    ///< -1 to 1: correlationText
  ratio,          ///< two decimals: ratioText
  times,          ///< likewise with ×
  count,          ///< an integer with its thousands apart
  bytes,          ///< with a decimal unit: formatBytes
  megabytes,      ///< bytes, read as MB with two decimals
  decimals,       ///< two decimals
  exact,          ///< the shortest text that reads back as the same number
};

/// The readers that see a column, as bits.
enum Readers : unsigned {
  onTerminal = 1,
  onPage = 2,
  onPaper = 4,    ///< LaTeX as wide as a page, and Markdown
  asData = 8,     ///< CSV
  inColumn = 16,  ///< LaTeX in a column of a page
  byAll = onTerminal | onPage | onPaper | asData | inColumn,
};

struct Column {
  std::string name;      ///< heading for people: "False shadow"
  std::string key = {};  ///< heading for programs: "false_shadow"; else the name
  Quantity quantity = Quantity::text;
  unsigned readers = byAll;
  std::string unit = {};       ///< stands in the heading: "ms"
  std::string note = {};       ///< small under the heading, on a page
  std::string about = {};      ///< shown when a reader points at the heading
  std::string link = {};       ///< where the heading leads, on a page
  std::size_t width = 0;       ///< that a terminal gives it at least, with its gap
  std::size_t markWidth = 0;   ///< room behind the figures for their marks, on a terminal
  std::string shortName = {};  ///< heading in a column of a paper, with its unit
  bool isMain = false;         ///< the main column of the table: bold on a page
};

enum class Emphasis { none, strong, quiet, good, bad, open };

/// Parts of an error as a bar beside a row's name, on a page: shares of the samples.
struct ErrorBar {
  double error = 0, falseShadow = 0, falseLight = 0;
  std::optional<double> uncertainty = {};  ///< of the truth
  std::optional<compare::Interval> interval = {};
  double scale = 1;  ///< the error at the bar's right end
};

/// One cell. Without a value, an interval or a text it reads "–".
struct Cell {
  std::optional<std::string> text = {};  ///< as people read it; else as the quantity says
  std::optional<double> value = {};
  std::optional<compare::Interval> interval = {};
  std::string about = {};  ///< why there is no value, or what it stands on: seen by pointing at it
  std::string mark = {};   ///< behind the figure, with its space: " ≈"
  std::string note = {};   ///< small below it, on a page
  std::string link = {};   ///< where the text leads, on a page
  std::optional<double> uncertainty = {};  ///< a share: "± 0.30" behind the figure, on a page
  std::optional<double> heat = {};         ///< 0 to 1: how strong a page tints it
  Emphasis emphasis = Emphasis::none;
  std::optional<ErrorBar> bar = {};
};

struct Row {
  std::vector<Cell> cells;  ///< one a column
  std::string mark = {};    ///< of the whole row, with its space: " ≈"
  std::string remark = {};  ///< to be read with the row, in every format for people
  bool isApart = false;     ///< printed below the others, since it cannot be compared with them
};

struct Table {
  std::string kind;          ///< "ranking": its class on a page
  std::string label = {};    ///< what a paper refers to it by
  std::string title = {};    ///< opens its caption on paper
  std::string caption = {};  ///< what the figures are, on paper
  std::vector<Column> columns;
  std::vector<Row> rows = {};
  std::string apart = {};  ///< why rows are apart; printed once before them, on a terminal
  std::vector<std::string> notes = {};  ///< below it, in every format for people
};

/// Cells of one kind each.
Cell textCell(std::string text, std::string about = "");
Cell valueCell(std::optional<double> value, std::string about = "");
Cell countCell(std::size_t count);
Cell flagCell(bool flag);  ///< 1 or 0
Cell intervalCell(const std::optional<compare::Interval>& interval, std::string about = "");
Cell metricCell(const compare::Metric& metric);
/// A share in percent, tinted by its size beside the table's largest.
Cell heatCell(double share, double worst, std::string about);

/// Whether a quantity is text, which stands at the left.
bool isText(Quantity quantity);

/// A cell's text for people, without its marks: "9.80", "–".
/// @throws InternalError for a number that is not finite
std::string cellText(Quantity quantity, const Cell& cell);

/// A column's heading for people: "Frame, ms".
std::string heading(const Column& column);

/// What a row is about: the text of its name; empty in a table without names.
std::string nameOf(const Table& table, const Row& row);

/// The indices of the columns that a reader sees.
/// @throws InternalError for a row that has not one cell a column
std::vector<std::size_t> columnsFor(const Table& table, Readers reader);

/// A table for programs, as RFC 4180 quotes it; lines end in LF. A number is the shortest text that
/// reads back as itself, whatever it reads as for people; what there is none of, an empty cell. An
/// interval takes two columns, `low` and `high`, after its column's key and `_`, if it has one.
///
/// A cell that begins with = + - @ (of full width too), a tab or CR, and is no number, gets an
/// apostrophe before it: spreadsheets would take it for a formula. What `xmlText` refuses becomes
/// U+FFFD.
/// @throws InternalError for a number that is not finite
std::string csvTable(const Table& table);

/// Text that stands for itself in a cell of a GitHub-flavoured Markdown table, on one line: what
/// Markdown or HTML would read is escaped, and no @name or #1 in it notifies or links anybody.
std::string escapeMarkdown(std::string_view text);

/// A table for a pull request, a README or a notebook, as GitHub-flavoured Markdown: the title and
/// the caption, the table, then the rows' remarks.
/// @throws InternalError for a number that is not finite
std::string markdownTable(const Table& table);

/// One way to print any table.
struct TableFormat {
  std::string_view name;  ///< as files of the format end
  std::string (*print)(const Table&);
  bool isFile;  ///< a run writes its ranked table in it, as `table.NAME`; LaTeX: see paper_files.h
};

/// All formats of tables. A new one is a file beside these and a line in formats.cpp.
std::span<const TableFormat> tableFormats();

}  // namespace gnomon::report
