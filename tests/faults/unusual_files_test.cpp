// What stands in the place of a file and is none: a FIFO, a folder, a device, a link to nowhere or
// to itself, a file that may not be read or whose reading fails, a name that is too long. Each is
// refused in one line, and none is waited for.

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "faults/shell_run.h"
#include "support/test_length.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Where a command reads a file.
struct Place {
  std::string what;
  std::string file;  ///< relative to the test's folder
  std::string command;
};

const std::vector<Place>& places() {
  static const std::vector<Place> all = {
      {"a study to run", "x.toml", "gnomon run x.toml"},
      {"a study to check", "x.toml", "gnomon check x.toml --junit out/junit.xml"},
      {"a study to bake", "x.toml", "gnomon bake x.toml"},
      {"a study to view", "x.toml", "gnomon view x.toml --screenshot out/x.png"},
      {"the second study", "x.toml", "gnomon run small.toml x.toml"},
      {"a method", "x.glsl", "gnomon run small.toml --replace unshadowed=x.glsl"},
      {"a method of a study", "x.glsl", "gnomon run own.toml"},
      {"an OBJ", "x.obj", "gnomon run small.toml --set 'surface={mesh=\"x.obj\"}'"},
      {"a PLY", "x.ply", "gnomon run small.toml --set 'surface={mesh=\"x.ply\"}'"},
      {"a picture", "x.png", "gnomon run small.toml --set 'relief={image=\"x.png\",height=1}'"},
      {"references", "refs/small.json", "gnomon check small.toml --baseline refs"},
      {"former references", "refs/small.json",
       "gnomon check small.toml --baseline refs --update-baseline --reason x"},
      {"a folder of references", "x", "gnomon check small.toml --baseline x"},
      {"a common shader", "shaders/common/pixel.glsl",
       "GNOMON_SHADERS=shaders gnomon run small.toml --no-cache"},
      {"a shipped method", "shaders/methods/unshadowed.glsl",
       "GNOMON_SHADERS=shaders gnomon run small.toml"},
      {"a candidate", "x.png", "gnomon compare x.png mask.png"},
      {"a truth", "x.png", "gnomon compare mask.png x.png"},
      {"a region", "x.png", "gnomon compare mask.png mask.png --roi x.png"},
      {"a copy of the study", "out/small/small.toml", "gnomon run small.toml"},
  };
  return all;
}

/// What stands there.
struct Stand {
  std::string what;
  std::function<void(const fs::path&)> make;
};

const std::vector<Stand>& stands() {
  const auto linkTo = [](const char* target) {
    return [target](const fs::path& path) { fs::create_symlink(target, path); };
  };
  static const std::vector<Stand> all = {
      {"a FIFO", [](const fs::path& path) { ASSERT_EQ(mkfifo(path.c_str(), 0600), 0); }},
      {"a folder", [](const fs::path& path) { fs::create_directory(path); }},
      {"a device", linkTo("/dev/zero")},
      {"a link to itself", [](const fs::path& path) { fs::create_symlink(path, path); }},
      {"a file whose reading fails", linkTo("/proc/self/mem")},
      {"a link to nowhere", linkTo("nowhere")},
  };
  return all;
}

class UnusualFiles : public EndToEnd {
 protected:
  void SetUp() override {
    const std::string study =
        smallStudy() + "\n[[threshold]]\nmethod = \"unshadowed\"\nmax = 0.9\n";
    write("small.toml", study);
    write("own.toml",
          replaced(study, "name = \"unshadowed\"", "file = \"x.glsl\"\nlabel = \"unshadowed\""));
    fs::copy(fs::path(GNOMON_SCENES) / "../shaders", file("shaders"), fs::copy_options::recursive);
    fs::create_directories(file("refs"));
    fs::copy(fs::path(GNOMON_SCENES) / "heights", file("heights"), fs::copy_options::recursive);
    ASSERT_EQ(runShell(folder(), "gnomon run small.toml --out first").status, 0);
    fs::copy(maskOf("first"), file("mask.png"));
    fs::remove_all(file("first"));
  }
  [[nodiscard]] fs::path maskOf(const std::string& out) const {
    return file(out) / "small/masks/camera_evening_truth.png";
  }

