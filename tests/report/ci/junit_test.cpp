#include "report/ci/junit.h"

#include <gmock/gmock.h>

#include <pugixml.hpp>
#include <set>

#include "report/sample_check.h"

namespace gnomon::report {
namespace {

using test::passedCheck;
using test::sampleCheck;
using ::testing::HasSubstr;

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

}  // namespace
}  // namespace gnomon::report
