#include "cli/shards/kept_case.h"

#include <toml++/toml.h>

#include <sstream>

#include "cache/entry.h"
#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/text/sha256.h"
#include "study/record/record_fields.h"
#include "study/run/scene/environment.h"
#include "study/spec/resolved_study.h"
#include "study/spec/study_inputs.h"
#include "study/spec/study_text.h"

/// Where the streams look it up.
namespace gnomon::cache {

template <typename Stream, SameAs<ContentKey> T>
void fields(Stream& stream, T& key) {
  stream(key.high, key.low);
}

}  // namespace gnomon::cache

namespace gnomon::cli {
namespace fs = std::filesystem;

template <typename Stream, cache::SameAs<KeptFile> T>
void fields(Stream& stream, T& file) {
  stream(file.name, file.bytes, file.key);
}

template <typename Stream, cache::SameAs<KeptCase> T>
void fields(Stream& stream, T& kept) {
  stream(kept.record, kept.files);
}

namespace {

/// Another version of the program may have other records.
cache::ContentKey keyOf(const std::string& hash) {
  cache::KeyBuilder key("case of a shard");
  key.add("version", study::programVersion()).add("commit", study::programCommit());
  return key.add("case", hash).key();
}

std::optional<KeptCase> caseIn(const fs::path& folder, const cache::ContentKey& key) {
  std::error_code failure;
  if (!fs::exists(folder / "summary.json", failure)) return std::nullopt;
  if (!fs::is_regular_file(folder / caseFile, failure)) return std::nullopt;
  const std::string file = readFile(folder / caseFile);
  const auto content = cache::openedEntry(key, file);
  if (!content) return std::nullopt;
  return cache::valueOf<KeptCase>(*content);
}

}  // namespace

std::string caseHash(const study::StudySpec& study) {
  // Relative to the study, wherever that lies.
  const fs::path folder = study::studyFolder(study.file);
  const fs::path home = folder.empty() ? fs::path(".") : folder;
  std::ostringstream text;
  text << study.name << '\n' << study::resolvedStudy(study, home) << '\n';
  for (const study::InputRecord& input : study::studyInputs(study, home)) {
    text << input.file << ' ' << input.sha256 << '\n';
  }
  return sha256(text.str());
}

void keepCase(report::RunFolder& folder, const std::string& hash, const KeptCase& kept) {
  folder.write(caseFile, cache::sealedEntry(keyOf(hash), cache::bytesOf(kept)));
}

std::optional<KeptCase> findCase(const fs::path& folder, const std::string& hash) {
  try {
    std::optional<KeptCase> kept = caseIn(folder, keyOf(hash));
    if (!kept) return std::nullopt;
    for (const KeptFile& file : kept->files) (void)readKept(folder, file);
    return kept;
  } catch (const cache::DamagedBytes&) {
    return std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;  // a file that cannot be read is as good as none
  }
}

std::vector<KeptFile> filesSince(const report::RunFolder& folder,
                                 const std::set<std::string>& before) {
  std::vector<KeptFile> files;
  std::istringstream list(readFile(folder.listFile()));
  for (std::string name; std::getline(list, name);) {
    if (before.contains(name) || !folder.names(name)) continue;
    const std::string bytes = readFile(folder.path() / name);
    files.push_back({name, bytes.size(), cache::keyOfBytes(bytes)});
  }
  return files;
}

std::string readKept(const fs::path& folder, const KeptFile& file) {
  const fs::path path = folder / file.name;
  std::string bytes = readFile(path);
  if (bytes.size() != file.bytes || cache::keyOfBytes(bytes) != file.key) {
    throw InputError(path.string() + ": is not as the shard wrote it");
  }
  return bytes;
}

}  // namespace gnomon::cli