  /// Runs a command where a thing stands in a file's place, which is put back after it.
  [[nodiscard]] Outcome tried(const Place& place, const Stand& kind,
                              const std::string& before = "") {
    const fs::path path = file(place.file);
    const fs::path kept = path.string() + ".kept";
    fs::create_directories(path.parent_path());
    if (fs::exists(path)) fs::rename(path, kept);
    kind.make(path);
    Outcome outcome = runShell(folder(), before + place.command);
    fs::remove_all(path);
    if (fs::exists(kept)) fs::rename(kept, path);
    fs::remove_all(file("out"));
    return outcome;
  }
};

TEST_F(UnusualFiles, AreRefusedInOneLineAndNeverWaitedFor) {
  // In the short form every place with a FIFO, and every other kind at some places.
  const int stride = repetitions(5, 1);
  int tries = 0;
  int k = 0;
  for (const Stand& kind : stands()) {
    for (const Place& place : places()) {
      const bool isFifo = &kind == &stands().front();
      if (!isFifo && ++k % stride != 0) continue;
      // A copy or former references that are not there are for the run to write; a folder of
      // references is meant to be one.
      const bool isAbsent = kind.what == "a link to nowhere";
      if (isAbsent && (place.what.starts_with("former") || place.what == "a copy of the study")) {
        continue;
      }
      expectRefused(tried(place, kind), fmt::format("{} as {}", kind.what, place.what));
      ++tries;
    }
  }
  std::printf("faults: %d files that are none, each refused in one line\n", tries);
}

TEST_F(UnusualFiles, FifosAreNamedAsWhatTheyAre) {
  for (const Place& place : places()) {
    if (!place.file.ends_with(".toml") && place.file != "x.glsl" && place.file != "x.obj") continue;
    EXPECT_THAT(tried(place, stands().front()).err,
                HasSubstr(place.file + ": is a FIFO, a file was expected"))
        << place.what;
  }
}

TEST_F(UnusualFiles, NamesThatAreTooLong) {
  const std::string name(300, 'n');
  const std::string too = "File name too long";
  for (const std::string& command : {
           fmt::format("gnomon run {}.toml", name),
           fmt::format("gnomon check small.toml --baseline {}", name),
           fmt::format("gnomon check small.toml --baseline {} --update-baseline --reason x", name),
           fmt::format("gnomon run small.toml --out {}", name),
           fmt::format("gnomon check small.toml --out {}", name),
           fmt::format("gnomon run small.toml --replace unshadowed={}.glsl", name),
           fmt::format("gnomon run small.toml --set 'surface={{mesh=\"{}.obj\"}}'", name),
           fmt::format("gnomon check small.toml --junit {}.xml", name),
       }) {
    const Outcome outcome = runShell(folder(), command);
    expectRefused(outcome, command);
    EXPECT_THAT(outcome.err, HasSubstr(too)) << command;
  }
}

