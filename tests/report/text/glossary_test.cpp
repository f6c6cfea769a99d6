#include "report/text/glossary.h"

#include <gmock/gmock.h>

#include <set>
#include <string>

#include "common/error.h"
#include "report/tables/cost_table.h"
#include "report/text/terms_html.h"
#include "truth/region.h"

namespace gnomon::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Glossary, ExplainsEachTermOnceInASentenceOrTwo) {
  std::set<std::string_view> names;
  for (const Term& term : glossary()) {
    EXPECT_TRUE(names.insert(term.name).second) << term.name;
    EXPECT_TRUE(term.meaning.ends_with('.')) << term.name;
    EXPECT_LT(term.meaning.size(), 280U) << term.name;
    EXPECT_EQ(glossary()[findTerm(term.name).value()].name, term.name);
  }
}

TEST(Glossary, HasEveryRegionAndTheReferenceOfCosts) {
  for (const std::string& region : truth::allRegions({})) EXPECT_TRUE(findTerm(region)) << region;
  EXPECT_TRUE(findTerm("all"));
  EXPECT_TRUE(findTerm("To " + std::string(costReference)));
  EXPECT_EQ(findTerm("≈"), findTerm("not distinguishable"));
  EXPECT_FALSE(findTerm("no such word"));
}

TEST(TermsHtml, ListsTheWordsThatAPageUsesAndNoOther) {
  const Html page = htmlTerm("IoU") + htmlHeading("Method") + htmlTerm("truth", "the <right> one");
  EXPECT_THAT(page.text(), HasSubstr(">the &lt;right&gt; one</button>"));
  EXPECT_THAT(page.text(), HasSubstr("</button>Method<button"));
  const std::string list = htmlGlossary(page).text();
  EXPECT_THAT(list, HasSubstr("<dt>IoU</dt>"));
  EXPECT_THAT(list, HasSubstr("<dt>truth</dt>"));
  EXPECT_THAT(list, Not(HasSubstr("<dt>BER</dt>")));
  EXPECT_TRUE(htmlGlossary(htmlHeading("Method")).empty());
  EXPECT_THROW(htmlTerm("no such word"), InternalError);
}

}  // namespace
}  // namespace gnomon::report
