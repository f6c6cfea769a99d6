#include "study/spec/with_keys.h"

#include <gtest/gtest.h>

#include "support/error_messages.h"

namespace gnomon::study {
namespace {

TEST(WithKeys, ReturnsWhatTheWorkReturns) {
  EXPECT_EQ(withKeys("truth", [] { return 7; }), 7);
}

TEST(WithKeys, PutsTheKeyInThePlaceOfTheParameter) {
  EXPECT_EQ(messageOf<InputError>([] {
              withKeys("truth", []() -> int { throw InputError("0 texels found", "step"); });
            }),
            "truth.step: 0 texels found");
  EXPECT_EQ(messageOf<MemoryError>([] {
              withKeys("bake", []() -> int { throw MemoryError("too many", "azimuths"); });
            }),
            "bake.azimuths: too many");
}

TEST(WithKeys, LeavesErrorsAloneThatNameNoParameter) {
  EXPECT_EQ(messageOf<InputError>(
                [] { withKeys("truth", []() -> int { throw InputError("cage: no faces"); }); }),
            "cage: no faces");
  EXPECT_THROW(withKeys("truth", []() -> int { throw InternalError("a fault"); }), InternalError);
}

}  // namespace
}  // namespace gnomon::study
