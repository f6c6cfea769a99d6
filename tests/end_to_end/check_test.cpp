#include <gmock/gmock.h>
#include <pugixml.hpp>

#include <algorithm>
#include <filesystem>

#include "end_to_end/support/program.h"

// What a check leaves for a build server, whatever becomes of its studies.
// The committed thresholds catch a shader that is wrong, and pass the one that they are for: a gate
// that nothing fails is none. That every scene passes as it is: the tests named `check.SCENE`.

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Check : public EndToEnd {
 protected:
  [[nodiscard]] Outcome check(const std::string& threshold, const std::string& command = "check") {
    write("small.toml", smallStudy() + "\n[[threshold]]\n" + threshold);
    return gnomon({command, "small.toml"});
  }
};

TEST_F(Check, WritesItsReportWhetherItPassesOrNot) {
  EXPECT_EQ(check("max = 0.0001\n").status, 1);
  EXPECT_EQ(summary("small").at("status"), "fail");
  const nlohmann::json thresholds = summary("small").at("thresholds");
  ASSERT_EQ(thresholds.size(), 2U) << "one for each method";
  EXPECT_EQ(thresholds.at(0).at("passed"), false);
  EXPECT_EQ(thresholds.at(1).at("maximum"), 0.0001);
  EXPECT_EQ(thresholds.at(1).at("value"),
            resultOf(summary("small"), "max-forsyth", "evening", "camera").at("error_rate"));
}

/// A run records thresholds and ends with 0.
TEST_F(Check, TheControlFailsTheGateThatTheMethodPasses) {
  EXPECT_EQ(check("max = 0.0001\n", "run").status, 0);
  EXPECT_EQ(summary("small").at("status"), "fail");
  const double error =
      resultOf(summary("small"), "max-forsyth", "evening", "camera").at("error_rate");
  const std::string gate = "max = " + nlohmann::json(1.2 * error).dump() + "\n";
  EXPECT_EQ(check("method = \"max-forsyth\"\n" + gate).status, 0);
  EXPECT_EQ(check("method = \"unshadowed\"\n" + gate).status, 1);
}

class CheckFiles : public EndToEnd {
 protected:
  void writeStudy(const std::string& name, const std::string& thresholds,
                  const std::string& from = "width = 64", const std::string& to = "width = 64") {
    const std::string text = replaced(smallStudy(), "\"small\"", "\"" + name + "\"");
    write(name + ".toml", replaced(text, from, to) + "\n" + thresholds);
  }
  [[nodiscard]] pugi::xml_document junit(const std::string& name = "junit.xml") const {
    const std::string text = read(name);
    pugi::xml_document document;
    EXPECT_TRUE(document.load_buffer(text.data(), text.size())) << text;
    return document;
  }
  /// failures, errors, skipped of one study's suite.
  [[nodiscard]] std::vector<int> countsOf(const std::string& study) const {
    const pugi::xml_document document = junit();
    const std::string path = "//testsuite[@name='" + study + "']";
    const pugi::xml_node suite = document.select_node(path.c_str()).node();
    return {suite.attribute("failures").as_int(-1), suite.attribute("errors").as_int(-1),
            suite.attribute("skipped").as_int(-1)};
  }
};

const std::string easy = "[[threshold]]\nmethod = \"max-forsyth\"\nmax = 0.9\n";
const std::string hard = "[[threshold]]\nmethod = \"max-forsyth\"\nmax = 0.0001\n";

