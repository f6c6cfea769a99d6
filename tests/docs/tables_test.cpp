#include <gmock/gmock.h>

#include <cstdlib>

#include "docs/pages.h"
#include "support/temporary_folder.h"

// The figures in the tables of the manual are those of the committed files.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string textOf(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Tables : public TemporaryFolder {
 protected:
  /// A project of the committed pages and results, whose pages may be written.
  void SetUp() override {
    fs::create_directories(file("results"));
    for (const auto& entry : fs::directory_iterator(projectFolder() / "results")) {
      const fs::path copy = file("results") / entry.path().filename();
      if (entry.is_directory()) {
        fs::create_directory_symlink(entry.path(), copy);
      } else {
        fs::copy_file(entry.path(), copy);
      }
    }
    fs::copy(projectFolder() / "docs", file("docs"));
    fs::copy_file(projectFolder() / "README.md", file("README.md"));
  }
  /// Runs the script; what it prints is in `printed`.
  [[nodiscard]] bool succeeds(const std::string& options) {
    const std::string command = "python3 " + file("results/tables.py").string() + options + " > " +
                                file("printed.txt").string() + " 2>&1";
    const bool isDone = std::system(command.c_str()) == 0;  // NOLINT(cert-env33-c)
    printed = textOf(file("printed.txt"));
    return isDone;
  }

  std::string printed;
};

TEST_F(Tables, AreThoseOfTheFiles) {
  EXPECT_TRUE(succeeds(" --check")) << printed;
  EXPECT_THAT(printed, HasSubstr("all tables as the files have them"));
}

TEST_F(Tables, ThatWereChangedAreNamedAndWrittenAnew) {
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"README.md", "| `unshadowed`: bump mapping alone, the control | "},
      {"results/README.md", "| `max-forsyth` | "},
      {"docs/methods.md", "| `body-torus-terrain` | "},
      {"docs/settings.md", "| `relief-march` | steps | 64 | "},
      {"docs/which-method.md", "| `shadow-map`, 9 | "},
  };
  std::map<std::string, std::string> texts;
  for (const auto& [page, row] : rows) {
    std::string text = texts[page] = textOf(file(page));
    const std::size_t at = text.find(row);
    ASSERT_NE(at, std::string::npos) << page;
    const std::size_t digit = text.find_last_of("0123456789", text.find('\n', at));
    text[digit] = text[digit] == '9' ? '8' : '9';
    std::ofstream(file(page)) << text;
  }
  EXPECT_FALSE(succeeds(" --check"));
  for (const auto& [page, row] : rows) {
    EXPECT_THAT(printed, HasSubstr(std::string(page).append("\n  has  ").append(row)));
  }
  EXPECT_THAT(printed, HasSubstr("5 rows differ"));
  EXPECT_TRUE(succeeds("")) << printed;
  for (const auto& [page, text] : texts) EXPECT_EQ(textOf(file(page)), text) << page;
}

}  // namespace
}  // namespace gnomon::test
