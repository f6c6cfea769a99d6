#include <gtest/gtest.h>

#include "cache/cache.h"
#include "study/run/truth_study.h"
#include "study/spec/study_file_fixture.h"

namespace gnomon::study {
namespace {

class SharedTables : public StudyFile {};

/// Processors share horizons, whose bits are the same on all instruction sets, as
/// horizon_targets_test shows.
TEST_F(SharedTables, AreBakedOnceForAllProcessors) {
  const StudySpec study = readWith({"bake.azimuths=8"});
  const cache::ContentKey program = cache::keyOfBytes("a program");
  const auto countsOn = [&](const char* processor) {
    cache::Cache cache(file("kept"), 100'000'000, {program, cache::keyOfBytes(processor)}, {});
    (void)bakeStudyTables(study, cache, {});
    return cache.counts();
  };
  EXPECT_EQ(countsOn("with AVX-512").misses, 1U);
  const cache::CacheCounts other = countsOn("without");
  EXPECT_EQ(other.hits, 1U);
  EXPECT_EQ(other.misses, 0U);
}

}  // namespace
}  // namespace gnomon::study
