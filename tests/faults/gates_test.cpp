#include <gmock/gmock.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <optional>

#include "faults/shell_run.h"
#include "support/test_length.h"

// Ways to make a gate pass that should not: limits that nothing can fail, options that leave
// nothing to judge, references that were tampered with, results of an earlier check, output that is
// lost. None may end with exit status 0, die of a signal, or leave a JUnit file that says pass.

namespace gnomon::test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* stalePass =
    "<?xml version=\"1.0\"?>\n<testsuites name=\"earlier\" tests=\"1\" failures=\"0\" "
    "errors=\"0\"/>\n";

using Clock = std::chrono::steady_clock;

/// Tried and fooled gates of one suite.
class Tally {
 public:
  explicit Tally(const char* what) : what_(what) {}
  ~Tally() { std::printf("faults: %d %s, %d fooled\n", tried_, what_, fooled_); }
  Tally(const Tally&) = delete;
  Tally& operator=(const Tally&) = delete;
  void count(bool fooled) {
    ++tried_;
    fooled_ += fooled ? 1 : 0;
  }

 private:
  const char* what_;
  int tried_ = 0, fooled_ = 0;
};

class Gates : public EndToEnd {
 protected:
  [[nodiscard]] Outcome shell(const std::string& script) const {
    return runShell(folder(), script, {"sh", 600, true});
  }

  /// Runs a check in whose JUnit file an earlier one has passed, and expects that this one does
  /// not.
  void expectRefused(Tally& tally, const std::string& what, const std::string& script,
                     std::vector<int> statuses) const {
    write("junit.xml", stalePass);
    const Outcome outcome = shell(script);
    const std::string junit = read("junit.xml");
    const bool hasStatus =
        std::find(statuses.begin(), statuses.end(), outcome.status) != statuses.end();
    const bool saysPass =
        junit.find("earlier") != std::string::npos ||
        (junit.find("<error") == std::string::npos && junit.find("<failure") == std::string::npos);
    EXPECT_TRUE(hasStatus) << what << ": exit status " << outcome.status << "\n"
                           << outcome.err << outcome.out;
    EXPECT_FALSE(saysPass) << what << ":\n" << junit;
    tally.count(!hasStatus || saysPass);
  }
};

// Limits of a study.

