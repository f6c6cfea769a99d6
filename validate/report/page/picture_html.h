#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report/page/html_page.h"
#include "report/text/html.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The methods that a page's pictures are about.
struct ShownMethods {
  std::vector<std::string> labels;  ///< those that are seen at once (plottedMethods)
  std::optional<std::string> best;  ///< that the comparison of two pictures opens on
};
ShownMethods shownMethods(const study::StudyRecord& record);

/// The pictures of one case as lettered figures, first of the methods that are shown at once and of
/// the truth, then of the others, folded; each in the order of the record: the shading, under it
/// the signed difference (or, for the truth, the displaced surface as one sees it), and a caption
/// with the method's error rate. Before them what the colours of the differences mean. Pictures are
/// embedded as base64; `folder` is where their paths start.
/// @throws InputError if a difference or the truth's mask cannot be read, InternalError if it is no
///   PNG
Html panelFigures(const study::StudyRecord& record, const study::PanelRecord& panel,
                  const ShownMethods& shown, const std::filesystem::path& folder);

/// The comparison of any two of these pictures.
PageSection viewerSection();

/// A picture's file as an address that a page embeds, byte for byte.
/// @throws InputError if it cannot be read, InternalError if it is no PNG
Html pngAddress(const std::filesystem::path& path);

/// CSS properties --false-shadow, --false-light, --both-lit, --both-shadowed: the colours that the
/// difference pictures hold.
Html differenceProperties();

/// A method's error in a panel's view and light, as captions show it; of "truth" its uncertainty.
Html pictureRate(const study::StudyRecord& record, const study::PanelRecord& panel,
                 const std::string& method);

}  // namespace gnomon::report
