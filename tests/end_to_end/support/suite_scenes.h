#pragma once

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <string>

#include "end_to_end/support/program.h"

namespace gnomon::test {

/// Scenes of a suite.
class SuiteScenes : public EndToEnd {
 protected:
  /// The small study as one that was drawn for a suite.
  static std::string ofSuite(const std::string& name, const std::string& suite) {
    return replaced(smallStudy(), "name = \"small\"\n",
                    fmt::format("name = \"{}\"\nsuite = \"{}\"\n", name, suite));
  }

  /// Summaries FOLDER/scene-00/summary.json and so on, made of that of one run: each method has
  /// other numbers of false shadows on each scene.
  void copyScenes(const std::string& run, const std::string& folder, int count,
                  const std::string& suite = "suite-t") const {
    const auto summary = nlohmann::json::parse(read(run + "/summary.json"));
    for (int i = 0; i < count; ++i) {
      nlohmann::json scene = summary;
      const std::string name = fmt::format("scene-{:02}", i);
      scene["study"]["name"] = name;
      scene["study"]["settings"]["study"]["suite"] = suite;
      int method = 0;
      for (nlohmann::json& row : scene["results"]) {
        const auto lit = row["tn"].get<double>();
        const double moved = std::min(lit, (i * 7 + 3 * method++) % 11 + 0.0);
        row["tn"] = lit - moved;
        row["fp"] = row["fp"].get<double>() + moved;
      }
      const std::string place = fmt::format("{}/{}", folder, name);
      std::filesystem::create_directories(file(place));
      write(place + "/summary.json", scene.dump());
    }
  }
};

}  // namespace gnomon::test
