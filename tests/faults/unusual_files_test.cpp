#include <fmt/core.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <future>
#include <sstream>

#include "common/files/input_file.h"
#include "faults/run_folders.h"
#include "faults/shell_run.h"
#include "model/saved_study.h"
#include "study/spec/study_file.h"
#include "support/test_length.h"

// What stands in the place of a file and is none: a FIFO, a folder, a device, a link to nowhere or
// to itself, a file that may not be read or whose reading fails, a name that is too long. Each is
// refused in one line, and none is waited for.
// Results that the command line sends to what is no file; cache entries that are none.
// Studies that come from a pipe, a redirection or a shell's process substitution.
// Names of files and folders that are no UTF-8: a study, its mesh, picture and method, and the
// folders of results. Everything runs, is kept, is read again, and is UTF-8.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

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
      {"an OBJ", "x.obj", "gnomon run small.toml --set 'surface={mesh=\"x.obj\",scheme=\"none\"}'"},
      {"a PLY", "x.ply",
       "gnomon run small.toml --set 'surface={mesh=\"x.ply\",scheme=\"catmull-clark\"}'"},
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
           fmt::format("gnomon run small.toml --set 'surface={{mesh=\"{}.obj\",scheme=\"none\"}}'",
                       name),
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

class StreamedStudy : public EndToEnd {
 protected:
  void SetUp() override {
    fs::create_directories(file("meshes"));
    std::ofstream(file("meshes/square.obj"))
        << "v -16 -16 0\nv 16 -16 0\nv 16 16 0\nv -16 16 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
           "f 1/1 2/2 3/3 4/4\n";
    write("small.toml", studyText());
  }
  static std::string studyText() {
    return replaced(smallStudy(), "shape = \"plane\"\nquads = [4, 4]\nsize = [32, 32]",
                    "mesh = \"meshes/square.obj\"\nscheme = \"catmull-clark\"") +
           "\n[[threshold]]\nmethod = \"unshadowed\"\nmax = 0.9\n";
  }
  /// The figures of a run, without what names the study's file and how long it took.
  [[nodiscard]] nlohmann::json figures(const std::string& out) const {
    const nlohmann::json json = summary("small", out);
    return {json.at("results"), json.at("study").at("settings"), json.at("status")};
  }
};

TEST_F(StreamedStudy, IsTheSameStudyAsItsFile) {
  ASSERT_EQ(runShell(folder(), "gnomon run small.toml --out file").status, 0);
  const nlohmann::json expected = figures("file");
  int tried = 0;
  for (const char* command : {
           "gnomon run /dev/stdin --out streamed < small.toml",
           "cat small.toml | gnomon run /dev/stdin --out streamed",
           "gnomon run <(cat small.toml) --out streamed",
           "cat small.toml | gnomon run /proc/self/fd/0 --out streamed",
           "mkfifo fifo; cat small.toml > fifo & gnomon run /dev/stdin --out streamed < fifo",
           "cat small.toml | gnomon check /dev/stdin --out streamed --junit streamed/j.xml",
       }) {
    const Outcome outcome = runShell(folder(), command);
    EXPECT_EQ(outcome.status, 0) << command << outcome.err;
    EXPECT_EQ(outcome.err, "") << command;
    EXPECT_EQ(figures("streamed"), expected) << command;
    const nlohmann::json study = summary("small", "streamed").at("study");
    const auto& input = study.at("inputs").at(0);
    EXPECT_EQ(input.at("file"), study.at("file")) << command;
    EXPECT_EQ(input.at("sha256"), sha256(studyText())) << command;
    // The copy in its folder is a file, which gives the same again.
    if (tried++ == 0) {
      EXPECT_EQ(runShell(folder(), "gnomon run streamed/small/small.toml --out again").status, 0);
      EXPECT_EQ(figures("again").at(0), expected.at(0)) << command;
    }
    for (const char* made : {"streamed", "fifo"}) fs::remove_all(file(made));
  }
  std::printf("faults: %d ways to stream a study, each the same as its file\n", tried);
}

TEST_F(StreamedStudy, MayBeASweep) {
  write("sweep.toml", studyText() + "\n[sweep]\nkey = \"relief.height\"\nvalues = [2, 4]\n");
  const Outcome outcome = runShell(folder(), "cat sweep.toml | gnomon run /dev/stdin");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(file("out/small/2/summary.json")));
  EXPECT_TRUE(fs::exists(file("out/small/4/summary.json")));
}

TEST_F(StreamedStudy, OtherCommandsTakeItToo) {
  for (const char* command : {"bake", "truth", "export"}) {
    const Outcome outcome =
        runShell(folder(), std::string("cat small.toml | gnomon ") + command + " /dev/stdin");
    EXPECT_EQ(outcome.status, 0) << command << outcome.err;
  }
}

