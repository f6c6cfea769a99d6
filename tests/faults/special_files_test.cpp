#include <fmt/core.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <future>

#include "faults/run_folders.h"

// Results that the command line sends to what is no file; cache entries that are none.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string gated() {
  return smallStudy() + "\n[[threshold]]\nmethod = \"max-forsyth\"\nmax = 0.9\n";
}

class SpecialFiles : public EndToEnd {
 protected:
  void SetUp() override {
    write("small.toml", gated());
    const Outcome outcome = gnomon({"run", "small.toml"}, environment());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  [[nodiscard]] std::vector<std::string> environment() const {
    return {"GNOMON_CACHE=" + file("kept").string()};
  }
  [[nodiscard]] Outcome compare(const std::string& json) const {
    const std::string mask = "out/small/masks/camera_evening_truth.png";
    return gnomon({"compare", mask, mask, "--json", json}, environment());
  }
  [[nodiscard]] Outcome check(const std::string& junit) const {
    return gnomon({"check", "small.toml", "--junit", junit}, environment());
  }
};

TEST_F(SpecialFiles, DevicesStayDevices) {
  if (::mknod(file("null").c_str(), S_IFCHR | 0666, 0x103) != 0 ||
      ::mknod(file("full").c_str(), S_IFCHR | 0666, 0x107) != 0) {
    GTEST_SKIP() << "no device can be made here";
  }
  fs::create_symlink("null", file("link"));
  for (const char* name : {"null", "link"}) {
    EXPECT_EQ(compare(name).status, 0) << name;
    EXPECT_EQ(check(name).status, 0) << name;
  }
  for (const Outcome& outcome : {compare("full"), check("full")}) {
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, HasSubstr("gnomon: full: cannot be written: No space left on device"));
  }
  EXPECT_TRUE(fs::is_character_file(file("null")));
  EXPECT_TRUE(fs::is_character_file(file("full")));
  EXPECT_TRUE(fs::is_symlink(file("link")));
}

TEST_F(SpecialFiles, PipesAreWrittenInto) {
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  auto reader = std::async(std::launch::async, [&] { return read("pipe"); });
  EXPECT_EQ(compare("pipe").status, 0);
  EXPECT_EQ(nlohmann::json::parse(reader.get()).at("schema").get<std::string>().find("gnomon-"),
            0U);
  EXPECT_TRUE(fs::is_fifo(file("pipe")));
}

TEST_F(SpecialFiles, OpenStreamsAreWrittenTo) {
  const Outcome compared = compare("/dev/stderr");
  EXPECT_EQ(compared.status, 0);
  EXPECT_THAT(compared.err, StartsWith("{"));
  const Outcome checked = check("/dev/stderr");
  EXPECT_EQ(checked.status, 0);
  EXPECT_THAT(checked.err, HasSubstr("<testsuites"));
  EXPECT_FALSE(fs::is_regular_file(fs::symlink_status("/dev/stderr")));
}

TEST_F(SpecialFiles, LinksAreFollowed) {
  fs::create_directories(file("reports"));
  fs::create_symlink("reports/junit.xml", file("junit.xml"));
  EXPECT_EQ(check("junit.xml").status, 0);
  EXPECT_TRUE(fs::is_symlink(file("junit.xml")));
  EXPECT_THAT(read("reports/junit.xml"), HasSubstr("<testsuites"));
}

TEST_F(SpecialFiles, CacheEntriesOfAnyKindAreReplaced) {
  const auto make = [&](std::size_t kind, const fs::path& path) {
    const auto size = fs::file_size(path);
    std::error_code failure;
    if (kind == 0) fs::resize_file(path, std::uintmax_t{1} << 43, failure);
    if (kind == 1) fs::resize_file(path, size + 1);
    if (kind == 2) fs::resize_file(path, size - 1);
    if (kind < 3) return;
    fs::remove(path);
    if (kind == 3) fs::create_directory(path);
    if (kind == 4) fs::create_directories(path / "full/of/folders");
    if (kind == 5) {
      EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    }
    if (kind == 6) fs::create_symlink("/dev/zero", path);
  };
  constexpr std::size_t kinds = 7;
  std::vector<fs::path> entries;
  for (const auto& entry : fs::recursive_directory_iterator(file("kept"))) {
    if (entry.path().extension() == ".entry") entries.push_back(entry.path());
  }
  ASSERT_GT(entries.size(), 2 * kinds);
  for (std::size_t i = 0; i < entries.size(); ++i) make(i % kinds, entries[i]);
  // What the folder keeps for itself, too.
  fs::remove(file("kept/limit"));
  ASSERT_EQ(::mkfifo(file("kept/limit").c_str(), 0600), 0);
  const FolderContent before = contentOf(file("out"));
  Outcome outcome = gnomon({"run", "small.toml"}, environment());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(differences(contentOf(file("out")), before), nothing);
  const nlohmann::json damaged = summary("small").at("cache").at("damaged");
  EXPECT_GT(damaged, 2 * kinds);
  outcome = gnomon({"run", "small.toml"}, environment());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(summary("small").at("cache").at("misses"), 0) << "all have been kept anew";
  EXPECT_EQ(gnomon({"cache"}, environment()).status, 0);
  EXPECT_EQ(gnomon({"cache", "--clear"}, environment()).status, 0);
  fmt::print("faults: {} cache entries of {} wrong kinds, {} read and replaced, none in the way\n",
             entries.size(), kinds, damaged.get<int>());
}

}  // namespace
}  // namespace gnomon::test
