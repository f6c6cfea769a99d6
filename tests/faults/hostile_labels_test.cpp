#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <pugixml.hpp>
#include <set>

#include "common/text.h"
#include "faults/shell_run.h"
#include "support/lines.h"
#include "support/test_length.h"

// Names that a study may hold, through every output: none becomes a command of a terminal, of
// GitHub's runner, of a spreadsheet, of LaTeX, HTML or gnuplot, and every file stays what it is.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

/// All are UTF-8, as TOML demands; bytes that are none come by paths, below.
const std::vector<std::string> labels = {
    "\x1b[2J\x1b]0;owned\x07",
    "a\n::error file=x::injected",
    "::set-env name=PATH::/tmp",
    "  ::add-mask::x",
    "##[error]injected",
    "x ##[group]y",
    "a\r\n##[endgroup]",
    "::warning::%0A::error::x",
    "=HYPERLINK(\"http://x\")",
    "+1+1",
    "-1+1",
    "@SUM(A1)",
    "\t=1+1",
    "\r=1+1",
    "＝1+1",
    "[2pt] rows",
    "*[3cm]",
    "\\input{/etc/passwd}",
    "\\\\ \\hline $x$ & % # _ ^ ~ { }",
    "]]>",
    "]]><script>alert(1)</script>",
    "<script>alert(1)</script>",
    "\"><img src=x onerror=alert(1)>",
    "' onmouseover='x",
    "--><!--",
    "&amp;&lt;&#x3c;",
    "\u202epass\u202c",
    "\u2066\u2069\u200f mark",
    "fail\u202assap",
    "a\u2028b\u2029c\u0085d",
    "\u009b2J C1",
    std::string("nul\0byte", 8),
    "\x7f delete",
    "a,b\"c\nd",
    "`reboot` $(reboot)",
    "'; !reboot; '",
    "set output '/tmp/x'\nplot x",
    "@macro {/Symbol a} ^_",
    "../../etc/passwd",
    "/absolute",
    "con.txt.",
    ".hidden",
    "C:\\x",
    "a: b # c",
    "'''\"\"\"",
    "\\u001b[31m %s %n {}",
    "日本語 κ 𝛋 עברית",
    "e\u0301\u0301\u0301\u0301 combining",
    "\ufeff=1+1",
    "\ufffe non-character",
    std::string(300, 'w'),
    std::string(70, '=') + "κ",
    "   ",
    "–",
};

/// As a TOML string.
std::string toml(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    char escape[16];
    std::snprintf(escape, sizeof escape, "\\u%04x", code);
    const bool plain = code >= 0x20 && c != '"' && c != '\\' && code != 0x7f;
    quoted += plain ? std::string(1, c) : std::string(escape);
  }
  return quoted + "\"";
}

/// What a text must not hold, whatever reads it; empty for none.
std::string dangerIn(const std::string& text, const char* allowed = "\n") {
  for (std::string_view rest = text; !rest.empty();) {
    const Utf8Character character = firstCharacter(rest);
    if (!character.valid) return "bytes that are no UTF-8";
    if (reversesText(character.code)) return "a character that turns text";
    const bool mayStand =
        character.code < 0x80 &&
        std::string_view(allowed).find(static_cast<char>(character.code)) != std::string_view::npos;
    if (isControl(character.code) && !mayStand) {
      return "the control character " + std::to_string(character.code);
    }
    rest.remove_prefix(character.bytes);
  }
  return "";
}

/// Whether GitHub's runner takes a line for a command: with `::` at its beginning, or `##[`
/// anywhere.
bool isCommand(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  const bool second = begin != std::string::npos && line.compare(begin, 2, "::") == 0;
  return second || line.find("##[") != std::string::npos;
}

/// The cells of a CSV text, as RFC 4180 says.
std::vector<std::vector<std::string>> csvCells(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!quoted && c == '\n') {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  EXPECT_FALSE(quoted);
  rows.pop_back();
  return rows;
}