/// Keys of the [[threshold]], then options of the command.
constexpr const char* limits[] = {
    // Out of the range, or at its end.
    "max = 1e300", "max = 1.0", "max = 1", "max = 20", "max = 5", "max = 1.0000001",
    "max = 9223372036854775807", "max = 1.7976931348623157e308", "max = -0.1", "max = -5",
    "min = -5", "min = 0", "min = 0.0", "min = -0.0", "min = -1e300", "min = 1.5",
    "min = 0\nmax = 1", "min = -1\nmax = 0.5", "min = 0.1\nmax = 2", "min = 0.5\nmax = 0.4",
    // No number.
    "max = nan", "max = -nan", "max = inf", "max = +inf", "min = -inf", "min = nan", "max = true",
    "max = [0.5]", "max = {}", "max = 2026-01-01", "max = \"\"", "max = \"0.05\"", "max = \"five\"",
    "max = \"nan %\"", "max = \"inf %\"",
    // Percentages.
    "max = \"100 %\"", "max = \"500 %\"", "max = \"-1 %\"", "max = \"1e4 %\"", "max = \"%\"",
    "max = \"5 %%\"", "max = \"% 5\"", "min = \"0 %\"", "min = \"200 %\"",
    "metric = \"mcc\"\nmin = \"5 %\"", "metric = \"hd95\"\nmax = \"5 %\"",
    "metric = \"shadow_length_ratio\"\nmax = \"120 %\"",
    // The other metrics.
    "metric = \"false_shadow\"\nmax = 1", "metric = \"false_light\"\nmax = 1",
    "metric = \"fpr\"\nmax = 1", "metric = \"fnr\"\nmax = 1", "metric = \"ber\"\nmax = 1",
    "metric = \"iou\"\nmin = 0", "metric = \"f1\"\nmin = 0", "metric = \"mcc\"\nmin = -1",
    "metric = \"mcc\"\nmax = 1", "metric = \"mcc\"\nmin = -2", "metric = \"iou\"\nmax = 1",
    "metric = \"boundary_iou_1\"\nmin = 0", "metric = \"boundary_iou_4\"\nmin = -1",
    "metric = \"surface_dice_2\"\nmin = 0", "metric = \"surface_dice_4\"\nmax = 1",
    "metric = \"assd\"\nmax = 1e6", "metric = \"assd\"\nmin = 0", "metric = \"hd95\"\nmax = 91",
    "metric = \"hd95\"\nmax = 1e300", "metric = \"hd95\"\nmin = -1",
    "metric = \"shadow_length_ratio\"\nmax = 1e9", "metric = \"shadow_length_ratio\"\nmin = 0",
    "metric = \"shadow_length_q1\"\nmin = 0", "metric = \"shadow_length_q3\"\nmax = 1e300",
    "metric = \"shadow_runs\"\nmin = 0", "metric = \"shadow_runs\"\nmax = 1e6",
    // What judges no method.
    "metric = \"prevalence\"\nmax = 0.9", "metric = \"shadow_runs\"\nmin = 1",
    "metric = \"false_light\"\nregion = \"lit\"\nmax = 0.01",
    "metric = \"false_shadow\"\nregion = \"cast\"\nmax = 0.01",
    "metric = \"false_shadow\"\nregion = \"attached\"\nmax = 0.01",
    "metric = \"false_shadow\"\nregion = \"distant\"\nmax = 0.01",
    "metric = \"iou\"\nregion = \"lit\"\nmax = 0.5",
    "metric = \"prevalence\"\nregion = \"cast\"\nmin = 0.5",
    // Names that match nothing, and keys that do nothing.
    "", "metric = \"iou\"", "maximum = 0.5", "max = 0.5\nmax_value = 0.1",
    "max = 0.5\nmethod = \"nobody\"", "max = 0.5\nmethod = \"\"", "max = 0.5\nlight = \"noon\"",
    "max = 0.5\nview = \"front\"", "max = 0.5\nregion = \"dark\"", "max = 0.5\nanswer = \"best\"",
    "max = 0.5\nmetric = \"accuracy\"", "max = 0.5\nmetric = \"\"", "max = 0.5\nquick = 1",
    // The command line.
    "max = 0.5 | --set threshold.0.max=20", "max = 0.5 | --set threshold.0.max=1",
    "max = 0.5 | --set threshold.0.max=1e999", "max = 0.5 | --set threshold.0.max=inf",
    "max = 0.5 | --set 'threshold.0.max=\"100 %\"'", "max = 0.5 | --set threshold=[]",
    "max = 0.5 | --set threshold=1", "max = 0.5 | --set 'threshold=[{}]'",
    "max = 0.5 | --set threshold.0.metric=prevalence",
    "max = 0.5 | --set threshold.0.method=nobody", "max = 0.5 | --set threshold.0.min=-1",
    "max = 0.5 | --set threshold.1.max=0.1", "max = 0.5 | --set threshold.0.max",
    "max = 0.5\nmethod = \"max-forsyth\" | --method unshadowed", "max = 0.5 | --method nobody",
    "max = 0.5\nquick = false | --quick", "max = 0.5 | --quick --set threshold.0.quick=false",
    "max = 0.5 | --set 'study.name=\"../small\"'", "max = 0.5 | --replace nobody=unshadowed",
    "max = 0.5 | --replace max-forsyth=nobody", "max = 0.5 | --update-baseline --reason x",
    "max = 0.5 | --reason x", "max = 0.5 | --baseline-pictures", "max = 0.5 | --gatd",
    "max = 0.5 | small.toml",
    // What would judge but has nothing there: needs a run.
    "max = 0.5\nregion = \"distant\"", "max = 1e-9", "max = \"0.0001 %\"", "min = \"99.99 %\"",
    "max = 0.9 | --set relief.height=1e-9 --set threshold.0.region=cast",
    "max = 0.9 | --set view.0.eye=[0,0,-80]"};

