#pragma once

#include <filesystem>
#include <vector>

#include "image/images.h"
#include "report/run_folder.h"
#include "study/record/record.h"
#include "truth/shadow_tracer.h"

namespace gnomon::report {

/// The picture of the displaced surface by its own rays, shaded as the base mesh is, so that both
/// can be held side by side; background white.
/// @param light  as displacedPicture gives it, one a pixel, row 0 at the top
image::Image displacedImage(int width, int height, const std::vector<float>& light);

/// The colour of a region in a picture of regions. Exact, so that the picture can be read back.
image::Rgb regionColour(truth::Region region);

/// In which region each sample of a truth lies, by its colour; its place among the colours is the
/// region's number.
image::PaletteImage regionImage(const truth::Truth& truth);

/// Pictures for references that do not hold: what was committed, what is now, and what changed.

/// Keeps the signed differences of a run beside its references.
/// @param folder  of the run
/// @param kept    takes a file a method, view and light, and a list of them (run_folder.h); those
///   of its list before go, and nothing else
/// @throws InputError where a file cannot be read or written, and as RunFolder
void keepReferencePictures(const study::StudyRecord& record, const std::filesystem::path& folder,
                           const std::filesystem::path& kept);

/// A set of pictures for each method, view and light of which a reference fails or is undefined, in
/// the references' order. What was kept is copied into `references/` of the run's folder, and the
/// change drawn beside it: in the colours of a signed difference of the method's mask now, or its
/// shares, from those that were committed, without the samples that only one of them has.
/// @throws InputError where a picture cannot be read, as `image::sharesOfDifference`, or written
std::vector<study::ReferencePictures> drawReferencePictures(const study::StudyRecord& record,
                                                            RunFolder& folder,
                                                            const std::filesystem::path& kept);

}  // namespace gnomon::report