/// An XML document without its tags: there alone `]]>` must not stand.
std::string contentBetweenTags(const std::string& xml) {
  std::string content;
  bool isTag = false;
  char quote = 0;
  for (const char c : xml) {
    if (!isTag) {
      isTag = c == '<';
      content += isTag ? ' ' : c;
    } else if (quote != 0) {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else {
      isTag = c != '>';
    }
  }
  return content;
}

bool isNumber(const std::string& text) {
  double value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  return parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
}

bool isFormula(const std::string& cell) {
  for (const char* sign : {"=", "+", "-", "@", "\t", "\r", "＝", "＋", "－", "＠"}) {
    if (cell.starts_with(sign) && !isNumber(cell)) return true;
  }
  return false;
}

class HostileLabels : public EndToEnd {
 protected:
  [[nodiscard]] Outcome shell(const std::string& script) const {
    return runShell(folder(), script, {"sh", 600, true});
  }

  /// A study in which every text is one of the labels from `first` on.
  [[nodiscard]] static std::string study(std::size_t first, std::size_t count) {
    const auto label = [&](std::size_t i) { return toml(labels[(first + i) % labels.size()]); };
    std::string text = smallStudy();
    text = replaced(text, "\"Columns on a plane\"", label(1));
    text = replaced(text, "\"a test\"", label(2));
    text = replaced(text, "\"evening\"", label(3));
    text = replaced(text, "type = \"camera\"\n", "type = \"camera\"\nname = " + label(4) + "\n");
    text = replaced(text, "name = \"unshadowed\"", "name = \"unshadowed\"\nlabel = " + label(0));
    text = replaced(text, "name = \"max-forsyth\"", "name = \"max-forsyth\"\nlabel = \"plain\"");
    text += "\n[[view]]\ntype = \"atlas\"\nname = \"atlas\"\nsamples = 9\n";
    for (std::size_t i = 1; i < count; ++i) {
      text += "\n[[method]]\nname = \"unshadowed\"\nlabel = " + label(i) + "\n";
    }
    text += "\n[[threshold]]\nmax = 1e-6\n[[threshold]]\nregion = \"distant\"\nmax = 0.5\n";
    text += "\n[[claim]]\ntext = " + label(5) + "\nsource = " + label(6) + "\nless = " + label(0) +
            "\nthan = \"plain\"\n";
    text += "\n[[ladder]]\nmethod = \"plain\"\nname = \"max-forsyth\"\n[[ladder.rung]]\ncause = " +
            label(7) + "\nchange = " + label(8) + "\nset = { bake.azimuths = 16 }\n";
    return text;
  }

  void expectSafe(const std::string& where, const std::string& text, const char* allowed = "\n") {
    const std::string danger = dangerIn(text, allowed);
    EXPECT_EQ(danger, "") << where;
    ++outputs_;
    leaks_ += danger.empty() ? 0 : 1;
  }
  void expectThat(bool holds, const std::string& where) {
    EXPECT_TRUE(holds) << where;
    leaks_ += holds ? 0 : 1;
  }

  /// Of a log: the runner finds the commands in it that are meant, and no other.
  void expectCommands(const std::string& where, const std::string& log, bool areMeant) {
    for (const std::string& line : linesOf(log)) {
      const bool meant =
          areMeant && (line.starts_with("::error file=") || line.starts_with("::notice file="));
      expectThat(meant || !isCommand(line), fmt::format("{}: {}", where, line));
    }
  }

  void expectSafeCsv(const fs::path& path) {
    const std::string text = bytesOf(path);
    expectSafe(path.string(), text, "\n\r\t");
    const auto rows = csvCells(text);
    for (const auto& row : rows) {
      expectThat(row.size() == rows.front().size(), path.string() + ": rows of different length");
      for (const std::string& cell : row) expectThat(!isFormula(cell), path.string() + ": " + cell);
    }
  }

  /// The cells of a row of a LaTeX table, told by its unescaped `&`.
  static std::size_t latexColumns(const std::string& line) {
    std::size_t columns = 1;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '\\') {
        ++i;
      } else {
        columns += line[i] == '&' ? 1 : 0;
      }
    }
    return columns;
  }

  void expectSafeLatex(const fs::path& path) {
    const std::string text = bytesOf(path);
    expectSafe(path.string(), text);
    bool inRows = false;
    std::string before;  // the heading, once the rows begin
    std::size_t columns = 0;
    for (const std::string& line : linesOf(text)) {
      if (line.find("\\bottomrule") != std::string::npos) inRows = false;
      if (inRows) {
        const std::size_t begin = line.find_first_not_of(' ');
        expectThat(line[begin] != '[' && line[begin] != '*', line);
        for (std::size_t i = 0; i < line.size(); ++i) {
          if (line[i] == '\\') {
            ++i;
          } else {
            expectThat(line[i] != '%' && line[i] != '#' && line[i] != '_', line);
          }
        }
        expectThat(latexColumns(line) == columns, line);
        expectThat(line.ends_with(" \\\\"), line);
        expectThat(line.find("\\input") == std::string::npos, line);
      }
      if (line.find("\\midrule") != std::string::npos) {
        inRows = true;
        columns = latexColumns(before);
        expectThat(columns > 1, before);
      }
      before = line;
    }
  }

  void expectSafeHtml(const fs::path& path) {
    const std::string text = bytesOf(path);
    expectSafe(path.string(), text, "\n\t\r");
    for (const char* injected :
         {"<script>alert", "<img src=x", "' onmouseover='x", "onerror=alert(1)>"}) {
      expectThat(text.find(injected) == std::string::npos, path.string() + ": " + injected);
    }
  }

  void expectSafeXml(const fs::path& path) {
    const std::string text = bytesOf(path);
    expectSafe(path.string(), text, "\n\t\r");
    expectThat(contentBetweenTags(text).find("]]>") == std::string::npos, path.string());
    pugi::xml_document document;
    expectThat(static_cast<bool>(document.load_string(text.c_str())), path.string());
    expectThat(document.select_nodes("//script").empty(), path.string());
  }

  nlohmann::json expectSafeJson(const fs::path& path) {
    const std::string text = bytesOf(path);
    expectSafe(path.string(), text);
    expectThat(text.find("##[") == std::string::npos, path.string());
    return nlohmann::json::parse(text);
  }

  /// Every file that a run has left.
  void expectSafeFiles(const fs::path& root) {
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      const fs::path& path = entry.path();
      expectSafe(path.string(), path.lexically_relative(root).string(), "");
      const std::string kind = path.extension().string();
      if (kind == ".csv") expectSafeCsv(path);
      if (kind == ".tex") expectSafeLatex(path);
      if (kind == ".html") expectSafeHtml(path);
      if (kind == ".svg") expectSafeXml(path);
      if (kind == ".json") (void)expectSafeJson(path);
    }
  }

  /// JSON tells names apart that other outputs clean: each reads back as it was.
  void expectLabels(const fs::path& summary, std::size_t first, std::size_t count) {
    std::set<std::string> found;
    const nlohmann::json json = expectSafeJson(summary);
    for (const nlohmann::json& method : json.at("methods")) {
      found.insert(method.at("label").get<std::string>());
    }
    for (std::size_t i = 0; i < count; ++i) {
      expectThat(found.contains(labels[(first + i) % labels.size()]), summary.string());
    }
  }

  int outputs_ = 0, leaks_ = 0;
};

