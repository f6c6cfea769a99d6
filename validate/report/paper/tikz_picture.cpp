#include "report/paper/tikz_picture.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "common/error.h"
#include "report/text/latex_text.h"

namespace gnomon::report {
namespace {

constexpr std::string_view begin = "\\begin{tikzpicture}";

/// gnuplot's commands, all that its style file (gnuplot-lua-tikz) defines for lines, points, areas
/// and texts. They hold inside the picture alone.
constexpr std::string_view head =
    R"(% \usepackage{tikz} \usetikzlibrary{plotmarks}
\begin{tikzpicture}[>=stealth,line cap=round,line join=round]
\colorlet{gp lt color border}{black}\colorlet{gp lt color axes}{black!30}
\tikzset{
  global rgb color/.code={\definecolor{gp}{rgb}{#1}\color{gp}},
  rgb color/.code={\definecolor{gp}{rgb}{#1}\tikzset{color=gp}},
  global color/.code={\color{#1}},
  gp path/.style={}, gp dashes/.style={solid}, gp point/.style={mark size=1.6pt},
  gp lt axes/.style={}, gp lt border/.style={solid}, gp lt plot/.style={},
  gp node left/.style={anchor=mid west,yshift=-.12ex,inner sep=1pt},
  gp node center/.style={anchor=mid,yshift=-.12ex,inner sep=1pt},
  gp node right/.style={anchor=mid east,yshift=-.12ex,inner sep=1pt},
  gp mark 1/.style={mark=+}, gp mark 2/.style={mark=x}, gp mark 3/.style={mark=star},
  gp mark 4/.style={mark=square}, gp mark 5/.style={mark=square*}, gp mark 6/.style={mark=o},
  gp mark 7/.style={mark=*}, gp mark 8/.style={mark=triangle}, gp mark 9/.style={mark=triangle*},
  gp mark 10/.style={mark=triangle,every mark/.append style={rotate=180}},
  gp mark 11/.style={mark=triangle*,every mark/.append style={rotate=180}},
  gp mark 12/.style={mark=diamond}, gp mark 13/.style={mark=diamond*},
  gp mark 14/.style={mark=otimes}, gp mark 15/.style={mark=oplus},
  gp dt solid/.style={solid}, gp dt axes/.style={solid}, gp dt 1/.style={solid},
  gp dt 2/.style={dash pattern=on 4pt off 2.5pt}, gp dt 3/.style={dash pattern=on 1pt off 2pt},
  gp dt 4/.style={dash pattern=on 5pt off 2pt on 1pt off 2pt},
  gp dt 5/.style={dash pattern=on 5pt off 2pt on 1pt off 2pt on 1pt off 2pt}}
\def\gpcolor#1{\tikzset{global #1}}
\def\gpfill#1{\path[fill,#1]}
\def\gpsetlinewidth#1{\pgfsetlinewidth{#1*0.4pt}}
\def\gpsetlinetype#1{\tikzset{gp path/.style={#1}}}
\def\gpsetdashtype#1{\tikzset{gp path/.append style={#1}}}
\def\gpsetpointsize#1{\tikzset{gp point/.style={mark size=#1*0.65pt}}}
\def\gp3point#1#2#3{\path[solid#2] plot[only marks,gp point,mark options={shift only},#1]
  coordinates {#3};}
\def\gppoint#1#2{\path[solid] plot[only marks,gp point,mark options={shift only},#1]
  coordinates {#2};}
)";

/// Without a hyphen for the sign of a number.
std::string signedText(std::string_view text) {
  const bool isNegative = text.size() > 1 && text.front() == '-' &&
                          text.find_first_not_of("0123456789.e-+") == std::string_view::npos;
  return isNegative ? "−" + std::string(text.substr(1)) : std::string(text);
}

/// A node with its text escaped; any other line as it is.
std::string escapedNode(const std::string& line) {
  constexpr std::string_view node = "\\node[";
  constexpr std::string_view end = "};";
  if (!line.starts_with(node) || !line.ends_with(end)) return line;
  const std::size_t place = line.find("] at (");
  const std::size_t open = place == std::string::npos ? place : line.find(") {", place);
  if (open == std::string::npos) return line;
  const std::size_t from = open + 3;
  const std::string text = line.substr(from, line.size() - end.size() - from);
  return line.substr(0, from) + escapeLatex(signedText(text)) + std::string(end);
}

/// Names of parts of the plot that a paper could refer to.
bool isLeftOut(const std::string& line) {
  return line.starts_with("%") || line.starts_with("\\gpdefrectangularnode") ||
         line.starts_with("\\gpsetvar");
}

}  // namespace

std::string tikzPicture(const std::string& drawn) {
  const std::size_t start = drawn.find(begin);
  if (start == std::string::npos) throw InternalError("gnuplot: its TikZ has no picture");
  std::istringstream lines(drawn.substr(drawn.find('\n', start) + 1));
  std::string picture(head);
  for (std::string line; std::getline(lines, line);) {
    if (!isLeftOut(line)) picture += escapedNode(line) + "\n";
  }
  // The end of its last line would be a space beside it.
  return picture.substr(0, picture.find_last_not_of('\n') + 1) + "%\n";
}

}  // namespace gnomon::report
