#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "cache/content_key.h"
#include "common/mask.h"
#include "study/run/scene/base_case.h"
#include "study/spec/study_file.h"

namespace gnomon::study {

/// A mask that another program drew for the samples of a view under one light.
struct GivenMask {
  std::filesystem::path path;
  Mask mask;
  Visibility shares = {};  ///< under a light with a disc, in place of the mask
};

/// All masks of a method, the lights of the first view first.
using GivenMasks = std::vector<GivenMask>;

/// Reads the masks of a method.
/// @param base  whose views they must fit
/// @throws InputError as `givenMaskFiles`, `readMaskPicture` and `readSharePicture`, and for
/// another size than the view's
GivenMasks readGivenMasks(const StudySpec& study, const MethodSpec& method, const BaseCase& base);

/// The mask of a view under one light.
const GivenMask& maskOf(const GivenMasks& masks, const StudySpec& study, std::size_t view,
                        std::size_t light);

/// What the masks hold, whatever their files are called.
cache::ContentKey keyOf(const GivenMasks& masks);

}  // namespace gnomon::study
