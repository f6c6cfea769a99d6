#include <gtest/gtest.h>

#include "cache/cache.h"
#include "study/run/truth_study.h"
#include "study/spec/study_file_fixture.h"

namespace gnomon::study {
namespace {

class SharedTables : public StudyFile {
 protected:
  /// What a bake finds in the cache on a processor.
  cache::CacheCounts countsOf(const StudySpec& study, const char* processor) {
    const cache::ContentKey program = cache::keyOfBytes("a program");
    cache::Cache cache(file("kept"), 100'000'000, {program, cache::keyOfBytes(processor)}, {});
    (void)bakeStudyTables(study, cache, {});
    return cache.counts();
  }
};

/// Processors share horizons, whose bits are the same on all instruction sets, as
/// horizon_targets_test shows.
TEST_F(SharedTables, AreBakedOnceForAllProcessors) {
  const StudySpec study = readWith({"relief.texels=[256, 256]", "bake.azimuths=32"});
  EXPECT_EQ(countsOf(study, "with AVX-512").misses, 1U);
  const cache::CacheCounts other = countsOf(study, "without");
  EXPECT_EQ(other.hits, 1U);
  EXPECT_EQ(other.misses, 0U);
}

TEST_F(SharedTables, AreNotKeptWhereABakeIsAsFast) {
  const StudySpec study = readWith({"bake.azimuths=8"});
  for (int run = 0; run < 2; ++run) {
    const cache::CacheCounts counts = countsOf(study, "with AVX-512");
    EXPECT_EQ(counts.hits + counts.misses, 0U);
  }
}

}  // namespace
}  // namespace gnomon::study
