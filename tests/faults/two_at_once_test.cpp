#include <fmt/core.h>
#include <gmock/gmock.h>
#include <signal.h>

#include <array>
#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "faults/run_folders.h"
#include "support/test_length.h"

// Two processes of one number, as in two containers on one volume: each the first of a PID
// namespace of its own.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

class TwoAtOnce : public EndToEnd {
 protected:
  void SetUp() override {
    for (const char* name : {"a", "b"}) {
      fs::create_directories(file(name));
    }
    write("a/small.toml", smallStudy());
    write("b/small.toml", otherStudy());
    const int tried = startCommand(folder(), inNamespace({"true"}), {}, "/dev/null", "/dev/null");
    if (endOf(tried) != 0) GTEST_SKIP() << "no PID namespace can be made here";
    for (const char* name : {"a", "b"}) {
      ASSERT_EQ(
          gnomon({"run", std::string(name) + "/small.toml", "--out", "whole-" + std::string(name)},
                 environment("kept"))
              .status,
          0);
      whole_.push_back(contentOf(file("whole-" + std::string(name))));
    }
  }
  static std::vector<std::string> inNamespace(std::vector<std::string> words) {
    const std::vector<std::string> prefix = {"unshare", "--pid", "--fork", "--kill-child"};
    words.insert(words.begin(), prefix.begin(), prefix.end());
    return words;
  }
  [[nodiscard]] std::vector<std::string> environment(const std::string& cache) const {
    return {"GNOMON_CACHE=" + file(cache).string()};
  }
  [[nodiscard]] int start(const std::string& name, const std::string& out, const std::string& cache,
                          const std::string& said) const {
    return startCommand(folder(),
                        inNamespace({GNOMON_PROGRAM, "run", name + "/small.toml", "--out", out}),
                        environment(cache), "/dev/null", file(said + ".stderr"));
  }

  std::vector<FolderContent> whole_;
};

TEST_F(TwoAtOnce, IntoOneFolderTheLaterIsWhole) {
  const int rounds = repetitions(4, 30);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> later(0, 200);
  std::array<int, 2> stayed{};
  for (int round = 0; round < rounds; ++round) {
    const int first = start("a", "out", "kept", "a");
    std::this_thread::sleep_for(std::chrono::milliseconds(later(random)));
    const int second = start("b", "out", "kept", "b");
    ASSERT_EQ(endOf(first), 0) << read("a.stderr");
    ASSERT_EQ(endOf(second), 0) << read("b.stderr");
    const FolderContent found = contentOf(file("out"));
    EXPECT_TRUE(found == whole_[0] || found == whole_[1]);
    ++stayed.at(found == whole_[0] ? 0 : 1);
    EXPECT_EQ(partFilesBelow(folder()), nothing);
  }
  fmt::print("faults: {} rounds of two runs into one folder: the first stayed {} times, 0 mixed\n",
             rounds, stayed[0]);
}

TEST_F(TwoAtOnce, OnOneCacheBothFillIt) {
  // The same study, so that both write the same entries.
  const int rounds = repetitions(2, 15);
  for (int round = 0; round < rounds; ++round) {
    fs::remove_all(file("shared"));
    const int first = start("a", "out-a", "shared", "first");
    const int second = start("a", "out-b", "shared", "second");
    EXPECT_EQ(endOf(first), 0) << read("first.stderr");
    EXPECT_EQ(endOf(second), 0) << read("second.stderr");
    EXPECT_EQ(read("first.stderr") + read("second.stderr"), "");
    EXPECT_EQ(shownBy(contentOf(file("out-a")), whole_), Shown::whole);
    EXPECT_EQ(shownBy(contentOf(file("out-b")), whole_), Shown::whole);
    EXPECT_EQ(partFilesBelow(folder()), nothing);
    EXPECT_EQ(gnomon({"run", "a/small.toml"}, environment("shared")).status, 0);
    EXPECT_EQ(summary("small").at("cache").at("misses"), 0);
  }
  fmt::print("faults: {} rounds of two runs on one cache, none failed\n", rounds);
}

TEST_F(TwoAtOnce, ASignalReachesTheFirstProcessOfAContainer) {
  // For which the system has no default effect. A run that has ended before is tried again.
  int status = 0;
  for (int round = 0; round < 10 && status == 0; ++round) {
    const std::string cache = "cold" + std::to_string(round);
    const int process = start("a", "out", cache, "a");
    for (int i = 0; i < 2000 && partFilesBelow(file(cache)).empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", process));
    int first = 0;
    if (children >> first) ::kill(first, SIGTERM);
    status = endOf(process);
  }
  EXPECT_EQ(status, 128 + SIGTERM);
  EXPECT_EQ(read("a.stderr"), "gnomon: ended by SIGTERM\n");
  EXPECT_EQ(partFilesBelow(folder()), nothing);
}

class Wrapper : public EndToEnd {};

TEST_F(Wrapper, TwoCallsBuildOneAfterTheOther) {
  fs::create_directories(file("checkout/build/release"));
  fs::create_directories(file("tools"));
  fs::copy_file(GNOMON_WRAPPER, file("checkout/gnomon"));
  write("checkout/packages.txt", "");
  fs::last_write_time(file("checkout/packages.txt"),
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  write("checkout/build/packages-found-run", "");
  // A build that fails where another one goes on, and leaves a helper that lives on.
  write("tools/cmake",
        "#!/bin/sh\n"
        "mkdir building || { echo overlap >>overlaps; exit 1; }\n"
        "sleep 0.2\n"
        "case \"$*\" in *--preset*) : >checkout/build/release/build.ninja ;; *)\n"
        "  printf '#!/bin/sh\\necho ran \"$@\"\\n' >checkout/build/release/gnomon\n"
        "  chmod +x checkout/build/release/gnomon ;; esac\n"
        "sleep 5 >/dev/null 2>&1 &\n"
        "rmdir building\n");
  // The wrapper configures in the checkout; the tool looks from one place.
  write("tools/cmake", "#!/bin/sh\ncd " + file("").string() + "\n" +
                           read("tools/cmake").substr(std::string("#!/bin/sh\n").size()));
  fs::permissions(file("tools/cmake"), fs::perms::owner_all);
  const std::string path = "PATH=" + file("tools").string() + ":" + std::getenv("PATH");
  constexpr int calls = 4;
  std::vector<int> processes;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < calls; ++i) {
    processes.push_back(startCommand(folder(), {"checkout/gnomon", "list"}, {path},
                                     file(fmt::format("out{}", i)), file(fmt::format("err{}", i))));
  }
  for (const int process : processes) EXPECT_EQ(endOf(process), 0);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  int waited = 0;
  for (int i = 0; i < calls; ++i) {
    EXPECT_EQ(read(fmt::format("out{}", i)), "ran list\n");
    if (read(fmt::format("err{}", i)).find("another call is building here") != std::string::npos) {
      ++waited;
    }
  }
  EXPECT_FALSE(fs::exists(file("overlaps")));
  EXPECT_GT(waited, 0);
  EXPECT_LT(took.count(), 4) << "what a build leaves running does not hold the others up";
  fmt::print("faults: {} calls of the wrapper at once, {} waited, 0 built at the same time\n",
             calls, waited);
}

}  // namespace
}  // namespace gnomon::test
