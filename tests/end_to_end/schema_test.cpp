#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include "compare/metric.h"
#include "end_to_end/support/suite_scenes.h"
#include "study/run/scene/view_samples.h"

// The JSON files of every command agree with schemas/gnomon.schema.json, by an independent
// validator, and use every key that it has. The columns of the CSV files are those of
// schemas/columns.csv.

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

/// Columns by the file that has them.
using Columns = std::map<std::string, std::set<std::string>>;

/// Validates a file given by its second argument against the schema given by its first: a line for
/// each fault, and exit status 1 if there is one. By the option --keys it prints the keys of the
/// schema that none of the files has.
constexpr const char* validator = R"py(
import json, sys
import jsonschema

schema = json.load(open(sys.argv[1], encoding="utf-8"))
kind = jsonschema.Draft202012Validator
kind.check_schema(schema)
files = [json.load(open(name, encoding="utf-8")) for name in sys.argv[2:] if name != "--keys"]
faults = [f"{fault.json_path}: {fault.message[:300]}"
          for content in files for fault in kind(schema).iter_errors(content)]

seen = set()

def visit(rule, name, value):
    """Notes the keys of a value under the definitions that describe them."""
    if "$ref" in rule:
        name = rule["$ref"].rsplit("/", 1)[1]
        visit(schema["$defs"][name], name, value)
    for part in rule.get("allOf", []) + rule.get("anyOf", []):
        visit(part, name, value)
    if isinstance(value, list) and "items" in rule:
        for entry in value:
            visit(rule["items"], name, entry)
    if isinstance(value, dict):
        for key, below in rule.get("properties", {}).items():
            if key in value:
                seen.add((name, key))
                visit(below, name, value[key])

if "--keys" in sys.argv:
    kinds = {rule["if"]["properties"]["schema"]["const"]: rule["then"] for rule in schema["allOf"]}
    for content in files:
        visit(kinds[content["schema"]], "", content)
    faults += [f"no file has {name}.{key}" for name, rule in schema["$defs"].items()
               for key in rule.get("properties", {}) if (name, key) not in seen]

print("\n".join(faults))
sys.exit(1 if faults else 0)
)py";

bool isMetric(const std::string& name) {
  return compare::MetricId::find(name).has_value();
}

std::string schemaFile(const char* name) {
  return std::string(GNOMON_SCHEMAS) + "/" + name;
}

/// The columns that schemas/columns.csv documents. No file's or column's name holds a comma.
Columns documentedColumns() {
  Columns columns;
  std::ifstream table(schemaFile("columns.csv"));
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream cells(line);
    std::string file;
    std::string column;
    std::getline(cells, file, ',');
    std::getline(cells, column, ',');
    columns[file].insert(column);
  }
  return columns;
}

