#pragma once

#include <filesystem>
#include <vector>

#include "common/mask.h"
#include "report/run_folder.h"
#include "study/record/record.h"

namespace gnomon::report {

/// Pictures for references that do not hold: what was committed, what is now, and what changed.

/// The method's mask in a signed difference that a run wrote: see DifferenceColours.
/// @throws InputError naming the file for a picture with any other colour, and as readGreyPicture
Mask maskOfDifference(const std::filesystem::path& path);

/// Keeps the signed differences of a run beside its references.
/// @param folder  of the run
/// @param kept    takes a file a method, view and light, and a list of them (run_folder.h); those
///   of its list before go, and nothing else
/// @throws InputError where a file cannot be read or written, and as RunFolder
void keepReferencePictures(const study::StudyRecord& record, const std::filesystem::path& folder,
                           const std::filesystem::path& kept);

/// A set of pictures for each method, view and light of which a reference fails or is undefined, in
/// the references' order. What was kept is copied into `references/` of the run's folder, and the
/// change drawn beside it: in the colours of a signed difference of the method's mask now from that
/// which was committed, without the samples that only one of them has.
/// @throws InputError where a picture of the run cannot be read or one cannot be written
std::vector<study::ReferencePictures> drawReferencePictures(const study::StudyRecord& record,
                                                            RunFolder& folder,
                                                            const std::filesystem::path& kept);

}  // namespace gnomon::report
