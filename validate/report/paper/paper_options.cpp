#include "report/paper/paper_options.h"

namespace gnomon::report {

const char* paperWidthName(PaperWidth width) {
  return width == PaperWidth::column ? "column" : "page";
}

double millimetresOf(PaperWidth width) {
  return width == PaperWidth::column ? 84 : 178;
}

TabularRoom roomOf(PaperWidth width, double fontSize) {
  return {width == PaperWidth::column ? inColumn : onPaper,
          millimetresOf(width) * pointsOfMillimetre, fontSize};
}

}  // namespace gnomon::report