TEST_F(Gates, NoLimitOfAStudyIsWithoutMeaning) {
  Tally tally("limits of studies");
  const auto stride = static_cast<std::size_t>(repetitions(3, 1));
  for (std::size_t i = 0; i < std::size(limits); i += stride) {
    const std::string one = limits[i];
    const std::size_t bar = one.find(" | ");
    const std::string options = bar == std::string::npos ? "" : one.substr(bar + 3);
    write("small.toml", smallStudy() + "\n[[threshold]]\n" + one.substr(0, bar) + "\n");
    expectRefused(tally, one, "\"$gnomon\" check small.toml --junit junit.xml " + options,
                  {1, 2, 3});
  }
  static_assert(std::size(limits) >= 100);
}

TEST_F(Gates, ALimitThatSaysSomethingIsTaken) {
  for (const char* keys : {"max = 0.9", "max = \"90 %\"", "min = 0\nmax = \"90%\"", "min = 1e-9",
                           "metric = \"mcc\"\nmin = -0.5", "metric = \"hd95\"\nmax = 60",
                           "metric = \"fnr\"\nmethod = \"max-forsyth\"\nmax = 0.99"}) {
    write("small.toml", smallStudy() + "\n[[threshold]]\n" + keys + "\n");
    const Outcome outcome = shell("\"$gnomon\" check small.toml --junit junit.xml");
    EXPECT_EQ(outcome.status, 0) << keys << "\n" << outcome.err << outcome.out;
    EXPECT_THAT(read("junit.xml"), Not(AnyOf(HasSubstr("<error"), HasSubstr("<failure")))) << keys;
  }
}

// Gates on two pictures.

/// A mask of 8 × 8 pixels as a PGM: white lit.
std::string pgm(const std::function<bool(int, int)>& isLit, int side = 8) {
  std::string text = "P5\n" + std::to_string(side) + " " + std::to_string(side) + "\n255\n";
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) text += static_cast<char>(isLit(x, y) ? 255 : 0);
  }
  return text;
}

constexpr const char* comparisons[] = {
    "--max error_rate=20", "--max error_rate=1", "--max error_rate=1.0", "--max error_rate=1e300",
    "--max error_rate=nan", "--max error_rate=inf", "--max error_rate=-1",
    "--max error_rate=", "--max error_rate", "--max =0.5", "--max 0.5", "--max 'error_rate=0.5 '",
    "--max error_rate=0,5", "--max 'error_rate=100 %'", "--max 'error_rate=5 %%'",
    "--max 'error_rate=%'", "--max error_rate=0x1p-3", "--max accuracy=0.5", "--max ERROR_RATE=0.5",
    "--max ' error_rate=0.5'", "--min error_rate=0", "--min error_rate=-5", "--min iou=0",
    "--min iou=1.5", "--min iou=-1e300", "--min mcc=-1", "--min mcc=-2", "--max mcc=1",
    "--max 'mcc=5 %'", "--max 'hd95=5 %'", "--max hd95=11.4", "--max hd95=1e300", "--max assd=12",
    "--min assd=0", "--max ber=1", "--max prevalence=0.9", "--min prevalence=0.1",
    "--max prevalence=0.9 --min prevalence=0.1", "--max shadow_length_ratio=2",
    "--max error_rate=0.5 --max error_rate=20", "--min boundary_iou_1=0", "--min surface_dice_4=0",
    "--maximum error_rate=0.5", "--binarise 0 --max error_rate=0.5",
    "--roi dark.pgm --max error_rate=0.5", "--roi small.pgm --max error_rate=0.5",
    "--channel nobody --max error_rate=0.5",
    // The candidate is the truth's negative: what is judged must fail.
    "--max error_rate=0.999", "--max 'error_rate=99.9 %'", "--min mcc=-0.99", "--min iou=0.001",
    "--max error_rate=0", "--min error_rate=0.1 --max error_rate=0.9"};

