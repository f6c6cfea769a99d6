#include "study/judge/suite/standings.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "render/method.h"
#include "render/shader_files.h"

namespace gnomon::study {
namespace fs = std::filesystem;
namespace {

using Fields = std::vector<std::string>;

/// The fields of a line of CSV; quotes hold commas, two of them a quote.
Fields fieldsOf(std::string_view line) {
  Fields fields(1);
  bool isQuoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      const bool isDoubled = isQuoted && i + 1 < line.size() && line[i + 1] == '"';
      if (isDoubled) fields.back() += line[i++];
      isQuoted = isDoubled == isQuoted;
    } else if (line[i] == ',' && !isQuoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  return fields;
}

/// A CSV file with a header, read by the names of its columns.
class CsvFile {
 public:
  explicit CsvFile(const fs::path& file) : file_(file.string()) {
    const std::string text = readFile(file);
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      lines_.push_back(fieldsOf(std::string_view(text).substr(begin, end - begin)));
      begin = end + 1;
    }
    if (lines_.empty()) throw InputError(file_ + ": empty, a table expected");
  }

  [[nodiscard]] std::size_t rows() const { return lines_.size() - 1; }

  [[nodiscard]] const std::string& text(std::size_t row, std::string_view column) const {
    const Fields& header = lines_.front();
    const auto found = std::find(header.begin(), header.end(), column);
    const auto index = static_cast<std::size_t>(found - header.begin());
    const Fields& fields = lines_[row + 1];
    if (index >= fields.size() || fields.size() != header.size()) {
      throw InputError(fmt::format("{}:{}: {} fields found, {} with `{}` among them expected",
                                   file_, row + 2, fields.size(), header.size(), column));
    }
    return fields[index];
  }

  /// None for an empty field.
  [[nodiscard]] std::optional<double> number(std::size_t row, std::string_view column) const {
    const std::string& field = text(row, column);
    if (field.empty()) return std::nullopt;
    double value = 0;
    const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (failure != std::errc() || end != field.data() + field.size()) {
      throw InputError(
          fmt::format("{}:{}: {}: \"{}\" found, a number expected", file_, row + 2, column, field));
    }
    return value;
  }

 private:
  std::string file_;
  std::vector<Fields> lines_;  ///< the header first
};

/// How methods are drawn in plots, by what they declare.
class Marks {
 public:
  /// Of the method whose name opens a label, as in "two-scales, chosen".
  const std::pair<std::string, render::MethodMark>& of(const std::string& label) {
    const auto found = marks_.find(label);
    if (found != marks_.end()) return found->second;
    std::string longest;
    for (const std::string& name : names_) {
      const bool opens =
          label.starts_with(name) &&
          (label.size() == name.size() || label[name.size()] == ',' || label[name.size()] == ' ');
      if (opens && name.size() > longest.size()) longest = name;
    }
    const render::MethodMark mark =
        longest.empty() ? render::MethodMark{}
                        : render::readMethod(render::methodFile(shaders_, longest)).mark;
    return marks_.try_emplace(label, longest.empty() ? label : longest, mark).first->second;
  }