TEST_F(UnusualFiles, ThatMayNotBeRead) {
  // The superuser may read everything: another user it is.
  std::string before;
  if (geteuid() == 0) {
    before = "as() { setpriv --reuid=65534 --regid=65534 --clear-groups \"$@\"; }; gnomon() { as " +
             std::string(GNOMON_PROGRAM) +
             " \"$@\"; }; export GNOMON_CACHE=$PWD/cache TMPDIR=$PWD HOME=$PWD; ";
    fs::permissions(folder(), fs::perms::all);
    for (const auto& entry : fs::recursive_directory_iterator(folder())) {
      fs::permissions(entry.path(), fs::perms::all);
    }
    const Outcome can = runShell(folder(), before + "gnomon check small.toml");
    fs::remove_all(file("out"));
    if (can.status != 0) GTEST_SKIP() << "no other user can run the program: " << can.err;
  }
  const Stand unreadable{"a file that may not be read", [](const fs::path& path) {
                           std::ofstream(path) << "text";
                           fs::permissions(path, fs::perms::none);
                         }};
  int tries = 0;
  for (const Place& place : places()) {
    if (place.what == "a shipped method" || place.what == "a common shader") continue;
    const Outcome outcome = tried(place, unreadable, before);
    expectRefused(outcome, unreadable.what + " as " + place.what);
    if (place.file != "x.png" && place.file != "x") {
      EXPECT_THAT(outcome.err, HasSubstr("Permission denied")) << place.what;
    }
    ++tries;
  }
  // Folders that may not be searched.
  const Stand closed{"a folder that may not be searched", [](const fs::path& path) {
                       fs::create_directory(path);
                       fs::permissions(path, fs::perms::none);
                     }};
  for (const Place& place : {
           Place{"references", "refs", "gnomon check small.toml --baseline refs"},
           Place{"former references", "refs",
                 "gnomon check small.toml --baseline refs --update-baseline --reason x"},
           Place{"methods", "shaders/methods", "GNOMON_SHADERS=shaders gnomon run small.toml"},
           Place{"common shaders", "shaders/common",
                 "GNOMON_SHADERS=shaders gnomon run small.toml"},
           Place{"results", "out/small", "gnomon run small.toml"},
           Place{"a study's folder", "x", "gnomon run x/small.toml"},
       }) {
    const Outcome outcome = tried(place, closed, before);
    expectRefused(outcome, closed.what + " as " + place.what);
    EXPECT_THAT(outcome.err, HasSubstr("Permission denied")) << place.what;
    ++tries;
  }
  std::printf("faults: %d files and folders without permission\n", tries);
}

TEST_F(UnusualFiles, AShaderFolderWithoutMethodsIsBadInput) {
  for (const char* part : {"methods", "common"}) {
    fs::rename(file("shaders") / part, file("gone"));
    const Outcome outcome = runShell(folder(), "GNOMON_SHADERS=shaders gnomon run small.toml");
    expectRefused(outcome, part);
    EXPECT_THAT(outcome.err,
                HasSubstr(fmt::format("GNOMON_SHADERS: shaders holds no folder `{}`", part)));
    expectRefused(runShell(folder(), "GNOMON_SHADERS=shaders gnomon list"), part);
    fs::rename(file("gone"), file("shaders") / part);
  }
}

TEST_F(UnusualFiles, EditorFilesBesideShadersChangeNothing) {
  const std::string run =
      "export GNOMON_SHADERS=shaders GNOMON_CACHE=cache; gnomon list; "
      "gnomon run small.toml >/dev/null; cat out/small/summary.json out/small/metrics.csv";
  ASSERT_EQ(runShell(folder(), run).status, 0);
  const std::string before = runShell(folder(), run).out;
  for (const char* part : {"common", "methods"}) {
    for (const char* name : {".unshadowed.glsl.swp", "unshadowed.glsl~", "#unshadowed.glsl#",
                             ".DS_Store", ".unshadowed.glsl", "4913"}) {
      std::ofstream(file("shaders") / part / name) << "half a sha\xE9";
    }
    fs::create_symlink("user@host:1234", file("shaders") / part / ".#unshadowed.glsl");
    fs::create_symlink("user@host:1234", file("shaders") / part / "gone.glsl");
  }
  const Outcome after = runShell(folder(), run);
  EXPECT_EQ(after.status, 0) << after.err;
  EXPECT_EQ(after.err, "");
  const auto withoutTimes = [](const std::string& text) {
    std::string kept;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (line.find("seconds") == std::string::npos) kept += line + "\n";
    }
    return kept;
  };
  EXPECT_EQ(withoutTimes(after.out), withoutTimes(before));
}

}  // namespace
}  // namespace gnomon::test
