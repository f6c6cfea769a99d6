#include "viewer/view_state.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/error.h"

namespace gnomon {

bool isMethod(std::string_view name) {
  return !name.empty() && name != PaneContent::truth && name != PaneContent::displaced;
}

std::string contentText(const PaneContent& content) {
  return content.isDifference() ? content.shown + ":" + content.against : content.shown;
}

PaneContent parseContent(const std::string& text, const std::vector<std::string>& labels) {
  const auto isKnown = [&](const std::string& name, bool operand) {
    return name == PaneContent::truth || (!operand && name == PaneContent::displaced) ||
           std::find(labels.begin(), labels.end(), name) != labels.end();
  };
  if (isKnown(text, false)) return {text, {}};
  for (std::size_t colon = text.find(':'); colon != std::string::npos;
       colon = text.find(':', colon + 1)) {
    PaneContent content{text.substr(0, colon), text.substr(colon + 1)};
    if (isKnown(content.shown, true) && isKnown(content.against, true)) return content;
  }
  throw UsageError(
      fmt::format("--show {}: truth, displaced, a method or the difference of two, as "
                  "onoue-2004:truth, expected. Methods: {}",
                  text, fmt::join(labels, ", ")));
}

std::vector<std::string> shownMethods(const ViewState& state) {
  std::vector<std::string> labels;
  for (int i = 0; i < state.paneCount; ++i) {
    const PaneContent& pane = state.panes.at(static_cast<std::size_t>(i));
    for (const std::string& name : {pane.shown, pane.against}) {
      if (isMethod(name) && std::find(labels.begin(), labels.end(), name) == labels.end()) {
        labels.push_back(name);
      }
    }
  }
  return labels;
}

bool needsTruth(const PaneContent& content) {
  // A method on its own is measured against the truth, too.
  return content.shown != PaneContent::displaced;
}

}  // namespace gnomon
