#include "common/error.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(Error, EachKindHasTheStatusThatItsCallersTellItBy) {
  EXPECT_EQ(static_cast<int>(UsageError("").status()), 2);
  EXPECT_EQ(static_cast<int>(InputError("").status()), 3);
  EXPECT_EQ(static_cast<int>(InternalError("").status()), 4);
  EXPECT_EQ(static_cast<int>(MemoryError("").status()), 4);
  EXPECT_EQ(static_cast<int>(NoGlError("").status()), 77);
}

TEST(Error, IsCaughtAsOneBaseWithItsMessage) {
  try {
    throw InputError("scene.toml:3: relief.height: missing");
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "scene.toml:3: relief.height: missing");
    EXPECT_EQ(error.status(), ExitStatus::badInput);
    EXPECT_EQ(error.parameter(), "");
    EXPECT_EQ(error.reason(), error.what());
  }
}

TEST(Error, NamesTheParameterThatIsWrongBeforeTheReason) {
  const InputError error("0 texels found", "step");
  EXPECT_STREQ(error.what(), "step: 0 texels found");
  EXPECT_EQ(error.parameter(), "step");
  EXPECT_EQ(error.reason(), "0 texels found");
}

}  // namespace
}  // namespace gnomon