TEST_F(HostileLabels, AreTextInEveryOutput) {
  // In the long form each label is once the name of each thing; in the short one of a method.
  const std::size_t count = 9;
  const auto stride = static_cast<std::size_t>(repetitions(static_cast<int>(count), 1));
  std::size_t tried = 0;
  for (std::size_t first = 0; first < labels.size(); first += stride) {
    fs::remove_all(file("out"));
    write("small.toml", study(first, count));
    const Outcome outcome = shell("\"$gnomon\" check small.toml --junit junit.xml --github");
    ASSERT_EQ(outcome.status, 1) << outcome.err << outcome.out;
    expectSafe("check", outcome.out, "\n\t");
    expectCommands("check", outcome.out, true);
    expectCommands("check", outcome.err, false);
    expectSafeFiles(file("out"));
    expectSafeXml(file("junit.xml"));
    expectLabels(file("out/small/summary.json"), first, count);
    const Outcome again = shell("\"$gnomon\" run out/small/small.toml --out again");
    ASSERT_EQ(again.status, 0) << again.err;
    expectSafe("run", again.out);
    expectCommands("run", again.out, false);
    expectLabels(file("again/small/summary.json"), first, count);
    tried += stride;
  }
  std::printf("faults: %zu labels in %d outputs, %d leaks\n", std::min(tried, labels.size()),
              outputs_, leaks_);
}

