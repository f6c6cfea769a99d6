#include <gmock/gmock.h>
#include <pugixml.hpp>

#include <set>
#include <sstream>

#include "common/error.h"
#include "image/images.h"
#include "report/build_server.h"
#include "report/sample_check.h"
#include "report/terminal_page.h"
#include "report/terminal_report.h"
#include "support/lines.h"
#include "support/temporary_folder.h"

namespace gnomon::report {
namespace {

using test::passedCheck;
using test::sampleCheck;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> annotations(const std::vector<study::CheckRecord>& checks) {
  return test::linesOf(githubAnnotations(checks));
}

TEST(GithubAnnotations, AreNoneForWhatPassed) {
  EXPECT_TRUE(annotations({passedCheck()}).empty());
  EXPECT_TRUE(annotations({}).empty());
}

TEST(GithubAnnotations, AreALineForEachFaultThenTheNotices) {
  const std::vector<std::string> lines = annotations({sampleCheck(), passedCheck()});
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines.at(0),
            "::error file=scenes/sample.toml,line=7,title=sample%3A not judged::"
            "scenes/sample.toml:7: 100 %25%0Awrong%0A"
            "gnomon check scenes/sample.toml --method 'a, \"b\" & <c>'");
  EXPECT_EQ(lines.at(1),
            "::error file=scenes/sample.toml,line=12,title=sample%3A threshold failed::"
            "a, \"b\" & <c>, error_rate ≤ 0.0300, camera, elevation 30° azimuth 20°: 0.0512, too "
            "large by 0.0212%0Agnomon check scenes/sample.toml --method 'a, \"b\" & <c>'");
  EXPECT_THAT(lines.at(2), StartsWith("::error file=scenes/sample.toml,line=12,title=sample%3A "
                                      "threshold undefined::"));
  EXPECT_THAT(lines.at(3), StartsWith("::error file=reference/sample.json,title=sample%3A "
                                      "reference failed::"));
  EXPECT_EQ(lines.at(4),
            "::notice file=scenes/sample.toml,line=30,title=sample%3A notice::the limit on x could "
            "be tightened");
}

/// What a change has to mend is the user's shader; the message still says which limit it broke.
TEST(GithubAnnotations, MarkTheUsersOwnShader) {
  study::CheckRecord check = sampleCheck();
  check.shaders["a"] = "shaders/mine.glsl";
  check.problems.front().message = "shaders/mine.glsl:14: error: no function";
  const std::vector<std::string> lines = annotations({check});
  EXPECT_THAT(lines.at(0), StartsWith("::error file=shaders/mine.glsl,line=14,title="));
  check.problems.front().message = "scenes/sample.toml: shaders/mine.glsl:15: error: no function";
  EXPECT_THAT(annotations({check}).at(0), StartsWith("::error file=shaders/mine.glsl,line=15,"));
  EXPECT_THAT(lines.at(1), StartsWith("::error file=scenes/sample.toml,line=12,title="))
      << "of another method";
  EXPECT_THAT(lines.at(2), StartsWith("::error file=shaders/mine.glsl,title=sample%3A threshold"));
  EXPECT_THAT(lines.at(3), StartsWith("::error file=shaders/mine.glsl,title=sample%3A reference"));
}

TEST(GithubAnnotations, EscapeWhatWouldEndAPropertyOrALine) {
  study::CheckRecord check = sampleCheck();
  check.file = "a,b:c%d\r\n.toml";
  check.problems.front().message = "x:y,z\r\n::error::%0A";
  const std::vector<std::string> lines = annotations({check});
  EXPECT_THAT(lines.at(0), StartsWith("::error file=a%2Cb%3Ac%25d%0D%0A.toml,title=sample%3A not "
                                      "judged::x:y,z%0D%0A::error::%250A%0A"));
  for (const std::string& line : lines) {
    EXPECT_TRUE(line.starts_with("::error ") || line.starts_with("::notice ")) << line;
  }
}

TEST(GithubAnnotations, TakeALineOnlyFromTheStudysOwnFile) {
  study::CheckRecord check = sampleCheck();
  for (const char* message : {"other.toml:7: x", "scenes/sample.toml: x", "scenes/sample.toml:7",
                              "scenes/sample.toml:7a: x", "scenes/sample.toml:-3: x"}) {
    check.problems.front().message = message;
    EXPECT_THAT(annotations({check}).at(0), StartsWith("::error file=scenes/sample.toml,title="))
        << message;
  }
}

TEST(GithubAnnotations, HoldUtf8Alone) {
  study::CheckRecord check = sampleCheck();
  check.name = "a\x1b[2J\xff\u202e";
  EXPECT_THAT(annotations({check}).at(0),
              ::testing::HasSubstr("title=a\uFFFD[2J\uFFFD\uFFFD%3A not judged::"));
}

TEST(WithoutWorkflowCommands, BreaksTheSignsThatTheRunnerLooksFor) {
  EXPECT_EQ(withoutWorkflowCommands("::error::x\n  ::set-env name=A::b\na::b\n"),
            ": :error::x\n  : :set-env name=A::b\na::b\n");
  EXPECT_EQ(withoutWorkflowCommands("row ##[error]x ###[group] ##\n##["),
            "row ## [error]x ### [group] ##\n## [");
  EXPECT_EQ(withoutWorkflowCommands(":::"), ": ::");
  EXPECT_EQ(withoutWorkflowCommands(""), "");
}

TEST(WithoutWorkflowCommands, LeavesAllElse) {
  const std::string text = "a: b\n# [x] ## ##a[\n : ok\nκ::κ\n";
  EXPECT_EQ(withoutWorkflowCommands(text), text);
}

/// The document, parsed strictly; a failed expectation where it is no XML.
pugi::xml_document parsed(const std::vector<study::CheckRecord>& checks) {
  const std::string text = junitXml(checks);
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), pugi::parse_full, pugi::encoding_utf8);
  EXPECT_TRUE(result) << result.description() << "\n" << text;
  return document;
}