class Schema : public SuiteScenes {
 protected:
  [[nodiscard]] static std::string study() {
    std::string text = replaced(smallStudy(), "elevation = 30", "elevation = [50, 20]");
    text = replaced(text, "name = \"evening\"\n", "");
    return text + R"(
[[method]]
name = "max-forsyth"
label = "coarse"
bake = { azimuths = 4 }

[[view]]
type = "atlas"
samples = 17

[[threshold]]
max = 0.9

[[claim]]
text = "Shadows matter"
source = "a test"
less = "max-forsyth"
than = "unshadowed"

[[ladder]]
method = "max-forsyth"
[[ladder.rung]]
cause = "azimuths"
change = "64"
set = { bake = { azimuths = 64 } }
)";
  }
  /// What the validator says of files: empty if they agree with the schema.
  [[nodiscard]] std::string faultsOf(const std::vector<std::string>& names,
                                     const char* option = "") const {
    write("validate.py", validator);
    std::string command = fmt::format("cd '{}' && /usr/bin/python3 validate.py '{}' {}",
                                      folder().string(), schemaFile("gnomon.schema.json"), option);
    for (const std::string& name : names) command += " '" + name + "'";
    const int status =
        std::system((command + " > faults.txt 2>&1").c_str());  // NOLINT(cert-env33-c)
    return status == 0 ? "" : "faults:\n" + read("faults.txt");
  }
  void addColumns(const std::string& name, const std::string& path) {
    std::istringstream head(read(path).substr(0, read(path).find('\n')));
    for (std::string column; std::getline(head, column, ',');) {
      const bool all = name == "metrics.csv" && isMetric(column);
      const bool isKey = name == "cases.csv" && column.find('.') != std::string::npos;
      columns_[name].insert(all ? "METRIC" : isKey ? "KEY" : column);
    }
  }
  /// What `run` and `check` write of a study, with references, without them, and as a shard.
  void runStudies() {
    write("small.toml", study());
    const auto checked = [&](const std::vector<std::string>& more) {
      std::vector<std::string> arguments = {"check", "small.toml", "--baseline"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return gnomon(arguments, {"GNOMON_CACHE=" + file("kept").string()}).status;
    };
    ASSERT_EQ(checked({"ref", "--update-baseline", "--reason", "a test"}), 0);
    ASSERT_EQ(checked({"ref"}), 0);
    ASSERT_EQ(checked({"nowhere", "--out", "problem"}), 3);
    ASSERT_EQ(gnomon({"run", "small.toml", "--shard", "1/1", "--out", "part"}).status, 0);
    for (const char* name :
         {"metrics.csv", "bins.csv", "budget.csv", "frontier.csv", "table.csv"}) {
      addColumns(name, std::string("out/small/") + name);
    }
    files_.insert(files_.end(),
                  {"out/small/summary.json", "problem/small/summary.json", "part/shard.json"});
  }
  /// What a sweep and a second study add, and a threshold that does not hold.
  void runSweep() {
    const std::string claim = R"(
[[claim]]
text = "Shadows matter"
source = "a test"
less = "max-forsyth"
than = "unshadowed"
)";
    write("swept.toml", replaced(smallStudy(), "\"small\"", "\"swept\"") +
                            "\n[sweep]\nkey = \"relief.height\"\nvalues = [1, 6]\n" + claim);
    write("other.toml", replaced(smallStudy(), "\"small\"", "\"other\"") + claim);
    const Outcome outcome = gnomon({"run", "swept.toml", "other.toml"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    std::ofstream(file("swept.toml"), std::ios::app)
        << "[[threshold]]\nmethod = \"unshadowed\"\nmax = 0\n";
    ASSERT_EQ(gnomon({"check", "swept.toml", "--baseline", "nowhere", "--out", "problem"}).status,
              3);
    addColumns("sweep.csv", "out/swept/sweep.csv");
    addColumns("cases.csv", "out/swept/cases.csv");
    addColumns("ranking.csv", "out/ranking.csv");
    files_.insert(files_.end(),
                  {"out/swept/summary.json", "problem/swept/summary.json", "out/ranking.json"});
  }
  void gatherSuite() {
    write("drawn.toml", ofSuite("drawn", "suite-t"));
    ASSERT_EQ(gnomon({"run", "drawn.toml"}).status, 0);
    copyScenes("out/drawn", "scenes", 20);
    ASSERT_EQ(gnomon({"gather", "scenes", "--out", "gathered"}).status, 0);
    addColumns("suite.csv", "gathered/suite.csv");
    files_.emplace_back("gathered/suite.json");
  }
  /// The truth, the export and comparisons of a light that is a point, or a disc.
  void exportAndCompare(const std::string& name) {
    const std::string exports = "out/" + name + "/export/";
    ASSERT_EQ(gnomon({"truth", name + ".toml"}).status, 0);
    ASSERT_EQ(gnomon({"export", name + ".toml"}).status, 0);
    const auto view = nlohmann::json::parse(read(exports + "export.json"))["views"][0];
    const std::string mask = exports + view["masks"][0]["truth"].get<std::string>();
    const std::string roi = exports + view["roi"].get<std::string>();
    const std::string json = name + ".json";
    ASSERT_EQ(
        gnomon({"compare", mask, mask, "--roi", roi, "--max", "error_rate=0.5", "--json", json})
            .status,
        0);
    const std::string masks = exports + "masks";
    ASSERT_EQ(gnomon({"compare", masks, masks, "--json", "folders-" + json}).status, 0);
    files_.insert(files_.end(), {"out/" + name + "/truth/truth.json", exports + "export.json", json,
                                 "folders-" + json});
  }

  std::vector<std::string> files_;
  Columns columns_;
};

TEST_F(Schema, IsThatOfEveryFile) {
  ASSERT_NO_FATAL_FAILURE(runStudies());
  ASSERT_NO_FATAL_FAILURE(runSweep());
  ASSERT_NO_FATAL_FAILURE(gatherSuite());
  const std::string soft = replaced(smallStudy(), "elevation = 30", "elevation = 30\nradius = 3");
  write("soft.toml", replaced(soft, "\"small\"", "\"soft\""));
  ASSERT_EQ(gnomon({"run", "soft.toml"}).status, 0);
  files_.emplace_back("out/soft/summary.json");
  ASSERT_NO_FATAL_FAILURE(exportAndCompare("small"));
  ASSERT_NO_FATAL_FAILURE(exportAndCompare("soft"));

  for (const std::string& name : files_) EXPECT_EQ(faultsOf({name}), "") << name;
  EXPECT_EQ(faultsOf(files_, "--keys"), "");
  EXPECT_EQ(columns_, documentedColumns());
}

/// A control: a key that is unknown, missing or of a wrong type is found, at every depth.
TEST_F(Schema, FindsWhatDoesNotFit) {
  write("small.toml", study());
  ASSERT_EQ(gnomon({"run", "small.toml"}).status, 0);
  const auto summary = nlohmann::json::parse(read("out/small/summary.json"));
  const auto faultsAfter = [&](const std::function<void(nlohmann::json&)>& change) {
    nlohmann::json changed = summary;
    change(changed);
    write("changed.json", changed.dump());
    return faultsOf({"changed.json"});
  };
  EXPECT_EQ(faultsAfter([](nlohmann::json&) {}), "");
  EXPECT_THAT(faultsAfter([](auto& json) { json["surplus"] = 1; }), HasSubstr("'surplus'"));
  EXPECT_THAT(faultsAfter([](auto& json) { json["results"][0]["surplus"] = 1; }),
              HasSubstr("$.results[0]: Unevaluated properties are not allowed ('surplus'"));
  EXPECT_THAT(faultsAfter([](auto& json) { json["results"][0]["error_rate"] = "0.1"; }),
              HasSubstr("$.results[0].error_rate: '0.1' is not of type 'number'"));
  EXPECT_THAT(faultsAfter([](auto& json) { json["results"][0]["error_rate"] = 5; }),
              HasSubstr("$.results[0].error_rate: 5 is greater than"));
  EXPECT_THAT(faultsAfter([](auto& json) { json["cost"][0].erase("passes"); }),
              HasSubstr("$.cost[0]: 'passes' is a required property"));
  EXPECT_THAT(faultsAfter([](auto& json) { json["schema"] = "gnomon-summary/0"; }),
              HasSubstr("$.schema: 'gnomon-summary/0' is not one of"));
}

TEST(SchemaText, DescribesEveryKeyAndAxis) {
  std::ifstream file(schemaFile("gnomon.schema.json"));
  const auto schema = nlohmann::json::parse(file);
  const nlohmann::json& definitions = schema["$defs"];
  for (const auto& [name, definition] : definitions.items()) {
    EXPECT_TRUE(definition.contains("description")) << name;
    if (!definition.contains("properties")) continue;
    for (const auto& [key, rule] : definition["properties"].items()) {
      EXPECT_TRUE(rule.contains("description") || rule.contains("$ref")) << name << "." << key;
    }
  }
  std::vector<std::string> axes;
  for (const study::SampleAxis& axis : study::sampleAxes()) axes.emplace_back(axis.name);
  EXPECT_THAT(definitions["axis"]["enum"].get<std::vector<std::string>>(),
              ::testing::UnorderedElementsAreArray(axes));
}

}  // namespace
}  // namespace gnomon::test
