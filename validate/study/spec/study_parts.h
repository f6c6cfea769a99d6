#pragma once

#include <map>
#include <memory>
#include <string>

#include "horizon/search_radius.h"
#include "relief/relief.h"
#include "study/spec/sections/method_section.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"

namespace gnomon::study {

/// What the cases of a sweep share: parts that one study was read with, for the next one whose
/// tables say the same. A part is looked up by the text of the tables that it follows from. Maps
/// are not copied: studies share their texels.
struct StudyParts {
  /// The last surface: a sweep seldom comes back to one.
  std::string surfaceKey = {};
  std::shared_ptr<const surface::Cage> cage = {};
  std::shared_ptr<const surface::LimitSurface> limit = {};
  std::map<std::string, relief::Relief> reliefs = {};  ///< without their borders
  std::map<std::string, horizon::SearchRadius> radii = {};
  DeclaredMethods methods = {};
};

}  // namespace gnomon::study
