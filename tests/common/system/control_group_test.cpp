#include "common/system/control_group.h"

#include <fstream>
#include <limits>
#include <map>

#include "support/temporary_folder.h"

namespace gnomon {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();
/// What the older hierarchy writes where there is no limit.
constexpr const char* legacyUnlimited = "9223372036854771712";

/// Hierarchies in a folder, as they are below /sys/fs/cgroup.
class ControlGroup : public TemporaryFolder {
 protected:
  void put(const std::string& group, const std::map<std::string, std::string>& files) const {
    std::filesystem::create_directories(file(group));
    for (const auto& [name, text] : files) std::ofstream(file(group) / name) << text << "\n";
  }
  [[nodiscard]] std::uint64_t available(const std::string& membership) const {
    return controlGroupAvailableBytes(folder(), membership);
  }
};

TEST_F(ControlGroup, WithoutALimitLeavesEverything) {
  EXPECT_EQ(available(""), unlimited);
  EXPECT_EQ(available("0::/\n"), unlimited);
  EXPECT_EQ(available("no line of this kind\n4:memory\n"), unlimited);
  put("", {{"memory.max", "max"}, {"memory.high", "max"}, {"memory.current", "100"}});
  EXPECT_EQ(available("0::/\n"), unlimited);
}

TEST_F(ControlGroup, LeavesTheLimitLessWhatIsHeld) {
  put("", {{"memory.max", "1000"},
           {"memory.current", "600"},
           {"memory.stat", "anon 200\nfile 400\ninactive_file 150\nactive_file 250"}});
  // Inactive file pages count as used, but are given up first.
  EXPECT_EQ(available("0::/\n"), 1000U - (600U - 150U));
}

TEST_F(ControlGroup, LeavesNothingWhereMoreIsHeldThanTheLimit) {
  put("", {{"memory.max", "1000"}, {"memory.current", "1200"}});
  EXPECT_EQ(available("0::/\n"), 0U);
}

TEST_F(ControlGroup, TheLeastOfAllGroupsAboveCounts) {
  put("a/b/c", {{"memory.max", "5000"}, {"memory.current", "10"}});
  EXPECT_EQ(available("0::/a/b/c\n"), 4990U);
  // A group of siblings, whose own use is larger.
  put("a", {{"memory.max", "9000"}, {"memory.current", "8500"}});
  EXPECT_EQ(available("0::/a/b/c\n"), 500U);
  put("a/b", {{"memory.max", "max"}, {"memory.high", "300"}, {"memory.current", "20"}});
  EXPECT_EQ(available("0::/a/b/c\n"), 280U);
  // Beside the way up, it is not ours.
  put("a/d", {{"memory.max", "1"}, {"memory.current", "0"}});
  EXPECT_EQ(available("0::/a/b/c\n"), 280U);
}

TEST_F(ControlGroup, TheLowerOfTheTwoLimitsCounts) {
  put("", {{"memory.max", "400"}, {"memory.high", "700"}, {"memory.current", "100"}});
  EXPECT_EQ(available("0::/\n"), 300U);
  put("", {{"memory.max", "700"}, {"memory.high", "400"}});
  EXPECT_EQ(available("0::/\n"), 300U);
}

TEST_F(ControlGroup, OfTheOlderHierarchyIsSeen) {
  put("memory/docker/one", {{"memory.limit_in_bytes", "2000"},
                            {"memory.usage_in_bytes", "900"},
                            {"memory.stat", "inactive_file 1\ntotal_inactive_file 100"}});
  put("memory", {{"memory.limit_in_bytes", legacyUnlimited}, {"memory.usage_in_bytes", "950"}});
  const std::string membership = "5:devices:/docker/one\n4:memory:/docker/one\n0::/\n";
  EXPECT_EQ(available(membership), 2000U - 800U);
  EXPECT_EQ(available("3:cpu,memory:/docker/one\n"), 1200U);
  EXPECT_EQ(available("3:memory2:/docker/one\n"), unlimited);
}

TEST_F(ControlGroup, OfTheOlderHierarchyTellsOfLimitsAboveIt) {
  put("memory", {{"memory.limit_in_bytes", legacyUnlimited},
                 {"memory.usage_in_bytes", "100"},
                 {"memory.stat", "hierarchical_memory_limit 750"}});
  EXPECT_EQ(available("4:memory:/\n"), 650U);
}

// In a container the hierarchy that is mounted is the container's own, but the membership may be
// the host's.
TEST_F(ControlGroup, OfAContainerIsTheRootThatIsMounted) {
  put("memory", {{"memory.limit_in_bytes", "1000"}, {"memory.usage_in_bytes", "0"}});
  EXPECT_EQ(available("4:memory:/docker/0123456789ab\n"), 1000U);
  put("", {{"memory.max", "800"}, {"memory.current", "0"}});
  EXPECT_EQ(available("0::/../elsewhere\n"), 800U);
}

TEST_F(ControlGroup, MayBeOfTwoHierarchies) {
  put("memory/one", {{"memory.limit_in_bytes", "1000"}, {"memory.usage_in_bytes", "0"}});
  put("unified/two", {{"memory.max", "600"}, {"memory.current", "0"}});
  EXPECT_EQ(available("4:memory:/one\n0::/two\n"), 600U);
}

TEST_F(ControlGroup, OfAFileThatIsNoneIsPassedOver) {
  put("", {{"memory.max", "word"}, {"memory.current", "10"}});
  EXPECT_EQ(available("0::/\n"), unlimited);
  put("", {{"memory.max", "100"}, {"memory.current", ""}});
  EXPECT_EQ(available("0::/\n"), unlimited);
}

}  // namespace
}  // namespace gnomon
