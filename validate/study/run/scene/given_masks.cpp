#include "study/run/scene/given_masks.h"

#include <fmt/core.h>

#include <utility>

#include "common/error.h"
#include "image/mask_picture.h"
#include "study/spec/mask_files.h"

namespace gnomon::study {

GivenMasks readGivenMasks(const StudySpec& study, const MethodSpec& method, const BaseCase& base) {
  GivenMasks masks;
  for (const GivenMaskFile& file : givenMaskFiles(study, method)) {
    const surface::SampleGrid& samples = base.views[file.view].samples;
    Mask mask = image::readMaskPicture(file.path).mask;
    if (mask.width != samples.width || mask.height != samples.height) {
      throw InputError(
          fmt::format("{}: {} × {} pixels found, {} × {} expected, as view \"{}\" has{}",
                      file.path.string(), mask.width, mask.height, samples.width, samples.height,
                      study.views[file.view].name, study.quick ? " in the quick form" : ""));
    }
    masks.push_back({file.path, std::move(mask)});
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
  }
  return key.key();
}

}  // namespace gnomon::study
