#include "viewer/session/view_state.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/error.h"

namespace gnomon::app {

namespace {

constexpr std::string_view truthName = "truth";
constexpr std::string_view displacedName = "displaced";

std::optional<PaneSource> parseSource(const std::string& text,
                                      const std::vector<std::string>& labels) {
  if (std::find(labels.begin(), labels.end(), text) != labels.end()) return methodSource(text);
  if (text == truthName) return tracedTruth;
  if (text == displacedName) return displacedSurface;
  return std::nullopt;
}

}  // namespace

std::string sourceText(const PaneSource& source) {
  if (source.isMethod()) return source.label;
  return std::string(source == tracedTruth ? truthName : displacedName);
}

std::string contentText(const PaneContent& content) {
  const std::string shown = sourceText(content.shown);
  return content.against ? shown + ":" + sourceText(*content.against) : shown;
}

PaneContent parseContent(const std::string& text, const std::vector<std::string>& labels) {
  if (auto source = parseSource(text, labels)) return {std::move(*source)};
  for (std::size_t colon = text.find(':'); colon != std::string::npos;
       colon = text.find(':', colon + 1)) {
    auto shown = parseSource(text.substr(0, colon), labels);
    auto against = parseSource(text.substr(colon + 1), labels);
    const bool areMasks =
        shown && against && *shown != displacedSurface && *against != displacedSurface;
    if (areMasks) return {std::move(*shown), std::move(against)};
  }
  throw UsageError(
      fmt::format("--show {}: truth, displaced, a method or the difference of two, as "
                  "onoue-2004:truth, expected. Methods: {}",
                  text, fmt::join(labels, ", ")));
}

bool sameCamera(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.target == b.target && a.up == b.up && a.width == b.width &&
         a.height == b.height && a.verticalFov == b.verticalFov;
}

std::vector<std::string> shownMethods(const ViewState& state) {
  std::vector<std::string> labels;
  for (int i = 0; i < state.paneCount; ++i) {
    const PaneContent& pane = state.panes.at(static_cast<std::size_t>(i));
    for (const PaneSource& source : {pane.shown, pane.against.value_or(tracedTruth)}) {
      if (!source.isMethod()) continue;
      if (std::find(labels.begin(), labels.end(), source.label) == labels.end()) {
        labels.push_back(source.label);
      }
    }
  }
  return labels;
}

bool needsTruth(const PaneContent& content) {
  // A method on its own is measured against the truth, too.
  return content.shown != displacedSurface;
}

}  // namespace gnomon::app