 private:
  fs::path shaders_ = render::shaderFolder();
  std::vector<std::string> names_ = render::methodNames(shaders_);
  std::map<std::string, std::pair<std::string, render::MethodMark>> marks_;
};

const StudyMeans& committedScene(const Standings& standings, const std::string& name) {
  const auto found = std::lower_bound(
      standings.means.begin(), standings.means.end(), name,
      [](const StudyMeans& scene, const std::string& wanted) { return scene.name < wanted; });
  if (found == standings.means.end() || found->name != name) {
    throw InputError(fmt::format("{}: no committed errors of {} found", name, standings.suite));
  }
  return *found;
}

const MethodMeans& requireMeans(const StudyMeans& scene, const std::string& label) {
  const MethodMeans* means = findMeans(scene, label);
  if (means == nullptr) {
    throw InputError(fmt::format("{}: no error of \"{}\" found", scene.name, label));
  }
  return *means;
}

std::string shareText(const std::optional<double>& share) {
  return share ? fmt::format("{}", *share) : "none";
}

void requireSame(const StudyMeans& scene, const MethodMeans& own, const MethodMeans& committed) {
  const auto require = [&](const char* what, const auto& found, const auto& expected) {
    if (found == expected) return;
    throw InputError(
        fmt::format("{}: {} of `{}`: {} found, the committed {} expected: truth, samples or "
                    "comparison are not those of the committed errors, so they cannot be joined",
                    scene.name, what, control, shareText(found), shareText(expected)));
  };
  require("error rate", own.errorRate, committed.errorRate);
  require("false shadow", own.falseShadow, committed.falseShadow);
  require("false light", own.falseLight, committed.falseLight);
  require("the truth's uncertainty", own.uncertainty, committed.uncertainty);
}

}  // namespace

fs::path standingsFolder() {
  return render::shaderFolder().parent_path() / "results";
}

Standings readStandings(const fs::path& folder, const std::string& suite) {
  Standings standings;
  const CsvFile suites(folder / "suites.csv");
  for (std::size_t row = 0; row < suites.rows(); ++row) {
    if (suites.text(row, "suite") != suite) continue;
    if (suites.text(row, "errors") != errorDefinition) {
      throw InputError(fmt::format("{}: errors of \"{}\" are \"{}\", \"{}\" expected",
                                   (folder / "suites.csv").string(), suite,
                                   suites.text(row, "errors"), errorDefinition));
    }
    standings = {suite,
                 suites.text(row, "seed"),
                 static_cast<int>(suites.number(row, "scenes").value_or(0)),
                 suites.text(row, "sha256"),
                 {}};
  }
  if (standings.scenes <= 0) {
    throw InputError(
        fmt::format("{}: no row of \"{}\" found", (folder / "suites.csv").string(), suite));
  }
  const CsvFile table(folder / suite / "suite.csv");
  std::map<std::string, StudyMeans> scenes;
  Marks marks;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string& name = table.text(row, "scene");
    StudyMeans& scene = scenes[name];
    scene.name = name;
    scene.suite = suite + "-test";
    const std::string& label = table.text(row, "method");
    const auto& [method, mark] = marks.of(label);
    MethodMeans means{label,
                      method,
                      table.number(row, "error_rate"),
                      table.number(row, "false_shadow"),
                      table.number(row, "false_light"),
                      table.number(row, "uncertainty")};
    means.caseErrors = {means.errorRate};
    means.mark = mark;
    scene.methods.push_back(std::move(means));
  }
  for (auto& [name, scene] : scenes) standings.means.push_back(std::move(scene));
  return standings;
}

std::vector<StudyMeans> joined(const Standings& standings, std::span<const StudyMeans> measured,
                               const std::vector<std::string>& entries) {
  std::vector<StudyMeans> scenes;
  scenes.reserve(measured.size());
  for (const StudyMeans& own : measured) {
    const StudyMeans& committed = committedScene(standings, own.name);
    requireSame(own, requireMeans(own, control), requireMeans(committed, control));
    StudyMeans scene = own;
    scene.methods = committed.methods;
    scene.differences.clear();
    scene.claims.clear();
    for (const std::string& entry : entries) {
      if (const MethodMeans* means = findMeans(own, entry)) scene.methods.push_back(*means);
    }
    scenes.push_back(std::move(scene));
  }
  for (const std::string& entry : entries) {
    const bool isAnywhere = std::any_of(scenes.begin(), scenes.end(), [&](const auto& scene) {
      const MethodMeans* means = findMeans(scene, entry);
      return means != nullptr && means->errorRate && means->isInEveryCase();
    });
    if (!isAnywhere) {
      throw InputError(
          fmt::format("\"{}\" has an error on none of the {} scenes, one or more expected", entry,
                      scenes.size()));
    }
  }
  return scenes;
}

}  // namespace gnomon::study
