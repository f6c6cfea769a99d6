#include "report/text/html.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace gnomon::report {
namespace {

// Text that nobody escaped is no HTML: to put it into a page does not compile.
static_assert(!std::is_constructible_v<Html, std::string>);
static_assert(!std::is_constructible_v<Html, const char*>);
static_assert(!std::is_convertible_v<std::string, HtmlLiteral>);
static_assert(!std::is_assignable_v<Html&, std::string>);

TEST(EscapeHtml, LeavesUtf8AndShowsWhereElseWas) {
  EXPECT_EQ(escapeHtml("30° ≥ κ").text(), "30° ≥ κ");
  EXPECT_EQ(escapeHtml(std::string("a\0b\x1b\tc\n", 7)).text(), "a\uFFFDb\uFFFD\tc\n");
  EXPECT_EQ(escapeHtml("\xff|\xc3(|\u202e|\xc2\x85").text(), "\uFFFD|\uFFFD(|\uFFFD|\uFFFD");
  EXPECT_EQ(escapeHtml("<a href='x' title=\"y\">&").text(),
            "&lt;a href=&#39;x&#39; title=&quot;y&quot;&gt;&amp;");
}

TEST(Html, EscapesTextOfAPatternAndLeavesHtmlAsItIs) {
  const std::string name = "<b> & \"c\"";
  const Html inner = html("<i>{}</i>", name);
  EXPECT_EQ(inner.text(), "<i>&lt;b&gt; &amp; &quot;c&quot;</i>");
  EXPECT_EQ(html("<p title=\"{1}\">{0}</p>", inner, name).text(),
            "<p title=\"&lt;b&gt; &amp; &quot;c&quot;\">" + inner.text() + "</p>");
  EXPECT_EQ(html("{:.2f} {}", 1.005, 7U).text(), "1.00 7");
  EXPECT_EQ((inner + html("{{}}")).text(), inner.text() + "{}");
  EXPECT_EQ(htmlLiteral("<a>{}").text(), "<a>{}");
  EXPECT_TRUE(Html().empty());
}

TEST(Html, APicturesAddressIsItsBytes) {
  EXPECT_EQ(pictureAddress("image/png", "<&>").text(), "data:image/png;base64,PCY+");
}

}  // namespace
}  // namespace gnomon::report
