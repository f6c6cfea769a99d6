#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <regex>

#include "docs/pages.h"

// Every command line that a page shows names a command that exists, with options that it has.
// Every relative link of README.md, docs/, results/ and scenes/ leads to a file that is there, and
// its anchor to a heading of that file. Pictures are links, too.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> wordsOf(const std::string& line) {
  std::istringstream stream(line.substr(0, line.find("  #")));
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// The help of a command; that of the program if there is no such command.
const std::string& helpOf(const std::string& command) {
  static std::map<std::string, std::string> known;
  const auto [entry, isNew] = known.try_emplace(command);
  if (!isNew) return entry->second;
  const std::string line = "'" GNOMON_PROGRAM "' " + command + " --help 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(line.c_str(), "r"), pclose);
  std::array<char, 4096> buffer{};
  while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe.get())) {
    entry->second.append(buffer.data(), size);
  }
  return entry->second;
}

/// The `gnomon …` command lines of a page, of its blocks and of its text.
std::vector<std::vector<std::string>> commandsOf(const DocPage& page) {
  std::vector<std::string> lines;
  for (const CodeBlock& block : page.blocks) {
    std::string text = block.text;
    for (std::size_t at = 0; (at = text.find("\\\n", at)) != std::string::npos;) text.erase(at, 2);
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
  }
  for (const std::string& line : page.lines) {
    for (std::string& code : codeOf(line)) lines.push_back(std::move(code));
  }
  std::vector<std::vector<std::string>> commands;
  for (const std::string& line : lines) {
    std::vector<std::string> words = wordsOf(line);
    if (!words.empty() && words[0] == "run:") words.erase(words.begin());
    const bool isCommand = words.size() > 1 && (words[0] == "gnomon" || words[0] == "./gnomon") &&
                           std::islower(static_cast<unsigned char>(words[1][0])) != 0;
    if (isCommand) commands.push_back(std::move(words));
  }
  return commands;
}

/// What is wrong with a command line; empty for nothing.
std::string faultOf(const std::vector<std::string>& words) {
  const std::string& command = words[1];
  // The wrapper's own.
  if (words[0] == "./gnomon" &&
      std::set<std::string>{"test", "python", "package", "reproduce"}.contains(command)) {
    return "";
  }
  const std::string& help = helpOf(command);
  if (help.find("Usage: gnomon " + command + " ") == std::string::npos)
    return "no command " + command;
  for (std::string word : words) {
    word.erase(0, word.starts_with("[") ? 1 : 0);
    if (!word.starts_with("--")) continue;
    word = word.substr(0, word.find_first_of("=]"));
    if (help.find(fmt::format("  {} ", word)) == std::string::npos && word != "--help") {
      return command + " has no " + word;
    }
  }
  return "";
}

TEST(Commands, OfEveryPageExist) {
  std::size_t commands = 0;
  for (const DocPage& page : allPages()) {
    for (const auto& words : commandsOf(page)) {
      EXPECT_EQ(faultOf(words), "") << page.file.string();
      ++commands;
    }
  }
  EXPECT_GT(commands, 30U);
}

TEST(Commands, AreFoundWrong) {
  EXPECT_EQ(faultOf({"gnomon", "run", "study.toml", "--quick"}), "");
  EXPECT_EQ(faultOf({"gnomon", "measure", "study.toml"}), "no command measure");
  EXPECT_EQ(faultOf({"gnomon", "bake", "study.toml", "--github"}), "bake has no --github");
}

/// The manual's list of commands is the program's.
TEST(Commands, AreListed) {
  std::string table;
  for (const std::string& line : manualPage("README.md").lines) {
    if (line.starts_with("| `")) table += line + "\n";
  }
  std::istringstream help(helpOf(""));
  bool isList = false;
  std::size_t listed = 0;
  for (std::string line; std::getline(help, line);) {
    const std::vector<std::string> words = wordsOf(line);
    if (isList && words.empty()) break;
    if (isList) {
      if (!line.starts_with("   ")) {
        EXPECT_NE(table.find("| `" + words[0] + "` |"), std::string::npos) << words[0];
        ++listed;
      }
    }
    isList = isList || line.starts_with("Subcommands:");
  }
  EXPECT_GE(listed, 9U);
}

/// The targets of all links of a page, `[text](target)` and `![text](target)`.
std::vector<std::string> linksOf(const DocPage& page) {
  static const std::regex link(R"(\]\(([^()\s]+)\))");
  std::vector<std::string> targets;
  for (const std::string& line : page.lines) {
    for (std::sregex_iterator match(line.begin(), line.end(), link), end; match != end; ++match) {
      targets.push_back((*match)[1]);
    }
  }
  return targets;
}

/// What is wrong with a link; empty for nothing.
std::string faultOf(const DocPage& page, const std::string& target) {
  if (target.starts_with("https://")) return "";
  const std::size_t hash = target.find('#');
  const std::string name = target.substr(0, hash);
  const fs::path file = name.empty() ? page.file : page.file.parent_path() / name;
  if (!fs::exists(file)) return "no such file";
  if (hash == std::string::npos) return "";
  return anchorsOf(readPage(file)).contains(target.substr(hash + 1)) ? "" : "no such heading";
}

TEST(Links, LeadSomewhere) {
  std::size_t links = 0;
  for (const DocPage& page : allPages()) {
    for (const std::string& target : linksOf(page)) {
      EXPECT_EQ(faultOf(page, target), "") << page.file.string() << ": " << target;
      ++links;
    }
  }
  EXPECT_GT(links, 100U);
}

TEST(Links, AreFoundBroken) {
  const DocPage page = manualPage("README.md");
  EXPECT_EQ(faultOf(page, "metrics.md#regions"), "");
  EXPECT_EQ(faultOf(page, "#commands"), "");
  EXPECT_EQ(faultOf(page, "metrics.md#no-heading"), "no such heading");
  EXPECT_EQ(faultOf(page, "no-page.md"), "no such file");
  EXPECT_EQ(faultOf(page, "../results/no-picture.png"), "no such file");
}

TEST(Links, IndexNamesEveryPageOfTheManual) {
  const std::vector<std::string> links = linksOf(manualPage("README.md"));
  for (const auto& entry : fs::directory_iterator(projectFolder() / "docs")) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".md") || name == "README.md") continue;
    EXPECT_NE(std::find(links.begin(), links.end(), name), links.end()) << name;
  }
}

TEST(Links, ReadmeIsOnePage) {
  EXPECT_LE(readPage(projectFolder() / "README.md").lines.size(), 80U);
}

}  // namespace
}  // namespace gnomon::test
