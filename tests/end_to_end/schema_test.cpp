#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "compare/metric.h"
#include "end_to_end/support/suite_scenes.h"
#include "study/run/scene/view_samples.h"

// docs/summary.md names every key and column that a run writes, and no other.

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

/// Keys by the heading that they stand under.
using Schema = std::map<std::string, std::set<std::string>>;

bool isMetric(const std::string& name) {
  return compare::MetricId::find(name).has_value();
}

struct Page {
  Schema schema;
  Schema likeSummary;  ///< keys whose own keys are those of summary.json
};

/// The first cell of every row under a second-level heading, where it is code.
Page documented() {
  Page documented;
  Schema& schema = documented.schema;
  std::ifstream page(std::string(GNOMON_DOCS) + "/summary.md");
  std::string heading;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) heading = line.substr(3);
    if (!line.starts_with("| `")) continue;
    const std::string key = line.substr(3, line.find('`', 3) - 3);
    schema[heading].insert(key);
    if (line.find("as in `summary.json`") != std::string::npos) {
      documented.likeSummary[heading].insert(key);
    }
  }
  return documented;
}

/// Adds the paths of all keys below a value.
void addKeys(const nlohmann::json& json, const std::string& path, std::set<std::string>& keys) {
  // Settings are the study's keys; the other two are texts by name.
  if (path == "study.settings" || path == "conventions" || path == "channels") return;
  if (path.ends_with("undefined")) return;
  if (json.is_array()) {
    for (const nlohmann::json& entry : json) {
      keys.insert(path + "[]");
      addKeys(entry, path + "[]", keys);
    }
    return;
  }
  if (!json.is_object()) return;
  const bool hasAllMetrics = json.contains("undefined");
  for (const auto& [key, value] : json.items()) {
    const std::string name = hasAllMetrics && isMetric(key) ? "METRIC" : key;
    const std::string below = path.empty() ? name : fmt::format("{}.{}", path, name);
    // What a list holds is documented under its own name.
    if (!value.is_array()) keys.insert(below);
    addKeys(value, below, keys);
  }
}

class SummarySchema : public SuiteScenes {
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
  void add(Schema& schema, const std::string& heading, const std::string& file) const {
    addKeys(nlohmann::json::parse(read(file)), "", schema[heading]);
  }
  /// What a disc of light adds to files.
  void addSoft(Schema& schema) const {
    const std::string text = replaced(smallStudy(), "elevation = 30", "elevation = 30\nradius = 3");
    write("soft.toml", replaced(text, "\"small\"", "\"soft\""));
    for (const char* command : {"run", "truth", "export"}) {
      ASSERT_EQ(gnomon({command, "soft.toml"}).status, 0) << command;
    }
    add(schema, "summary.json", "out/soft/summary.json");
    add(schema, "truth.json", "out/soft/truth/truth.json");
    add(schema, "export.json", "out/soft/export/export.json");
    const auto views = nlohmann::json::parse(read("out/soft/export/export.json"))["views"];
    const std::string mask = "out/soft/export/" + views[0]["masks"][0]["truth"].get<std::string>();
    ASSERT_EQ(gnomon({"compare", mask, mask, "--json", "soft.json"}).status, 0);
    add(schema, "gnomon compare --json", "soft.json");
  }
  void addColumns(Schema& schema, const std::string& heading, const std::string& file) const {
    std::istringstream head(read(file).substr(0, read(file).find('\n')));
    for (std::string column; std::getline(head, column, ',');) {
      const bool all = heading == "metrics.csv" && isMetric(column);
      const bool isKey = heading == "cases.csv" && column.find('.') != std::string::npos;
      schema[heading].insert(all ? "METRIC" : isKey ? "KEY" : column);
    }
  }
};