std::size_t countOf(const pugi::xml_node& node, const char* path) {
  return node.select_nodes(path).size();
}

/// The attributes of counts are those of the elements below.
void expectCounts(const pugi::xml_node& node) {
  EXPECT_EQ(node.attribute("tests").as_uint(999), countOf(node, ".//testcase"));
  EXPECT_EQ(node.attribute("failures").as_uint(999), countOf(node, ".//testcase/failure"));
  EXPECT_EQ(node.attribute("errors").as_uint(999), countOf(node, ".//testcase/error"));
  EXPECT_EQ(node.attribute("skipped").as_uint(999), countOf(node, ".//testcase/skipped"));
}

/// What readers of JUnit XML rely on: which elements may stand where, and with which attributes.
void expectSchema(const pugi::xml_node& root) {
  EXPECT_STREQ(root.name(), "testsuites");
  expectCounts(root);
  for (const pugi::xml_node suite : root) {
    ASSERT_STREQ(suite.name(), "testsuite");
    EXPECT_STRNE(suite.attribute("name").value(), "");
    EXPECT_GE(suite.attribute("time").as_double(-1), 0);
    expectCounts(suite);
    std::set<std::string> names;
    for (const pugi::xml_node part : suite) {
      if (std::string(part.name()) == "properties") {
        EXPECT_EQ(part, suite.first_child());
        continue;
      }
      ASSERT_STREQ(part.name(), "testcase");
      EXPECT_STRNE(part.attribute("classname").value(), "");
      EXPECT_STRNE(part.attribute("name").value(), "");
      EXPECT_LE(std::distance(part.begin(), part.end()), 1) << "one outcome";
      for (const pugi::xml_node outcome : part) {
        const std::string kind = outcome.name();
        EXPECT_TRUE(kind == "failure" || kind == "error" || kind == "skipped") << kind;
        EXPECT_STRNE(outcome.attribute("message").value(), "");
        EXPECT_TRUE(kind == "skipped" || outcome.attribute("type"));
      }
    }
  }
}

