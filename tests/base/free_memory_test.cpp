#include "base/free_memory.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

namespace vcarve::free_memory_test {
namespace {

/// A machine with 8 MB of free memory and no control groups.
class FreeMemory : public ::testing::Test {
  protected:
    FreeMemory()
    {
        root.write("proc/meminfo",
                   "MemTotal:  16000 kB\nMemFree:  100 kB\nMemAvailable:  8000 kB\n");
    }

    /// Creates a group of cgroup version 1.
    void write_v1(const std::string& group, const std::string& limit, const std::string& used)
    {
        const std::string folder = "sys/fs/cgroup/memory/" + group;
        root.write(folder + "memory.limit_in_bytes", limit + "\n");
        root.write(folder + "memory.usage_in_bytes", used + "\n");
    }
    void write_v2(const std::string& group, const std::string& limit, const std::string& used)
    {
        root.write("sys/fs/cgroup/" + group + "memory.max", limit + "\n");
        root.write("sys/fs/cgroup/" + group + "memory.current", used + "\n");
    }

    TemporaryFolder root;
};

TEST_F(FreeMemory, IsThatOfTheMachineWithoutGroups)
{
    EXPECT_EQ(free_memory(root.path()), 8000 * 1024);
    EXPECT_FALSE(cgroup_memory(root.path()));
}

TEST_F(FreeMemory, IsUnknownWithoutSystemFiles)
{
    const TemporaryFolder nothing;
    EXPECT_FALSE(free_memory(nothing.path()));
}

TEST_F(FreeMemory, IsThatOfTheGroupIfItIsLess)
{
    root.write("proc/self/cgroup", "5:devices:/\n4:memory:/a/b\n0::/\n");
    write_v1("a/b/", "1000", "300");
    EXPECT_EQ(free_memory(root.path()), 700);
    write_v1("a/b/", "9000000", "300");
    EXPECT_EQ(free_memory(root.path()), 8000 * 1024);
}

TEST_F(FreeMemory, IncludesReclaimableCache)
{
    root.write("proc/self/cgroup", "4:memory:/a\n");
    write_v1("a/", "1000", "900");
    root.write("sys/fs/cgroup/memory/a/memory.stat", "inactive_file 1\ntotal_inactive_file 500\n");
    EXPECT_EQ(free_memory(root.path()), 600);
    root.write("proc/self/cgroup", "0::/a\n");
    write_v2("a/", "2000", "1900");
    root.write("sys/fs/cgroup/a/memory.stat", "anon 1400\ninactive_file 500\n");
    EXPECT_EQ(free_memory(root.path()), 600);
}

TEST_F(FreeMemory, IsLimitedByAncestorsAndTheRootOfAContainer)
{
    root.write("proc/self/cgroup", "0::/a/b\n");
    write_v2("a/b/", "max", "10");
    EXPECT_FALSE(cgroup_memory(root.path()));
    write_v2("a/", "5000", "1000");
    EXPECT_EQ(free_memory(root.path()), 4000);
    write_v2("", "3000", "1000");
    EXPECT_EQ(free_memory(root.path()), 2000);
}

TEST_F(FreeMemory, IgnoresTheNumberThatMeansNoLimit)
{
    root.write("proc/self/cgroup", "4:memory:/\n");
    write_v1("", "9223372036854771712", "300");
    EXPECT_EQ(free_memory(root.path()), 8000 * 1024);
}

TEST_F(FreeMemory, IsZeroIfAGroupExceedsItsLimit)
{
    root.write("proc/self/cgroup", "0::/a\n");
    write_v2("a/", "1000", "1300");
    EXPECT_EQ(free_memory(root.path()), 0);
}

} // namespace
} // namespace vcarve::free_memory_test
