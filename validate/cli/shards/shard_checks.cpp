#include "cli/shards/shard_checks.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "cli/shards/case_list.h"
#include "cli/shards/shard_run.h"
#include "cli/study_plans.h"
#include "common/error.h"
#include "common/parallel.h"
#include "report/text/number_text.h"
#include "study/run/scene/environment.h"

namespace gnomon::cli {
namespace fs = std::filesystem;
namespace {

std::string nameOf(const ShardFolder& shard) {
  return fmt::format("{}: shard {}", shard.path.string(), shardText(shard.manifest.shard));
}

/// The command that makes a shard again where it lies, as the others were made.
std::string madeAgain(const ShardFolder& shard, const ShardManifest& common) {
  return commandOf(common, shard.manifest.shard, shard.path.string());
}

bool isOfCommand(const ShardManifest& manifest, const ShardManifest& common) {
  return manifest.shard.count == common.shard.count && settingsOf(manifest) == settingsOf(common);
}

std::string programText(const std::string& version, const std::string& commit) {
  return commit.empty() ? version : version + " " + commit;
}

/// What a shard was made by or of that differs from the others; empty for nothing.
std::string foreignness(const ShardManifest& manifest, const ShardManifest& common) {
  if (manifest.shard.count != common.shard.count) {
    return fmt::format("is one of {} shards, of {} expected", manifest.shard.count,
                       common.shard.count);
  }
  if (!isOfCommand(manifest, common)) {
    return fmt::format("is of `{}`, of `{}` expected", commandText(settingsOf(manifest)),
                       commandText(settingsOf(common)));
  }
  if (manifest.version != study::programVersion() || manifest.commit != study::programCommit()) {
    return fmt::format("was made by Gnomon {}, by this one, {}, expected",
                       programText(manifest.version, manifest.commit),
                       programText(study::programVersion(), study::programCommit()));
  }
  return "";
}

/// Where a shard that is missing may go: beside the others.
fs::path placeOf(const Shard& shard, const fs::path& other) {
  fs::path beside = other.lexically_normal();
  if (!beside.has_filename()) beside = beside.parent_path();  // a slash at the end
  return beside.parent_path() / fmt::format("shard-{}-of-{}", shard.index, shard.count);
}

/// `gnomon merge` of the folders but one.
std::string mergeWithout(const std::vector<ShardFolder>& shards, const ShardFolder& left,
                         const std::string& out) {
  Arguments words = {"merge"};
  for (const ShardFolder& shard : shards) {
    if (&shard != &left) words.push_back(shard.path.string());
  }
  words.insert(words.end(), {"--out", out});
  return commandText(words);
}

/// What the shard's studies have that differs from the files as they are now.
std::string studyChange(const ShardManifest& manifest, const std::vector<study::StudyPlan>& plans) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const ShardManifest::Study expected = manifestStudy(plans[i]);
    if (i < manifest.studies.size() && manifest.studies[i] == expected) continue;
    return fmt::format("was made of another text of {}", expected.file);
  }
  return manifest.studies.size() == plans.size() ? "" : "was made of other studies";
}

/// The cases that a shard must have, as the studies are now.
std::vector<ShardManifest::Case> expectedCases(const std::vector<study::StudyPlan>& plans,
                                               const std::vector<CasePlace>& places) {
  std::vector<ShardManifest::Case> cases(places.size());
  parallelFor(0, places.size(), [&](std::size_t i) {
    const study::StudySpec& step = plans[places[i].plan].steps[places[i].step];
    cases[i] = {step.name, inStudy(step, [&] { return caseHash(step); })};
  });
  return cases;
}

std::string caseChange(const ShardManifest& manifest,
                       const std::vector<ShardManifest::Case>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (i >= manifest.cases.size() || manifest.cases[i].name != expected[i].name) {
      return fmt::format("has other cases: {} is not where it is expected", expected[i].name);
    }
    if (manifest.cases[i].sha256 != expected[i].sha256) {
      return fmt::format("was made of other files or settings of {}", expected[i].name);
    }
  }
  return manifest.cases.size() == expected.size() ? "" : "has more cases than it should";
}

