#include "study/judge/suite/chosen_settings.h"

#include <gtest/gtest.h>

#include "study/judge/suite/suite_studies.h"

namespace gnomon::study {
namespace {

TEST(SuiteAgreement, OfARankingWithItselfIsOne) {
  const SuiteRanking ranking =
      rankingOf(suiteStatistics("drawn", test::randomStudies(40, {1, 2, 0.5, 4}, 1)));
  EXPECT_EQ(ranking.methods.size(), 4U);
  EXPECT_FALSE(ranking.distinguishable.empty());
  const SuiteAgreement agreement = agreementOf(ranking, ranking);
  EXPECT_EQ(agreement.tau, 1);
  EXPECT_EQ(agreement.pairs, 6U);
  EXPECT_EQ(agreement.swapped, 0U);
  EXPECT_TRUE(agreement.contradictions.empty());
}

TEST(SuiteAgreement, NamesSwapsOfMethodsThatAreDistinguishable) {
  const SuiteRanking first{{{"a", 0.1}, {"b", 0.2}, {"c", 0.3}, {"alone", 0.4}}, {{"a", "b"}}};
  const SuiteRanking second{{{"b", 0.1}, {"a", 0.2}, {"c", 0.15}}, {}};
  const SuiteAgreement agreement = agreementOf(first, second);
  EXPECT_EQ(agreement.methods, 3U);
  // a and b are swapped, and a and c.
  EXPECT_NEAR(*agreement.tau, -1.0 / 3, 1e-12);
  EXPECT_EQ(agreement.swapped, 2U);
  ASSERT_EQ(agreement.contradictions.size(), 1U);
  EXPECT_EQ(agreement.contradictions.front(), std::pair(std::string("a"), std::string("b")));
  EXPECT_EQ(agreementOf(second, first).contradictions.size(), 1U);
}

/// Two disjoint draws of scenes rank methods alike that are far from each other.
TEST(SuiteAgreement, OfDisjointScenesIsHighWhereMethodsDiffer) {
  const std::vector<double> factors = {1, 2, 4, 8, 16};
  const auto draw = [&](std::uint64_t seed) {
    return rankingOf(suiteStatistics("drawn", test::randomStudies(40, factors, seed)));
  };
  EXPECT_EQ(agreementOf(draw(1), draw(2)).tau, 1);
}

TEST(SuiteAgreement, OfOneMethodIsNone) {
  const SuiteRanking one{{{"a", 0.1}}, {}};
  EXPECT_FALSE(agreementOf(one, one).tau);
}

}  // namespace
}  // namespace gnomon::study