TEST_F(Gates, NoGateOnPicturesIsWithoutMeaning) {
  write("truth.pgm", pgm([](int x, int) { return x < 4; }));
  write("wrong.pgm", pgm([](int x, int) { return x >= 4; }));
  write("dark.pgm", pgm([](int, int) { return false; }));
  write("small.pgm", pgm([](int, int) { return true; }, 4));
  Tally tally("gates on pictures");
  const auto stride = static_cast<std::size_t>(repetitions(2, 1));
  for (std::size_t i = 0; i < std::size(comparisons); i += stride) {
    const char* options = comparisons[i];
    const Outcome outcome =
        shell(std::string("\"$gnomon\" compare wrong.pgm truth.pgm ") + options);
    const bool refused = outcome.status >= 1 && outcome.status <= 3;
    EXPECT_TRUE(refused) << options << ": exit status " << outcome.status << "\n" << outcome.out;
    tally.count(!refused);
  }
  EXPECT_EQ(
      shell("\"$gnomon\" compare truth.pgm truth.pgm --max 'error_rate=5 %' --min iou=1").status,
      0);
}

// References.

class References : public Gates {
 protected:
  void SetUp() override {
    write("small.toml", smallStudy() + "\n[[threshold]]\nmax = 0.9\n");
    const Outcome outcome =
        shell("\"$gnomon\" check small.toml --baseline ref --update-baseline --reason first");
    ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
    good_ = nlohmann::json::parse(read("ref/small.json"));
    ASSERT_EQ(shell("\"$gnomon\" check small.toml --baseline ref --junit junit.xml").status, 0);
  }
  [[nodiscard]] const nlohmann::json& good() const { return good_; }

 private:
  nlohmann::json good_;
};

using Json = nlohmann::json;

/// References with one of their keys, or one of each value's, replaced.
struct Tampering {
  const char* key;
  Json value;
  bool isOfValues = true;
};

/// What stands in the file after it.
std::string tampered(Json json, const Tampering& by) {
  if (!by.isOfValues) {
    json[by.key] = by.value;
  } else {
    for (Json& entry : json.at("values")) entry[by.key] = by.value;
  }
  return json.dump();
}

std::vector<std::string> tamperings(const Json& good) {
  std::vector<std::string> texts;
  for (const Tampering& by : std::vector<Tampering>{{"tolerance", 1e9},
                                                    {"tolerance", 1.0},
                                                    {"tolerance", 0.5},
                                                    {"tolerance", 1e308},
                                                    {"tolerance", 0.0},
                                                    {"tolerance", -1.0},
                                                    {"tolerance", "0.001"},
                                                    {"tolerance", nullptr},
                                                    {"spread", -1.0},
                                                    {"value", 2.0},
                                                    {"value", 1e300},
                                                    {"value", -1.0},
                                                    {"value", 1.0},
                                                    {"value", 0.0},
                                                    {"value", nullptr},
                                                    {"method", "other"},
                                                    {"light", "other"},
                                                    {"metric", "iou"},
                                                    {"answer", "best"},
                                                    {"study", "other"},
                                                    {"study", "other", false},
                                                    {"form", "quick", false},
                                                    {"schema", "gnomon-baseline/1", false},
                                                    {"values", Json::array(), false},
                                                    {"values", nullptr, false}}) {
    texts.push_back(tampered(good, by));
  }
  Json one = good;
  one["values"][0]["tolerance"] = 1e9;
  Json missing = good;
  missing["values"].erase(0);
  Json twice = good;
  twice["values"].push_back(twice["values"][0]);
  for (const double spread : {1e9, 0.5}) {
    const Json wide = Json::parse(tampered(good, {"spread", spread}));
    texts.push_back(tampered(wide, {"tolerance", 2 * spread}));
  }
  for (const Json& json : {one, missing, twice}) texts.push_back(json.dump());
  const std::string text = good.dump();
  texts.insert(texts.end(), {"values: all fine", "", "0", text.substr(0, 200),
                             replaced(text, "\"tolerance\":", "\"tolerance\":NaN,\"t\":"),
                             replaced(text, "\"tolerance\":", "\"tolerance\":1e999,\"t\":")});
  return texts;
}