TEST(JunitXml, IsWhatReadersExpect) {
  const pugi::xml_document document = parsed({sampleCheck(), passedCheck()});
  expectSchema(document.document_element());
  EXPECT_EQ(countOf(document, "//testsuite"), 2U);
  EXPECT_STREQ(document.first_child().attribute("encoding").value(), "UTF-8");
  expectSchema(parsed({}).document_element());
}

TEST(JunitXml, KeepsFailureErrorAndSkippedApart) {
  const pugi::xml_document document = parsed({sampleCheck(), passedCheck()});
  const pugi::xml_node suite = document.select_node("//testsuite[@name='sample']").node();
  EXPECT_EQ(suite.attribute("tests").as_int(), 6);
  EXPECT_EQ(suite.attribute("failures").as_int(), 2);
  EXPECT_EQ(suite.attribute("errors").as_int(), 2) << "the problem and the undefined value";
  EXPECT_EQ(suite.attribute("skipped").as_int(), 1);
  EXPECT_STREQ(suite.attribute("file").value(), "scenes/sample.toml");
  EXPECT_DOUBLE_EQ(document.document_element().attribute("time").as_double(), 1.75);
  const pugi::xml_node good = document.select_node("//testsuite[@name='good']").node();
  EXPECT_EQ(good.attribute("tests").as_int(), 1);
  EXPECT_EQ(good.attribute("failures").as_int() + good.attribute("errors").as_int(), 0);
}

TEST(JunitXml, SaysWhereWhatAndHowToReproduce) {
  const pugi::xml_document document = parsed({sampleCheck()});
  const pugi::xml_node failure =
      document.select_node("//testcase[@classname='sample.threshold']/failure").node();
  EXPECT_STREQ(failure.attribute("message").value(),
               "scenes/sample.toml:12: a, \"b\" & <c>, error_rate ≤ 0.0300, camera, elevation 30° "
               "azimuth 20°: 0.0512, too large by 0.0212");
  EXPECT_THAT(failure.child_value(),
              HasSubstr("\nReproduce: gnomon check scenes/sample.toml --method 'a, \"b\" & <c>'"));
  const pugi::xml_node reference =
      document.select_node("//testcase[@classname='sample.reference']/failure").node();
  EXPECT_THAT(reference.attribute("message").value(), HasSubstr("reference/sample.json: a, "));
  EXPECT_THAT(reference.attribute("message").value(),
              HasSubstr("0.0900, too large by 0.0100, 0.0700 "
                        "committed"));
  const pugi::xml_node problem = document.select_node("//testcase[@name='baseline']/error").node();
  EXPECT_STREQ(problem.attribute("type").value(), "bad input");
  EXPECT_STREQ(problem.attribute("message").value(), "scenes/sample.toml:7: 100 %\nwrong");
}

TEST(JunitXml, ACasesNameOutlivesItsLimit) {
  study::CheckRecord check = passedCheck();
  const auto nameOf = [&] {
    return std::string(parsed({check}).select_node("//testcase/@name").attribute().value());
  };
  const std::string before = nameOf();
  EXPECT_EQ(before, "a, error_rate max, camera, elevation 30° azimuth 20°");
  check.judgements.front().gate.maximum = 0.5;
  EXPECT_EQ(nameOf(), before);
}

TEST(JunitXml, HoldsWhateverBytesNamesHave) {
  study::CheckRecord check = sampleCheck();
  check.name =
      "a\x01"
      "b\x1b[31m\xff\xc3\x28"
      "]]>&\"'<\t\xef\xbf\xbf\xed\xa0\x80é漢😀";
  check.problems.front().message = check.name;
  const pugi::xml_document document = parsed({check});
  const std::string clean =
      "a\uFFFD"
      "b\uFFFD[31m\uFFFD\uFFFD(]]>&\"'<\t\uFFFD\uFFFD\uFFFD\uFFFDé漢😀";
  EXPECT_EQ(document.select_node("//testsuite/@name").attribute().value(), clean);
  EXPECT_THAT(document.select_node("//error").node().child_value(), HasSubstr(clean));
  expectSchema(document.document_element());
}