/// Adds the whole cases of a shard. @return what is missing; empty for nothing
std::string addCases(const ShardFolder& shard, std::map<std::string, FoundCase>& found) {
  const std::vector<ShardManifest::Case>& cases = shard.manifest.cases;
  std::vector<std::optional<KeptCase>> kept(cases.size());
  parallelFor(0, cases.size(), [&](std::size_t i) {
    kept[i] = findCase(shard.path / cases[i].name, cases[i].sha256);
  });
  std::size_t missing = 0;
  std::string first;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (kept[i]) {
      found.insert_or_assign(cases[i].name,
                             FoundCase{shard.path / cases[i].name, std::move(*kept[i])});
    } else if (missing++ == 0) {
      first = cases[i].name;
    }
  }
  return missing == 0 ? ""
                      : fmt::format(
                            "is not whole: {} of its {} cases are missing or damaged, the "
                            "first is {}",
                            report::groupedText(missing), report::groupedText(cases.size()), first);
}

}  // namespace

std::vector<ShardFolder> readShards(const std::vector<fs::path>& folders,
                                    std::vector<Defect>& defects) {
  std::vector<ShardFolder> shards;
  for (const fs::path& folder : folders) {
    try {
      shards.push_back({folder, readManifest(folder)});
    } catch (const InputError& error) {
      defects.push_back({error.what(), ""});
    }
  }
  return shards;
}

const ShardManifest& commonManifest(const std::vector<ShardFolder>& shards) {
  const auto others = [&](const ShardFolder& shard) {
    return std::count_if(shards.begin(), shards.end(), [&](const ShardFolder& other) {
      return isOfCommand(other.manifest, shard.manifest);
    });
  };
  return std::max_element(shards.begin(), shards.end(),
                          [&](const auto& a, const auto& b) { return others(a) < others(b); })
      ->manifest;
}

std::vector<ShardFolder> checkedShards(const std::vector<ShardFolder>& shards,
                                       const ShardManifest& common, const std::string& out,
                                       std::vector<Defect>& defects) {
  std::map<int, const ShardFolder*> byIndex;
  for (const ShardFolder& shard : shards) {
    const std::string difference = foreignness(shard.manifest, common);
    const bool hasPlace = shard.manifest.shard.count == common.shard.count;
    if (!difference.empty()) {
      defects.push_back({nameOf(shard) + " " + difference,
                         hasPlace ? madeAgain(shard, common) : mergeWithout(shards, shard, out)});
    }
    if (!hasPlace) continue;
    const auto [first, isNew] = byIndex.try_emplace(shard.manifest.shard.index, &shard);
    if (isNew) continue;
    defects.push_back(
        {fmt::format("{} is there twice, in {} too", nameOf(shard), first->second->path.string()),
         mergeWithout(shards, shard, out)});
  }
  std::vector<ShardFolder> checked;
  for (int index = 1; index <= common.shard.count; ++index) {
    const auto found = byIndex.find(index);
    if (found != byIndex.end()) {
      if (foreignness(found->second->manifest, common).empty()) checked.push_back(*found->second);
      continue;
    }
    const Shard missing{index, common.shard.count};
    defects.push_back({fmt::format("shard {} is missing", shardText(missing)),
                       commandOf(common, missing, placeOf(missing, shards.front().path).string())});
  }
  return checked;
}

std::map<std::string, FoundCase> findCases(const std::vector<ShardFolder>& shards,
                                           const ShardManifest& common,
                                           const std::vector<study::StudyPlan>& plans,
                                           std::vector<Defect>& defects) {
  const auto places = casesOfShards(plans, common.shard.count);
  std::map<std::string, FoundCase> found;
  for (const ShardFolder& shard : shards) {
    std::string defect = studyChange(shard.manifest, plans);
    if (defect.empty()) {
      const auto& own = places.at(static_cast<std::size_t>(shard.manifest.shard.index - 1));
      defect = caseChange(shard.manifest, expectedCases(plans, own));
    }
    if (defect.empty()) defect = addCases(shard, found);
    if (defect.empty()) continue;
    defects.push_back({nameOf(shard) + " " + defect, madeAgain(shard, common)});
  }
  return found;
}

}  // namespace gnomon::cli