TEST_F(References, NoneThatWasTamperedWithPasses) {
  Tally tally("references");
  const std::string check = "\"$gnomon\" check small.toml --baseline ref --junit junit.xml";
  const auto stride = static_cast<std::size_t>(repetitions(3, 1));
  const std::vector<std::string> texts = tamperings(good());
  for (std::size_t i = 0; i < texts.size(); i += stride) {
    write("ref/small.json", texts[i]);
    expectRefused(tally, texts[i], check, {1, 3});
  }
  expectRefused(tally, "a file that is missing", "rm ref/small.json; " + check, {3});
  expectRefused(tally, "a folder in its place", "mkdir ref/small.json; " + check, {3});
  expectRefused(tally, "no folder at all", "rm -r ref; " + check, {3});
}

// An earlier check's JUnit file.

TEST_F(Gates, AnEarlierPassStaysInNoJunitFile) {
  write("small.toml", smallStudy() + "\n[[threshold]]\nmax = 0.9\n");
  write("none.toml", smallStudy());
  write("bad.toml", "[study]\nname = ");
  Tally tally("checks over an earlier pass");
  for (const char* command : {"check --junit junit.xml",
                              "check --junit=junit.xml",
                              "check small.toml --junit junit.xml --nonsense",
                              "--junit junit.xml",
                              "check --nonsense --junit junit.xml small.toml",
                              "run small.toml --junit junit.xml",
                              "chek small.toml --junit junit.xml",
                              "check small.toml --junit junit.xml --threads 0",
                              "check small.toml --junit junit.xml --threads many",
                              "check small.toml --junit junit.xml --reason x",
                              "check small.toml --junit junit.xml --out",
                              "check small.toml --junit junit.xml --junit",
                              "check small.toml --set x --junit junit.xml",
                              "check missing.toml --junit junit.xml",
                              "check bad.toml --junit junit.xml",
                              "check none.toml --junit junit.xml",
                              "check . --junit junit.xml",
                              "check small.toml small.toml --junit junit.xml",
                              "check small.toml none.toml --junit junit.xml",
                              "check small.toml --out small.toml --junit junit.xml",
                              "check small.toml --baseline nowhere --junit junit.xml"}) {
    expectRefused(tally, command, std::string("\"$gnomon\" ") + command, {2, 3});
  }
  expectRefused(tally, "without shaders",
                "GNOMON_SHADERS=/nonexistent \"$gnomon\" check small.toml --junit junit.xml",
                {3, 4});
  expectRefused(
      tally, "without OpenGL",
      "__EGL_VENDOR_LIBRARY_DIRS=/nonexistent __EGL_VENDOR_LIBRARY_FILENAMES= \"$gnomon\" "
      "check small.toml --junit junit.xml",
      {77});
  expectRefused(tally, "without gnuplot",
                "PATH=/nonexistent \"$gnomon\" check small.toml --junit junit.xml", {4});
  expectRefused(tally, "with its output lost",
                "\"$gnomon\" check small.toml --junit junit.xml >/dev/full", {3});
  expectRefused(tally, "with its output closed",
                "\"$gnomon\" check small.toml --junit junit.xml >&-", {3});
}