// Six digits of one figure beside two of the other tell nobody by how much a limit is missed.
TEST(CheckTable, TellsAFaultInEvenFigures) {
  study::CheckRecord check = sampleCheck();
  check.judgements = {test::sampleJudgement(study::GateVerdict::failed, 0.123456789, 0.12345)};
  const std::string text = checkTable(check, false);
  EXPECT_THAT(text, HasSubstr("≤ 0.12345000, camera"));
  EXPECT_THAT(text, HasSubstr("0.12345679, too large by\n    0.00000679"));
}

TEST(CheckTable, HasNoCommandForWhatPassed) {
  EXPECT_THAT(checkTable(passedCheck(), false), Not(HasSubstr("Reproduce")));
}

TEST(CheckTable, FitsATerminalWhateverTheNames) {
  study::CheckRecord check = sampleCheck();
  for (study::Judgement& judgement : check.judgements) {
    study::Gate& gate = judgement.gate;
    gate.method = std::string(60, 'm');
    gate.light = std::string(90, 'l');
    gate.metric = "shadow_length_ratio";
    gate.minimum = 0.123456;
    gate.maximum = 1.23456;
    gate.region = "beyond-terminator";
    gate.step = "sample/0.0025";
  }
  const std::string text = checkTable(check, false);
  for (const std::string& line : test::linesOf(text)) {
    if (line.find("gnomon check") != std::string::npos) continue;  // to be copied, so never broken
    EXPECT_LE(displayWidth(line), 100U) << line;
  }
  EXPECT_THAT(text, HasSubstr("0.1235 to\n    1.2346"));
}

TEST(CheckTable, FitsATerminalWhateverTheLimit) {
  study::CheckRecord check = sampleCheck();
  check.judgements.at(0).gate.maximum = 1e308;
  const std::string text = checkTable(check, false);
  EXPECT_THAT(text, HasSubstr("≤ 1e+308  +1.000e+308  pass"));
  for (const std::string& line : test::linesOf(text)) EXPECT_LE(displayWidth(line), 100U);
}

TEST(CheckTable, HasColoursOnlyWhereTheyAreWanted) {
  EXPECT_THAT(checkTable(sampleCheck(), true), HasSubstr("\x1b[31mfailed\x1b[0m"));
  EXPECT_THAT(checkTable(sampleCheck(), false), Not(HasSubstr("\x1b")));
}

TEST(CheckSummary, CountsAndNamesWhatDidNotPass) {
  const std::vector<study::CheckRecord> checks = {passedCheck(), sampleCheck()};
  const std::string text = checkSummary(checks, ExitStatus::badInput, false);
  EXPECT_THAT(text, HasSubstr("Check of 2 studies: 2 of 6 gates passed, 2 failed, 1 undefined, 1 "
                              "skipped, 1 error."));
  EXPECT_THAT(text, HasSubstr("status 3."));
  EXPECT_THAT(text, HasSubstr("Not passed: sample\n"));
  const std::vector<study::CheckRecord> good = {passedCheck()};
  EXPECT_THAT(checkSummary(good, ExitStatus::pass, false), Not(HasSubstr("Not passed")));
}

class JobSummary : public TemporaryFolder {
 protected:
  /// The signed difference of two masks, written as a run does. `#` shadowed, `.` lit, ` ` none.
  std::filesystem::path difference(const std::string& name, int width, const std::string& candidate,
                                   const std::string& truth) const {
    const auto mask = [&](const std::string& signs) {
      Mask result{width, static_cast<int>(signs.size()) / width, {}};
      for (const char sign : signs) {
        result.samples.push_back(sign == '#'   ? Shade::shadowed
                                 : sign == '.' ? Shade::lit
                                               : Shade::none);
      }
      return result;
    };
    std::filesystem::path file = folder() / name;
    image::writePng(file, image::differenceImage(mask(candidate), mask(truth)));
    return file;
  }
};

