#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cache/content_key.h"
#include "report/run_folder.h"
#include "study/record/record.h"
#include "study/spec/study_file.h"

namespace gnomon::cli {

/// What a shard keeps of a case for the merge: all that was found, to the bit, in one file of the
/// case's folder, and the names and checksums of the pictures beside it. The file is one that the
/// same version of the program reads: an entry as those of the cache, with a checksum.

/// A file that was written as the case was measured.
struct KeptFile {
  std::string name;  ///< relative to the case's folder
  std::uint64_t bytes = 0;
  cache::ContentKey key;  ///< of its bytes
};

struct KeptCase {
  study::StudyRecord record;  ///< as it was measured: no claim is judged
  std::vector<KeptFile> files;
};

constexpr const char* caseFile = "case.record";

/// The SHA-256 of all that a case is made of but the program: its name, its study with every
/// setting that holds, and its files (resolvedStudy, studyInputs), wherever they lie.
std::string caseHash(const study::StudySpec& study);

/// Writes a case's file.
/// @param hash  as caseHash
void keepCase(report::RunFolder& folder, const std::string& hash, const KeptCase& kept);

/// The case in a folder, if it is whole: its report is written to the end, it is of this hash and
/// of this version of the program, and all its files are as they were written.
std::optional<KeptCase> findCase(const std::filesystem::path& folder, const std::string& hash);

/// The files of a folder that came into its list since it had these names, in the order in which
/// they did: the merged folder's list is to have the same.
std::vector<KeptFile> filesSince(const report::RunFolder& folder,
                                 const std::set<std::string>& before);

/// The bytes of a file of a case.
/// @throws InputError where it is not as it was written
std::string readKept(const std::filesystem::path& folder, const KeptFile& file);

}  // namespace gnomon::cli