TEST_F(Gates, AFileThatIsNoJunitIsNotReplaced) {
  const std::string study = smallStudy() + "\n[[threshold]]\nmax = 0.9\n";
  write("small.toml", study);
  for (const char* command : {"check --junit small.toml", "check small.toml --junit small.toml"}) {
    const Outcome outcome = shell(std::string("\"$gnomon\" ") + command);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_THAT(outcome.err, HasSubstr("a file that is no JUnit XML stands there"));
    EXPECT_EQ(read("small.toml"), study);
  }
}

TEST_F(Gates, APipeGetsTheResultAlone) {
  write("small.toml", smallStudy() + "\n[[threshold]]\nmax = 0.9\n");
  const Outcome outcome = shell(
      "mkfifo pipe; cat pipe >heard & \"$gnomon\" check small.toml --junit pipe >table; "
      "status=$?; [ -p pipe ] || echo replaced; kill $! 2>/dev/null; exit $status");
  EXPECT_EQ(outcome.out.find("replaced"), std::string::npos);
  const std::string heard = read("heard");
  EXPECT_EQ(heard.find("<testsuites"), heard.rfind("<testsuites")) << heard;
  EXPECT_THAT(heard, Not(HasSubstr("<error")));
}

/// Tells when somebody opens a file.
class OpenWatch {
 public:
  explicit OpenWatch(const std::filesystem::path& file) : watch_(inotify_init1(IN_NONBLOCK)) {
    EXPECT_GE(inotify_add_watch(watch_, file.c_str(), IN_OPEN), 0);
  }
  ~OpenWatch() { close(watch_); }
  OpenWatch(const OpenWatch&) = delete;
  OpenWatch& operator=(const OpenWatch&) = delete;
  [[nodiscard]] bool isOpened() const {
    alignas(inotify_event) char event[4096];
    return ::read(watch_, event, sizeof event) > 0;
  }

 private:
  int watch_;
};

/// From the moment on at which the first study is opened, a check that is killed leaves an error.
TEST_F(Gates, NoKilledCheckLeavesAnEarlierPass) {
  std::vector<std::string> arguments = {"check", "--junit", "junit.xml"};
  constexpr int studies = 20;
  for (int i = 0; i < studies; ++i) {
    const std::string name = "s" + std::to_string(i);
    write(name + ".toml",
          replaced(smallStudy(), "\"small\"", "\"" + name + "\"") + "\n[[threshold]]\nmax = 0.9\n");
    arguments.push_back(name + ".toml");
  }
  Tally tally("killed checks");
  const int kills = repetitions(4, 60);
  // A run with a filled cache, as the killed ones have it.
  const std::vector<std::string> environment = {"GNOMON_CACHE=" + file("cache").string()};
  ASSERT_EQ(gnomon(arguments, environment).status, 0);
  const auto first = Clock::now();
  ASSERT_EQ(gnomon(arguments, environment).status, 0);
  const auto whole = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - first);
  int killed = 0;
  for (int i = 0; i < kills; ++i) {
    write("junit.xml", stalePass);
    const auto delay = i * whole / kills;
    const OpenWatch watch(file("s0.toml"));
    bool isStale = false;
    std::optional<Clock::time_point> begin;
    const bool isKilled = runAndKillWhen(folder(), arguments, environment, [&] {
      if (!begin && watch.isOpened()) {
        begin = Clock::now();
        isStale = read("junit.xml").find("earlier") != std::string::npos;
      }
      return begin && Clock::now() - *begin >= delay;
    });
    EXPECT_TRUE(begin) << "no study was opened";
    EXPECT_FALSE(isStale) << "as the first study was opened";
    if (!isKilled) continue;  // it was faster than before, and its result is its own
    ++killed;
    const std::string junit = read("junit.xml");
    const bool saysError = junit.find("<error") != std::string::npos;
    const bool isWhole = junit.ends_with("</testsuites>\n");
    EXPECT_TRUE(saysError && isWhole) << "killed after " << delay.count() << " ms:\n" << junit;
    tally.count(isStale || !saysError || !isWhole);
  }
  EXPECT_GE(killed, kills / 2);
}

}  // namespace
}  // namespace gnomon::test
