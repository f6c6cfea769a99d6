#include "study/spec/suite/drawn_suite.h"

#include <fmt/core.h>

#include <set>

#include "common/files/atomic_file.h"
#include "common/parallel.h"
#include "common/text/sha256.h"
#include "study/spec/suite/suite_text.h"

namespace gnomon::study {
namespace fs = std::filesystem;
namespace {

SuiteStudy studyOf(const DrawnScene& scene, const SuiteMethods& methods, SuiteSplit split) {
  SuiteStudy study;
  study.file = scene.name + ".toml";
  study.facts = scene.facts;
  study.scene = fmt::format("# Drawn by `gnomon suite`: {}.\n\n",
                            scene.study["study"]["source"].value_or<std::string>("")) +
                suiteText(scene.study,
                          {"study", "surface", "relief", "bake", "base", "truth", "view", "light"});
  toml::table rest;
  rest.insert("method", methodsOf(methods, scene, split));
  study.text = fmt::format("{}\n{}\n{}", study.scene, methodsMark, suiteText(rest, {"method"}));
  return study;
}

/// The files that scenes read, and the terms of each folder of them.
std::vector<SuiteCopy> copiesOf(const SuiteSpec& suite, const std::vector<DrawnScene>& scenes) {
  std::set<std::string> names;
  for (const DrawnScene& scene : scenes) {
    for (const std::string& file : scene.files) {
      names.insert(file);
      names.insert((fs::path(file).parent_path() / "README.md").generic_string());
    }
  }
  std::vector<SuiteCopy> copies;
  const fs::path folder = suite.file.parent_path() / "..";
  for (const std::string& name : names) copies.push_back({name, readFile(folder / name)});
  return copies;
}

std::string hashLine(const std::string& bytes, const std::string& file) {
  return fmt::format("{}  {}\n", sha256(bytes), file);
}

}  // namespace

DrawnSuite drawSuite(const SuiteSpec& suite, const SuiteMethods& methods, SuiteSplit split,
                     const std::string& seed, int count) {
  std::vector<DrawnScene> scenes(static_cast<std::size_t>(count));
  parallelFor(0, scenes.size(), [&](std::size_t i) {
    scenes[i] = drawScene(suite, split, seed, static_cast<int>(i) + 1);
  });
  DrawnSuite drawn{suite.name, seed, split, {}, copiesOf(suite, scenes), ""};
  std::string lines;
  for (const DrawnScene& scene : scenes) {
    drawn.studies.push_back(studyOf(scene, methods, split));
    lines += hashLine(drawn.studies.back().scene, drawn.studies.back().file);
  }
  for (const SuiteCopy& copy : drawn.copies) lines += hashLine(copy.bytes, copy.file);
  drawn.sha256 = sha256(lines);
  return drawn;
}

void writeSuite(const DrawnSuite& suite, const std::string& manifest, const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) {
    throw InputError(fmt::format("{}: cannot be made: {}", folder.string(), failure.message()));
  }
  if (!fs::is_empty(folder, failure) || failure) {
    throw InputError(
        fmt::format("{}: files found, an empty folder or a new one expected", folder.string()));
  }
  for (const SuiteCopy& copy : suite.copies) {
    const fs::path file = folder / copy.file;
    fs::create_directories(file.parent_path(), failure);
    writeTextAtomically(file, copy.bytes);
  }
  for (const SuiteStudy& study : suite.studies) {
    writeTextAtomically(folder / study.file, study.text);
  }
  writeTextAtomically(folder / "manifest.json", manifest);
}

}  // namespace gnomon::study