TEST_F(HostileLabels, AreTextInSweepsAndRankings) {
  const int rounds = repetitions(1, 6);
  for (int i = 0; i < rounds; ++i) {
    fs::remove_all(file("out"));
    const auto first = static_cast<std::size_t>(9 * i);
    write("a.toml", replaced(study(first, 6), "\"small\"", "\"a\""));
    write("b.toml", replaced(study(first, 6), "\"small\"", "\"b\"") +
                        "\n[sweep]\nkey = \"relief.height\"\nvalues = [3, 4]\naxis = " +
                        toml(labels[first % labels.size()]) + "\n");
    const Outcome outcome = shell("\"$gnomon\" run a.toml b.toml");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    expectSafe("run", outcome.out);
    expectCommands("run", outcome.out, false);
    expectSafeFiles(file("out"));
  }
  std::printf("faults: labels in %d outputs of sweeps and rankings, %d leaks\n", outputs_, leaks_);
}

/// Names of files, which may hold any byte.
TEST_F(HostileLabels, ArePathsThatAnErrorOrATableNames) {
  const std::vector<std::string> names = {"a\n::error::injected",
                                          "::error::x",
                                          "##[error]x",
                                          "\x1b[2J\x1b[31m",
                                          "\xff\xfe not UTF-8",
                                          "\u202efail",
                                          "a\r\nb",
                                          "=x",
                                          "[x",
                                          "*",
                                          "]]>",
                                          "<b>",
                                          "'q'",
                                          "\"",
                                          "%0A::x",
                                          "a\tb",
                                          "-",
                                          "\u2028x",
                                          std::string("\xc2\x9b") + "2J",
                                          std::string(200, 'x')};
  int tried = 0;
  const std::string text = smallStudy() + "\n[[threshold]]\nmax = 1e-6\n";
  std::size_t whole = 0;
  const auto stride = static_cast<std::size_t>(repetitions(3, 1));
  for (std::size_t i = 0; i < names.size(); i += stride) {
    const std::string& name = names[i];
    const std::string quoted = shellQuoted("./" + name + ".toml");
    fs::remove_all(file("out"));
    std::vector<std::string> scripts = {
        "\"$gnomon\" check " + quoted + " --github --junit junit.xml",
        "\"$gnomon\" run " + quoted,
        fmt::format("\"$gnomon\" compare {0} {0}", quoted),
        "\"$gnomon\" run " + shellQuoted(name),
        "\"$gnomon\" check small.toml --set " + shellQuoted("threshold.0.method=" + name),
        "\"$gnomon\" check small.toml --junit " + shellQuoted("./" + name + "/"),
        "\"$gnomon\" check small.toml --replace " + shellQuoted("max-forsyth=" + name)};
    const bool runs = whole++ < static_cast<std::size_t>(repetitions(3, 100));
    if (runs) {
      write(name + ".toml", text);
      scripts.push_back("\"$gnomon\" check " + quoted + " --github --junit junit.xml --out " +
                        shellQuoted("./" + name));
    }
    write("small.toml", text);
    for (const std::string& script : scripts) {
      const Outcome outcome = shell(script);
      expectThat(outcome.status >= 0 && outcome.status <= 4, script);
      expectSafe(script, outcome.out, "\n\t");
      expectSafe(script, outcome.err);
      expectCommands(script, outcome.out, script.find("--github") != std::string::npos);
      expectCommands(script, outcome.err, false);
      ++tried;
    }
    if (fs::exists(file("junit.xml"))) expectSafeXml(file("junit.xml"));
    if (runs && fs::exists(file(name))) expectSafeFiles(file(name));
  }
  std::printf("faults: %d commands on hostile paths, %d outputs, %d leaks\n", tried, outputs_,
              leaks_);
}

}  // namespace
}  // namespace gnomon::test