TEST_F(CheckFiles, AThresholdBelowTheMeasuredValueIsAFailure) {
  writeStudy("a", easy);
  EXPECT_EQ(gnomon({"check", "a.toml", "--junit", "junit.xml"}).status, 0);
  EXPECT_EQ(countsOf("a"), (std::vector<int>{0, 0, 0}));
  writeStudy("a", hard);
  const Outcome outcome = gnomon({"check", "a.toml", "--junit", "junit.xml"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(countsOf("a"), (std::vector<int>{1, 0, 0}));
  EXPECT_THAT(outcome.out, HasSubstr("max-forsyth, error_rate ≤ 0.0001, camera, evening: 0."));
  EXPECT_THAT(outcome.out, HasSubstr("\n    gnomon check a.toml --method max-forsyth\n"));
  const pugi::xml_document document = junit();
  EXPECT_THAT(document.select_node("//failure/@message").attribute().value(),
              HasSubstr("a.toml:44: max-forsyth, error_rate ≤ 0.0001, camera, evening"));
}

TEST_F(CheckFiles, TheCommandThatItPrintsReproducesTheFailure) {
  writeStudy("a", hard + easy);
  write("it's.toml", read("a.toml"));
  const Outcome first = gnomon({"check", "it's.toml", "--quick", "--set", "truth.step=0.125"});
  ASSERT_EQ(first.status, 1);
  const std::string line =
      "gnomon check 'it'\\''s.toml' --quick --set truth.step=0.125 --method max-forsyth";
  ASSERT_THAT(first.out, HasSubstr("    " + line + "\n"));
  const Outcome again = gnomon(
      {"check", "it's.toml", "--quick", "--set", "truth.step=0.125", "--method", "max-forsyth"});
  EXPECT_EQ(again.status, 1);
  EXPECT_EQ(again.out, first.out);
}

TEST_F(CheckFiles, OneStudyThatCannotBeRunKeepsNoOtherFromIt) {
  writeStudy("good", easy);
  writeStudy("typo", easy, "width = 64", "widht = 64");
  writeStudy("away", easy, "eye = [0, 0, 80]", "eye = [0, 0, 80]\ntarget = [0, 0, 160]");
  writeStudy("bad", hard);
  const Outcome outcome = gnomon({"check", "typo.toml", "away.toml", "missing.toml", "bad.toml",
                                  "good.toml", "--junit", "junit.xml", "--github"});
  EXPECT_EQ(outcome.status, 3) << "bad input is worse than a threshold that failed";
  EXPECT_EQ(countsOf("good"), (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(countsOf("bad"), (std::vector<int>{1, 0, 0}));
  EXPECT_EQ(countsOf("typo"), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(countsOf("missing"), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(countsOf("away"), (std::vector<int>{0, 1, 0})) << "a view that shows nothing";
  EXPECT_EQ(junit().document_element().attribute("tests").as_int(), 5);
  EXPECT_THAT(outcome.err, HasSubstr("gnomon: typo.toml:"));
  EXPECT_THAT(outcome.err, HasSubstr("gnomon: away.toml:"));
  EXPECT_THAT(outcome.out, HasSubstr("\n::error file=typo.toml,line="));
  EXPECT_THAT(outcome.out, HasSubstr("\n::error file=bad.toml,line=44,title=bad%3A threshold "
                                     "failed::max-forsyth, error_rate"));
  EXPECT_THAT(outcome.out, HasSubstr("Not passed: typo, away, missing, bad\n"));
  EXPECT_EQ(summary("good").at("status"), "pass");
}

TEST_F(CheckFiles, WhatIsUndefinedIsAnError) {
  // No occluder is farther than the radius, the whole map: nothing is distant.
  writeStudy("a", easy + "region = \"distant\"\n");
  EXPECT_EQ(gnomon({"check", "a.toml", "--junit", "junit.xml"}).status, 1);
  EXPECT_EQ(countsOf("a"), (std::vector<int>{0, 1, 0}));
}

TEST_F(CheckFiles, WhatIsLeftOutIsSkippedAndPassesNothing) {
  writeStudy("a", easy + "[[threshold]]\nmethod = \"unshadowed\"\nmin = 0.01\nquick = false\n");
  const std::vector<std::string> check = {"check",   "a.toml", "--junit",         "junit.xml",
                                          "--quick", "--set",  "truth.step=0.125"};
  EXPECT_EQ(gnomon(check).status, 0);
  EXPECT_EQ(countsOf("a"), (std::vector<int>{0, 0, 1}));
  std::vector<std::string> nothing = check;
  nothing.insert(nothing.end(), {"--method", "unshadowed"});
  const Outcome outcome = gnomon(nothing);
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("every [[threshold]] is left out"));
  EXPECT_EQ(countsOf("a"), (std::vector<int>{0, 1, 2}));
}

TEST_F(CheckFiles, WithoutOpenGlEveryStudyHasAnError) {
  writeStudy("a", easy);
  writeStudy("b", easy);
  const Outcome outcome =
      gnomon({"check", "a.toml", "b.toml", "--junit", "junit.xml"},
             {"__EGL_VENDOR_LIBRARY_DIRS=/nonexistent", "__EGL_VENDOR_LIBRARY_FILENAMES="});
  EXPECT_EQ(outcome.status, 77);
  EXPECT_EQ(countsOf("a"), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(countsOf("b"), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(CheckFiles, ACheckThatIsKilledLeavesNoPass) {
  writeStudy("a", easy);
  EXPECT_EQ(gnomon({"check", "a.toml", "--junit", "junit.xml"}).status, 0);
  ASSERT_EQ(countsOf("a"), (std::vector<int>{0, 0, 0}));
  // Of this size no run ends within the time that it is given. How soon the file is there depends
  // on the machine's load.
  writeStudy("a", easy, "width = 64", "width = 8192");
  std::filesystem::remove(file("junit.xml"));
  for (int wait = 250; wait <= 16000 && !std::filesystem::exists(file("junit.xml")); wait *= 2) {
    runAndKill(folder(), {"check", "a.toml", "--junit", "junit.xml", "--set", "truth.step=0.005"},
               wait);
  }
  EXPECT_EQ(countsOf("a"), (std::vector<int>{0, 1, 0}));
  EXPECT_THAT(read("junit.xml"), HasSubstr("did not come to its end"));
}

// A summary is added to its file: to no study, and to nothing else that the check reads.
TEST_F(CheckFiles, ASummaryIsAddedToNothingThatIsRead) {
  writeStudy("a", easy + "[[method]]\nfile = \"mine.glsl\"\n");
  std::filesystem::copy_file(GNOMON_SCENES "/starter/shadows/my-shadow.glsl", file("mine.glsl"));
  const std::vector<std::string> check = {"check", "a.toml", "--baseline", "references"};
  std::vector<std::string> update = check;
  update.insert(update.end(), {"--update-baseline", "--reason", "first"});
  ASSERT_EQ(gnomon(update).status, 0);
  for (const char* name : {"a.toml", "mine.glsl", "references/a.json", "junit.xml"}) {
    std::vector<std::string> words = check;
    words.insert(words.end(), {"--junit", "junit.xml", "--summary", name});
    const Outcome outcome = gnomon(words);
    EXPECT_EQ(outcome.status, 2);
    const bool isRead = std::string(name) != "junit.xml";
    EXPECT_EQ(outcome.err, std::string("gnomon: --summary ") + name +
                               (isRead ? ": the command reads this file, another one expected\n"
                                       : ": --junit writes this file too\n"));
    EXPECT_THAT(read(name), Not(HasSubstr("## Shadows")));
  }
}

class CommittedGates : public EndToEnd, public ::testing::WithParamInterface<const char*> {
 protected:
  [[nodiscard]] Outcome check(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"check",
                                          std::string(GNOMON_SCENES "/") + GetParam() + ".toml",
                                          "--quick", "--method", "onoue-2004"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gnomon(arguments);
  }
};

class CatchAFault : public CommittedGates {};

TEST_P(CatchAFault, AFlippedSignOfEquationTwo) {
  const Outcome outcome =
      check({"--replace", "onoue-2004=" GNOMON_OWN_METHODS "/flipped-onoue-2004.glsl"});
  EXPECT_EQ(outcome.status, 1) << outcome.err << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("onoue-2004, error_rate ≤ "));
  EXPECT_THAT(outcome.out, HasSubstr("too large by"));
  EXPECT_EQ(summary(GetParam()).at("methods").at(0).at("name"), "flipped-onoue-2004");
}

INSTANTIATE_TEST_SUITE_P(Scenes, CatchAFault,
                         ::testing::Values("figure6", "figure7", "figure8", "saddle",
                                           "sloan-cylinder", "sphere-cells", "sphere-columns",
                                           "torus"));

class TellMethodsApart : public CommittedGates {};

TEST_P(TellMethodsApart, TheFlatMethodFailsTheCurvatureAwareOnes) {
  EXPECT_EQ(check({"--replace", "onoue-2004=max-forsyth"}).status, 1);
}

TEST_P(TellMethodsApart, AnotherFileOfTheSameMethodPasses) {
  EXPECT_EQ(check({"--replace", "onoue-2004=onoue-2004"}).status, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TellMethodsApart, ::testing::Values("figure8", "sphere-columns"));

class BaselineCheck : public EndToEnd {
 protected:
  void writeStudy(const std::string& more = {}) const {
    write("small.toml", smallStudy() + "\n[[threshold]]\nmax = 0.9\n" + more);
  }
  [[nodiscard]] Outcome check(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"check", "small.toml", "--baseline", "ref"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gnomon(arguments);
  }
  [[nodiscard]] Outcome update(const std::string& reason = "a test",
                               const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"--update-baseline", "--reason", reason};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return check(arguments);
  }
  static constexpr const char* anotherMethod = "\n[[method]]\nname = \"onoue-2004\"\n";
  [[nodiscard]] nlohmann::json reference() const {
    return nlohmann::json::parse(read("ref/small.json"));
  }
};

/// Exit status, terminal, summary and report have one opinion, and the picture of what changed is
/// that of the masks, sample by sample.
TEST_F(BaselineCheck, PassesWhatItWasWrittenOfAndFailsWhatHasBecomeWorse) {
  writeStudy();
  ASSERT_EQ(update("a test", {"--baseline-pictures"}).status, 0);
  const nlohmann::json values = reference().at("values");
  EXPECT_GE(values.size(), 8U);
  EXPECT_EQ(values.at(0).at("value"),
            resultOf(summary("small"), "unshadowed", "evening", "camera").at("error_rate"));
  EXPECT_EQ(values.at(0).at("spread"),
            summary("small").at("truth").at("flips").at(0).at("flip_rate"));
  EXPECT_EQ(filesBelow("ref/pictures/small").size(), 3U) << "one for each method, and their list";

  const Outcome same = check();
  EXPECT_EQ(same.status, 0) << same.out;
  EXPECT_THAT(same.out, HasSubstr(" references hold"));
  EXPECT_EQ(summary("small").at("status"), "pass");
  EXPECT_EQ(summary("small").at("baseline"), "ref/small.json");
  EXPECT_EQ(summary("small").at("references").size(), values.size());
  EXPECT_TRUE(filesBelow("out/small/references").empty());
  const GreyImage before = mask("small", "camera_evening_max-forsyth");
  const std::string kept = read("ref/pictures/small/camera_evening_max-forsyth_difference.png");
  EXPECT_EQ(kept, read("out/small/images/camera_evening_max-forsyth_difference.png"));

  const Outcome worse =
      check({"--set", "method.1.bake.azimuths=1", "--junit", "junit.xml", "--github"});
  EXPECT_EQ(worse.status, 1) << worse.out;
  EXPECT_THAT(worse.out, HasSubstr("max-forsyth, error_rate ≤ "));
  EXPECT_THAT(worse.out,
              HasSubstr("gnomon check small.toml --set method.1.bake.azimuths=1 --method "
                        "max-forsyth --baseline ref\n"));
  EXPECT_THAT(worse.out, HasSubstr("::error file=ref/small.json,"));
  EXPECT_THAT(read("junit.xml"), HasSubstr("<failure type=\"reference\""));
  EXPECT_THAT(worse.out, Not(HasSubstr("unshadowed, error_rate ≤"))) << "that one is as it was";
  EXPECT_EQ(summary("small").at("status"), "fail");
  const nlohmann::json references = summary("small").at("references");
  std::size_t failed = 0;
  for (const nlohmann::json& row : references) {
    const bool fails = row.at("verdict") == "fail";
    failed += fails ? 1U : 0U;
    EXPECT_TRUE(!fails || row.at("method") == "max-forsyth") << row;
    if (row.at("metric") != "error_rate") continue;
    EXPECT_EQ(row.at("value"), resultOf(summary("small"), row.at("method"), "evening", "camera",
                                        "all", row.at("answer"))
                                   .at("error_rate"));
    EXPECT_EQ(row.at("verdict") == "fail", row.at("value") > row.at("maximum"));
  }
  EXPECT_GT(failed, 0U);
  EXPECT_THAT(read("out/small/report.html"), HasSubstr("what changed"));

  const GreyImage after = mask("small", "camera_evening_max-forsyth");
  const std::string name = "out/small/references/camera_evening_max-forsyth_difference_";
  EXPECT_EQ(read(name + "before.png"), kept);
  const GreyImage red = readGrey(file(name + "change.png"));
  ASSERT_EQ(red.pixels.size(), after.pixels.size());
  int changed = 0;
  for (std::size_t i = 0; i < red.pixels.size(); ++i) {
    // Red of the colours of a signed difference.
    const int expected = before.pixels[i] == 128               ? 255
                         : before.pixels[i] == after.pixels[i] ? (after.pixels[i] == 255 ? 226 : 92)
                         : after.pixels[i] == 0                ? 230
                                                               : 26;
    ASSERT_EQ(red.pixels[i], expected) << i;
    changed += before.pixels[i] != after.pixels[i] ? 1 : 0;
  }
  EXPECT_GT(changed, 20);
  // Nothing of it stays once the reference holds again.
  ASSERT_EQ(check().status, 0);
  EXPECT_TRUE(filesBelow("out/small/references").empty());
}

/// Under a disc it is that of the shares, as far as 8 bits a colour hold them.
TEST_F(BaselineCheck, DrawsWhatChangedOfShares) {
  write("small.toml", replaced(smallStudy(), "elevation = 30\n", "elevation = 30\nradius = 4\n") +
                          "disc = true\n[[threshold]]\nmax = 0.9\n");
  ASSERT_EQ(update("a test", {"--baseline-pictures"}).status, 0);
  const std::string mask = "out/small/masks/camera_evening_max-forsyth-disc.png";
  std::filesystem::copy_file(file(mask), file("before.png"));
  ASSERT_EQ(check({"--set", "method.1.bake.azimuths=1"}).status, 1);
  ASSERT_EQ(gnomon({"compare", mask, "before.png", "--difference", "expected.png"}).status, 0);
  const GreyImage expected = readGrey(file("expected.png"));
  const GreyImage red =
      readGrey(file("out/small/references/camera_evening_max-forsyth-disc_difference_change.png"));
  ASSERT_EQ(red.pixels.size(), expected.pixels.size());
  double apart = 0;
  int changed = 0;
  for (std::size_t i = 0; i < red.pixels.size(); ++i) {
    apart += std::abs(red.pixels[i] - expected.pixels[i]);
    changed += expected.pixels[i] != 255 && std::abs(expected.pixels[i] - 226) > 20 ? 1 : 0;
  }
  EXPECT_GT(changed, 200);
  EXPECT_LT(apart / static_cast<double>(red.pixels.size()), 0.5) << "of 255";
  EXPECT_THAT(read("out/small/report.html"), HasSubstr("what changed: orange has become darker"));
}

TEST_F(BaselineCheck, RemovesItsOwnPicturesAndNoOthers) {
  writeStudy(anotherMethod);
  ASSERT_EQ(update("a test", {"--baseline-pictures"}).status, 0);
  const std::string pictures = "ref/pictures/small/";
  const std::size_t kept = filesBelow(pictures).size();
  write(pictures + "mine_difference.png", "mine");
  writeStudy();
  ASSERT_EQ(update("a test", {"--baseline-pictures"}).status, 0);
  EXPECT_EQ(filesBelow(pictures).size(), kept) << "one method less, and mine";
  EXPECT_EQ(read(pictures + "mine_difference.png"), "mine");
}

TEST_F(BaselineCheck, WhatCouldNotBeJudgedIsNoPass) {
  writeStudy();
  const Outcome missing = check({"--junit", "junit.xml"});
  EXPECT_EQ(missing.status, 3) << "no references";
  EXPECT_THAT(missing.err, HasSubstr("gnomon: ref/small.json: missing, the references of small"));
  EXPECT_THAT(read("junit.xml"), HasSubstr("<testcase classname=\"small\" name=\"baseline\">"));
  EXPECT_EQ(summary("small").at("status"), "fail");
  EXPECT_THAT(read("out/small/report.html"), HasSubstr("ref/small.json: missing"));
  ASSERT_EQ(update().status, 0);
  writeStudy(anotherMethod);
  const Outcome added = check();
  EXPECT_EQ(added.status, 3);
  EXPECT_THAT(added.err, HasSubstr("ref/small.json: no reference for error_rate of onoue-2004"));
  EXPECT_EQ(summary("small").at("status"), "fail");
  const Outcome otherForm = check({"--quick", "--set", "truth.step=0.125"});
  EXPECT_EQ(otherForm.status, 3);
  EXPECT_THAT(otherForm.err, HasSubstr("form: references of the full form found"));
  write("ref/small.json", "no JSON");
  for (const Outcome& outcome : {check(), update()}) {
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, HasSubstr("gnomon: ref/small.json:1: no JSON: "));
  }
  EXPECT_EQ(read("ref/small.json"), "no JSON") << "not written over";
}

/// Of a sweep each value is judged by its own.
TEST_F(BaselineCheck, OfASweepFailsTheValueThatFails) {
  writeStudy("\n[sweep]\nkey = \"relief.height\"\nvalues = [1, 6]\n");
  ASSERT_EQ(update("a test", {"--baseline-pictures"}).status, 0);
  ASSERT_EQ(check().status, 0);
  const std::string text = read("ref/small.json");
  const std::size_t row = text.find("\"study\":\"small/6\"");
  const std::size_t value = text.find("\"value\":", row) + 8;
  write("ref/small.json", text.substr(0, value) + "0.0001" + text.substr(text.find(',', value)));
  EXPECT_EQ(check().status, 1);
  EXPECT_EQ(summary("small/1").at("status"), "pass");
  EXPECT_EQ(summary("small/6").at("status"), "fail");
  EXPECT_EQ(summary("small").at("status"), "fail");
  EXPECT_THAT(read("out/small/report.html"), HasSubstr("6/report.html#references"));
}

TEST_F(BaselineCheck, KeepsTheReasonsAndGivesTheSameBytes) {
  writeStudy();
  ASSERT_EQ(update("first: \"why\"").status, 0);
  const std::string first = read("ref/small.json");
  const Outcome again = update("second");
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.out, HasSubstr("left as it is: no value has changed"));
  EXPECT_EQ(read("ref/small.json"), first);
  std::filesystem::remove(file("ref/small.json"));
  ASSERT_EQ(update("first: \"why\"", {"--threads", "1"}).status, 0);
  EXPECT_EQ(read("ref/small.json"), first);
  writeStudy(anotherMethod);
  ASSERT_EQ(update("third").status, 0);
  const nlohmann::json history = reference().at("history");
  ASSERT_EQ(history.size(), 2U);
  EXPECT_EQ(history.at(0).at("reason"), "first: \"why\"");
  EXPECT_EQ(history.at(1).at("reason"), "third");
}

TEST_F(BaselineCheck, IsNotWrittenWhereAThresholdFails) {
  writeStudy("\n[[threshold]]\nmax = 0.0001\n");
  const Outcome outcome = update();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(filesBelow("ref").empty());
  EXPECT_THAT(outcome.out, HasSubstr("left as it is"));
}

}  // namespace
}  // namespace gnomon::test