TEST_F(SummarySchema, IsThatOfThePage) {
  write("small.toml", study());
  const std::vector<std::string> check = {"check", "small.toml", "--baseline"};
  const auto checked = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = check;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gnomon(arguments, {"GNOMON_CACHE=" + file("kept").string()});
  };
  Schema written;
  ASSERT_EQ(checked({"ref", "--update-baseline", "--reason", "a test"}).status, 0);
  ASSERT_EQ(checked({"ref"}).status, 0);
  add(written, "summary.json", "out/small/summary.json");
  for (const char* name : {"metrics.csv", "bins.csv", "budget.csv", "frontier.csv", "table.csv"}) {
    addColumns(written, name, std::string("out/small/") + name);
  }
  ASSERT_EQ(checked({"nowhere", "--out", "problem"}).status, 3);
  add(written, "summary.json", "problem/small/summary.json");

  write("swept.toml", replaced(smallStudy(), "\"small\"", "\"swept\"") +
                          "\n[sweep]\nkey = \"relief.height\"\nvalues = [1, 6]\n" + R"(
[[claim]]
text = "Shadows matter at every height"
source = "a test"
less = "max-forsyth"
than = "unshadowed"
)");
  write("other.toml", replaced(smallStudy(), "\"small\"", "\"other\"") + R"(
[[claim]]
text = "Shadows matter"
source = "a test"
less = "max-forsyth"
than = "unshadowed"
)");
  const Outcome outcome = gnomon({"run", "swept.toml", "other.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  add(written, "sweep: summary.json", "out/swept/summary.json");
  add(written, "ranking.json", "out/ranking.json");
  addColumns(written, "sweep.csv", "out/swept/sweep.csv");
  addColumns(written, "cases.csv", "out/swept/cases.csv");
  // Of which a threshold does not hold, and which has no references.
  std::ofstream(file("swept.toml"), std::ios::app)
      << "[[threshold]]\nmethod = \"unshadowed\"\nmax = 0\n";
  ASSERT_EQ(gnomon({"check", "swept.toml", "--baseline", "nowhere", "--out", "problem"}).status, 3);
  add(written, "sweep: summary.json", "problem/swept/summary.json");
  addColumns(written, "ranking.csv", "out/ranking.csv");

  write("drawn.toml", ofSuite("drawn", "suite-t"));
  ASSERT_EQ(gnomon({"run", "drawn.toml"}).status, 0);
  copyScenes("out/drawn", "scenes", 20);
  ASSERT_EQ(gnomon({"gather", "scenes", "--out", "gathered"}).status, 0);
  add(written, "suite.json", "gathered/suite.json");
  addColumns(written, "suite.csv", "gathered/suite.csv");

  ASSERT_EQ(gnomon({"truth", "small.toml"}).status, 0);
  add(written, "truth.json", "out/small/truth/truth.json");
  ASSERT_EQ(gnomon({"export", "small.toml"}).status, 0);
  add(written, "export.json", "out/small/export/export.json");
  const auto view = nlohmann::json::parse(read("out/small/export/export.json"))["views"][0];
  const auto exported = [](const nlohmann::json& name) {
    return "out/small/export/" + name.get<std::string>();
  };
  const std::string mask = exported(view["masks"][0]["truth"]);
  ASSERT_EQ(gnomon({"compare", mask, mask, "--roi", exported(view["roi"]), "--max",
                    "error_rate=0.5", "--json", "same.json"})
                .status,
            0);
  add(written, "gnomon compare --json", "same.json");
  const std::string head = "P5\n16 16\n255\n";
  write("dark.pgm", head + std::string(256, '\0'));
  write("lit.pgm", head + std::string(256, '\xff'));
  ASSERT_EQ(gnomon({"compare", "dark.pgm", "lit.pgm", "--json", "inverted.json"}).status, 0);
  add(written, "gnomon compare --json", "inverted.json");
  const std::string masks = "out/small/export/masks";
  ASSERT_EQ(gnomon({"compare", masks, masks, "--json", "folders.json"}).status, 0);
  add(written, "gnomon compare --json of folders", "folders.json");
  // Pairs, and their sum, have the keys of a comparison.
  std::erase_if(written["gnomon compare --json of folders"], [&](const std::string& key) {
    const std::string below = key.substr(key.find('.') + 1);
    return below != key && written["gnomon compare --json"].contains(below);
  });

  addSoft(written);

  ASSERT_EQ(gnomon({"run", "small.toml", "--shard", "1/1", "--out", "part"}).status, 0);
  add(written, "shard.json", "part/shard.json");

  Page page = documented();
  for (auto& [heading, keys] : written) {
    ASSERT_TRUE(page.schema.contains(heading)) << heading;
    for (const std::string& like : page.likeSummary[heading]) {
      std::erase_if(keys, [&](const std::string& key) {
        return key.starts_with(like + ".") && page.schema.at("summary.json").contains(key);
      });
    }
    for (const std::string& key : keys) {
      EXPECT_TRUE(page.schema.at(heading).contains(key)) << heading << " writes " << key;
    }
    for (const std::string& key : page.schema.at(heading)) {
      EXPECT_TRUE(keys.contains(key)) << heading << ": nothing writes " << key;
    }
  }
  EXPECT_EQ(page.schema.size(), written.size());
}

TEST_F(SummarySchema, NamesEveryAxis) {
  std::ifstream file(std::string(GNOMON_DOCS) + "/summary.md");
  std::ostringstream page;
  page << file.rdbuf();
  for (const study::SampleAxis& axis : study::sampleAxes()) {
    EXPECT_THAT(page.str(), HasSubstr("\n| " + std::string(axis.name) + " | "));
  }
}

}  // namespace
}  // namespace gnomon::test
