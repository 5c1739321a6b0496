// What control groups leave, of files as the kernel has them in versions 1 and 2, nested.
#include "engine/machine_memory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <limits>

namespace pulvis {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

class ControlGroups : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(root); }
  void TearDown() override { fs::remove_all(root); }

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((root / name).parent_path());
    std::ofstream(root / name) << text << '\n';
  }
  std::uint64_t left(const std::string& table) const {
    write("table", table);
    return left_by_control_groups(root / "table", root);
  }

  fs::path root = fs::temp_directory_path() / ("pulvis-groups-" + std::to_string(getpid()));
};

TEST_F(ControlGroups, OfVersion1AreSeen) {
  write("memory/job/memory.limit_in_bytes", "5000");
  write("memory/job/memory.usage_in_bytes", "1500");
  EXPECT_EQ(left("9:name=systemd:/\n4:cpu,memory:/job\n0::/"), 3500U);
}

// Those above it bind, too.
TEST_F(ControlGroups, TheTightestOfNestedOnesBinds) {
  write("a/b/memory.max", "9000");
  write("a/b/memory.current", "1000");
  write("a/memory.max", "6000");
  write("a/memory.current", "2000");
  write("memory.max", "max");
  EXPECT_EQ(left("0::/a/b"), 4000U);
  write("a/memory.max", "max");
  EXPECT_EQ(left("0::/a/b"), 8000U);
}

// In a container the table has the machine's path, and the mount shows the container's own group only.
TEST_F(ControlGroups, TheMountsOwnFolderCounts) {
  write("memory/memory.limit_in_bytes", "700");
  write("memory/memory.usage_in_bytes", "900");
  EXPECT_EQ(left("4:memory:/docker/0123"), 0U);
}

TEST_F(ControlGroups, PagesThatCanBeDroppedAreNotUsed) {
  write("memory.max", "5000");
  write("memory.current", "4000");
  write("memory.stat", "anon 100\ninactive_file 3000\nactive_file 7");
  EXPECT_EQ(left("0::/"), 4000U);
}

TEST_F(ControlGroups, NoneLeaveEverything) {
  EXPECT_EQ(left("3:cpuset:/x\n"), unlimited);
  EXPECT_EQ(left_by_control_groups(root / "none", root), unlimited);
}

}  // namespace
}  // namespace pulvis