TEST_F(JobSummary, MosaicShowsEachKind) {
  EXPECT_EQ(mosaicOf(difference("a.png", 5, "#.#. ", "..## "), 5), "🟧⬜⬛🟦🟫\n");
}

/// Blocks of 4 × 4: one wrong pixel of 16 is less than an eighth, two are not.
TEST_F(JobSummary, MosaicShowsAnErrorOfAnEighth) {
  const std::string lit(32, '.');
  std::string one = lit;
  one[0] = '#';
  EXPECT_EQ(mosaicOf(difference("one.png", 8, one, lit), 2), "⬜⬜\n");
  std::string two = one;
  two[1] = '#';
  EXPECT_EQ(mosaicOf(difference("two.png", 8, two, lit), 2), "🟧⬜\n");
  EXPECT_EQ(mosaicOf(difference("all.png", 8, two, lit), 99).size(),
            mosaicOf(difference("all.png", 8, two, lit), 8).size());
}

TEST_F(JobSummary, MosaicRefusesAnotherPicture) {
  image::writePng(folder() / "grey.png", image::maskImage({1, 1, {Shade::none}}));
  EXPECT_THROW(mosaicOf(folder() / "grey.png", 1), InputError);
}

TEST_F(JobSummary, NamesEveryFaultAndTheCommandThatAccepts) {
  study::CheckRecord check = sampleCheck();
  check.shaders["a"] = "my|shader.glsl";
  const std::vector<study::CheckRecord> checks = {check};
  const std::string text = jobSummary(checks, {}, "gnomon check --update-baseline");
  EXPECT_THAT(text, HasSubstr("## Shadows: fail\n\n1 limits hold, 3 do not."));
  EXPECT_THAT(text, HasSubstr("| sample | a | error\\_rate | camera, elevation 30° azimuth 20° | "
                              "0.0900 | 0.0700 | ≤ 0.0800 | my\\|shader.glsl |\n"));
  EXPECT_THAT(text, HasSubstr("| a, &quot;b&quot; &amp; &lt;c&gt; |"));
  EXPECT_THAT(text, HasSubstr("- sample: scenes/sample.toml:7: 100 % wrong\n"));
  EXPECT_THAT(text, HasSubstr("```\ngnomon check --update-baseline\n```\n"));
}

/// Two rows fail: the worse share is shown, although a length fails by more.
TEST_F(JobSummary, ShowsThePicturesOfTheWorstCase) {
  study::StudyRecord record;
  record.name = ".";
  for (const char* light : {"noon", "evening", "dusk"}) {
    study::Judgement judgement = sampleCheck().judgements.back();
    judgement.gate.light = light;
    judgement.value = std::string(light) == "evening" ? 0.3 : 0.1;
    if (std::string(light) == "dusk") {
      judgement.gate.metric = "shadow_length_ratio";
      judgement.value = 5.0;
    }
    record.judgements.push_back(judgement);
    record.referencePictures.push_back(
        {"a", "camera", light, "before.png", "after.png", "change.png", ""});
  }
  difference("before.png", 2, "..", "..");
  difference("after.png", 2, "#.", "..");
  difference("change.png", 2, "#.", "..");
  const std::vector<study::StudyRecord> records = {record};
  const std::optional<WorstCase> worst = worstCase(records, folder());
  ASSERT_TRUE(worst.has_value());
  EXPECT_EQ(worst->light, "evening");
  EXPECT_DOUBLE_EQ(worst->margin, 0.08 - 0.3);
  const std::vector<study::CheckRecord> checks = {sampleCheck()};
  const std::string text = jobSummary(checks, worst, "");
  EXPECT_THAT(text, HasSubstr("**Before**"));
  EXPECT_THAT(text, HasSubstr("```\n⬜⬜\n```"));
  EXPECT_THAT(text, HasSubstr("**Change**"));
  EXPECT_THAT(text, HasSubstr("```\n🟧⬜\n```"));
  EXPECT_FALSE(worstCase({}, folder()).has_value());
}

}  // namespace
}  // namespace gnomon::report
