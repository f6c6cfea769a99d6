#include "report/json/suite_json.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "common/text/sha256.h"

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const toml::table& facts) {
  std::ostringstream text;
  text << toml::json_formatter{facts};
  return Json::parse(text.str());
}

}  // namespace

std::string suiteManifest(const study::DrawnSuite& suite) {
  Json manifest = {{"schema", 1},
                   {"suite", suite.suite},
                   {"split", study::splitName(suite.split)},
                   {"seed", suite.seed},
                   {"sha256", suite.sha256}};
  manifest["studies"] = Json::array();
  for (const study::SuiteStudy& study : suite.studies) {
    manifest["studies"].push_back({{"file", study.file},
                                   {"sha256", sha256(study.text)},
                                   {"scene_sha256", sha256(study.scene)},
                                   {"drawn", jsonOf(study.facts)}});
  }
  manifest["files"] = Json::array();
  for (const study::SuiteCopy& copy : suite.copies) {
    manifest["files"].push_back({{"file", copy.file}, {"sha256", sha256(copy.bytes)}});
  }
  return manifest.dump(1) + "\n";
}

}  // namespace gnomon::report
