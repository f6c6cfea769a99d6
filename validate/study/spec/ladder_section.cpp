#include "study/spec/ladder_section.h"

#include <fmt/core.h>

#include <algorithm>

namespace gnomon::study {
namespace {

CauseSpec readCause(const TomlReader& rung, const std::vector<CauseSpec>& before) {
  CauseSpec cause;
  rung.allow(namesOf(keysOf(cause)));
  readKeys(rung, keysOf(cause));
  const bool twice = std::any_of(before.begin(), before.end(),
                                 [&](const CauseSpec& other) { return other.name == cause.name; });
  if (twice)
    rung.fail("cause", fmt::format("\"{}\" found twice, distinct causes expected", cause.name));
  return cause;
}

/// The state after a rung.
MethodSpec climb(const TomlReader& rung, const MethodSpec& from, const MethodDefaults& defaults) {
  const TomlReader set = rung.table("set");
  MethodSpec changed = from;
  KeyNames names = namesOf(keysOf(changed));
  names.erase("label");
  names.erase("masks");
  set.allow(names);
  MethodSpec to = changedMethod(set, from, defaults);
  set.finish();
  if (isSameMethod(from, to)) rung.fail("set", "changes nothing, keys with other values expected");
  return to;
}

LadderSpec readLadder(const TomlReader& section, const StudySpec& study,
                      const MethodDefaults& defaults) {
  LadderSpec ladder;
  std::vector<std::string> labels;
  for (const MethodSpec& method : study.methods) labels.push_back(method.label);
  section.allow(namesOf(keysOf(ladder, labels)));
  readKeys(section, keysOf(ladder, labels));
  const auto method = std::find(labels.begin(), labels.end(), ladder.method) - labels.begin();
  ladder.written = section.written();
  if (study.methods[static_cast<std::size_t>(method)].isGiven()) {
    section.fail("method", fmt::format("\"{}\" is given as masks, a method with a shader expected",
                                       ladder.method));
  }
  const MethodSpec start =
      changedMethod(section, study.methods[static_cast<std::size_t>(method)], defaults);
  ladder.forward.push_back(start);
  ladder.backward.push_back(start);
  const std::vector<TomlReader> rungs = section.tables("rung");
  for (const TomlReader& rung : rungs) {
    ladder.causes.push_back(readCause(rung, ladder.causes));
    ladder.forward.push_back(climb(rung, ladder.forward.back(), defaults));
    rung.finish();
  }
  for (auto rung = rungs.rbegin(); rung != rungs.rend(); ++rung) {
    ladder.backward.push_back(climb(*rung, ladder.backward.back(), defaults));
  }
  section.finish();
  if (!isSameMethod(ladder.forward.back(), ladder.backward.back())) {
    section.fail(
        "rung",
        "rungs change the same keys, so that forward and backward end differently; keys of "
        "one rung each expected");
  }
  return ladder;
}

}  // namespace

std::vector<LadderSpec> readLadders(const TomlReader& root, const StudySpec& study,
                                    const MethodDefaults& defaults) {
  std::vector<LadderSpec> ladders;
  for (const TomlReader& section : root.optionalTables("ladder")) {
    LadderSpec ladder = readLadder(section, study, defaults);
    for (const LadderSpec& other : ladders) {
      if (other.method != ladder.method) continue;
      section.fail("method", fmt::format("\"{}\" has another ladder", ladder.method));
    }
    const bool atlas = std::any_of(study.views.begin(), study.views.end(), hasFixedSamples);
    if (!atlas) {
      section.fail("method", "no [[view]] of type atlas found, in which a ladder is measured");
    }
    ladders.push_back(std::move(ladder));
  }
  return ladders;
}

}  // namespace gnomon::study
