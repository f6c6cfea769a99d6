#include "study/run/scene/given_masks.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "common/error.h"
#include "image/mask_picture.h"
#include "study/spec/sections/method_section.h"

namespace gnomon::study {

GivenMasks readGivenMasks(const StudySpec& study, const MethodSpec& method, const BaseCase& base) {
  GivenMasks masks;
  for (const GivenMaskFile& file : givenMaskFiles(study, method)) {
    const surface::SampleGrid& samples = base.views[file.view].samples;
    GivenMask given{file.path, {}};
    if (study.lights[file.light].isSoft()) {
      given.shares = image::readSharePicture(file.path);
    } else {
      given.mask = image::readMaskPicture(file.path).mask;
    }
    const int width = std::max(given.mask.width, given.shares.width);
    const int height = std::max(given.mask.height, given.shares.height);
    if (width != samples.width || height != samples.height) {
      throw InputError(
          fmt::format("{}: {} × {} pixels found, {} × {} expected, as view \"{}\" has{}",
                      file.path.string(), width, height, samples.width, samples.height,
                      study.views[file.view].name, study.quick ? " in the quick form" : ""));
    }
    masks.push_back(std::move(given));
  }
  return masks;
}

const GivenMask& maskOf(const GivenMasks& masks, const StudySpec& study, std::size_t view,
                        std::size_t light) {
  return masks.at(view * study.lights.size() + light);
}

cache::ContentKey keyOf(const GivenMasks& masks) {
  cache::KeyBuilder key("given masks");
  for (const GivenMask& given : masks) {
    key.add("width", given.mask.width).add("height", given.mask.height);
    key.add("samples", given.mask.samples);
    if (given.shares.size() > 0) key.add("shares", given.shares.shares);
  }
  return key.key();
}

}  // namespace gnomon::study
