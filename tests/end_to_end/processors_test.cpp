#include <cstdlib>
#include <memory>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

/// Makes the C library choose the mathematical functions of a processor without AVX2 and FMA, whose
/// results differ in the last bit.
constexpr const char* plainProcessor = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4";

class Processors : public EndToEnd {
 protected:
  /// What another program computes with the C library's functions.
  [[nodiscard]] std::string sinesWith(const char* variable) const {
    const std::string sines =
        "BEGIN { for (i = 1; i < 200000; ++i) s += sin(i / 7) * exp(-i / 1e5); printf \"%.17g\", s "
        "}";
    const int process =
        startCommand(folder(), {"awk", sines}, {variable}, file("sines"), "/dev/null");
    EXPECT_EQ(endOf(process), 0);
    return read("sines");
  }
};

/// The one kind of result that processors share (cache.md) is the same with either. The vectors of
/// the search itself are those of tests/horizon/horizon_targets_test.
TEST_F(Processors, BakeTheSameTables) {
  if (sinesWith("NOTHING=1") == sinesWith(plainProcessor)) {
    GTEST_SKIP() << "this machine's C library has one form of its functions";
  }
  const std::string scenes = GNOMON_SCENES;
  for (const char* scene : {"figure8", "dunes", "spot-cells"}) {
    const std::string study = scenes + "/" + scene + ".toml";
    ASSERT_EQ(gnomon({"bake", study, "--out", "usual"}).status, 0);
    ASSERT_EQ(gnomon({"bake", study, "--out", "plain"}, {plainProcessor}).status, 0);
    const std::string tables = std::string("/") + scene + "/tables.exr";
    EXPECT_GT(read("usual" + tables).size(), 1000U);
    EXPECT_TRUE(read("usual" + tables) == read("plain" + tables)) << scene;
  }
}

}  // namespace
}  // namespace gnomon::test