TEST_F(StreamedStudy, RefusalsNameTheStream) {
  for (const auto& [command, says] : {
           std::pair("gnomon run /dev/stdin < /dev/null", "/dev/stdin: is a device"),
           std::pair("gnomon run /dev/stdin < /dev/zero", "/dev/stdin: is a device"),
           std::pair("gnomon run /dev/stdin < .", "/dev/stdin: is a folder"),
           // The program opens /dev/null in the place of a closed stream.
           std::pair("gnomon run /dev/stdin <&-", "/dev/stdin: is a device"),
           std::pair("true | gnomon run /dev/stdin", "/dev/stdin:1: study: missing"),
           std::pair("yes | gnomon run /dev/stdin", "/dev/stdin: more than 67.1 MB found"),
           std::pair("echo '[study' | gnomon run /dev/stdin", "/dev/stdin:1:"),
           std::pair("sed s/square/none/ small.toml | gnomon run /dev/stdin",
                     "meshes/none.obj: no such file"),
           // What is read more than once cannot come from a pipe.
           std::pair("cat small.toml | gnomon run small.toml --replace unshadowed=/dev/fd/0.glsl",
                     "/dev/fd/0.glsl: no such file"),
           std::pair("cat small.toml | gnomon view /dev/stdin --screenshot x.png",
                     "/dev/stdin: is a FIFO, a file was expected"),
       }) {
    const Outcome outcome = runShell(folder(), command);
    expectRefused(outcome, command);
    EXPECT_THAT(outcome.err, HasSubstr(says)) << command;
  }
}

/// "café" in Latin 1.
const std::string cafe = "caf\xE9";

class NamesThatAreNoText : public EndToEnd {
 protected:
  void SetUp() override {
    fs::create_directories(file(cafe));
    std::ofstream(file(cafe) / (cafe + ".toml"))
        << replaced(smallStudy(), "name = \"unshadowed\"",
                    "file = \"file:caf%E9.glsl\"\nlabel = \"own\"")
        << "\n[[threshold]]\nmethod = \"own\"\nmax = 0.9\n";
    fs::copy(fs::path(GNOMON_SCENES) / "../shaders/methods/unshadowed.glsl",
             file(cafe) / (cafe + ".glsl"));
    write("small.toml", smallStudy());
  }
};

TEST_F(NamesThatAreNoText, AreRunKeptAndRunAgain) {
  const std::string study = "$'caf\\xe9/caf\\xe9.toml'";
  for (const std::string& command : {
           "gnomon run " + study + " --out $'out\\xe9'",
           "gnomon run " + study + " --out out",
           std::string("gnomon run small.toml --replace unshadowed=$'caf\\xe9/caf\\xe9.glsl' "
                       "--out out"),
           "gnomon check " + study +
               " --out out --baseline $'refs\\xe9' --update-baseline "
               "--reason x --junit out/j.xml",
           "gnomon export " + study + " --out out",
           "gnomon view " + study + " --out out --screenshot $'out/\\xe9.png'",
       }) {
    const Outcome outcome = runShell(folder(), command);
    EXPECT_EQ(outcome.status, 0) << command << outcome.err;
    const fs::path copy = file("out/small/small.toml");
    if (fs::exists(copy)) {
      const nlohmann::json first = summary("small").at("results");
      const Outcome again = runShell(folder(), "gnomon run out/small/small.toml --out again");
      EXPECT_EQ(again.status, 0) << command << again.err;
      EXPECT_EQ(summary("small", "again").at("results"), first) << command;
    }
    fs::remove_all(file("again"));
    fs::remove_all(file("out"));
  }
}

TEST_F(NamesThatAreNoText, AreSavedFromTheViewer) {
  const fs::path study = file(cafe) / (cafe + ".toml");
  app::StudyState state;
  state.file = study;
  const study::StudySpec opened = study::readStudy(study);
  for (const fs::path& target :
       {file("saved.toml"), file(cafe) / "saved.toml", file("b\xFF/" + cafe + ".toml")}) {
    app::saveStudy(state, target);
    const study::StudySpec saved = study::readStudy(target);
    ASSERT_EQ(saved.methods.size(), opened.methods.size());
    EXPECT_TRUE(fs::equivalent(saved.methods[0].file, opened.methods[0].file));
    EXPECT_EQ(saved.methods[0].label, "own");
  }
}

TEST_F(NamesThatAreNoText, AMethodIsLabelledByWhatCanBeWritten) {
  study::StudyOptions options;
  write("own.toml",
        replaced(smallStudy(), "name = \"unshadowed\"", "file = \"file:caf%E9/caf%E9.glsl\""));
  const study::StudySpec study = study::readStudy(file("own.toml"));
  EXPECT_EQ(study.methods.at(0).label, "caf%E9");
  EXPECT_TRUE(fs::equivalent(study.methods.at(0).file, file(cafe) / (cafe + ".glsl")));
}

}  // namespace
}  // namespace gnomon::test
