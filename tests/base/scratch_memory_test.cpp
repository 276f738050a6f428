#include "base/droppable_pages.h"
#include "base/resident_limit.h"
#include "base/scratch_memory.h"
#include "support/mapping_flags.h"
#include "support/temporary_folder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace vcarve::scratch_memory_test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

constexpr std::size_t kLeast = ScratchMemory::kLeastBytes;
constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t kAllPages = std::numeric_limits<std::size_t>::max();

std::span<std::uint64_t> numbers_at(void* memory, std::size_t bytes)
{
    return {static_cast<std::uint64_t*>(memory), bytes / sizeof(std::uint64_t)};
}

/// The number of mappings of files in a folder.
int num_maps_in(const std::filesystem::path& folder)
{
    std::ifstream maps("/proc/self/maps");
    int found = 0;
    for (std::string line; std::getline(maps, line);) {
        if (line.find(folder.string() + "/") != std::string::npos) ++found;
    }
    return found;
}

TEST(ScratchMemory, StoresLargeArraysOnlyWhileItLives)
{
    const TemporaryFolder folder;
    EXPECT_EQ(allocate_scratch(kLeast, 16), nullptr);
    {
        const ScratchMemory scratch(folder.path(), kNoLimit);
        EXPECT_EQ(allocate_scratch(kLeast - 1, 16), nullptr);
        EXPECT_EQ(allocate_scratch(kLeast, 8192), nullptr) << "the alignment exceeds a page";
        void* const memory = allocate_scratch(kLeast, 4096);
        ASSERT_NE(memory, nullptr);
        EXPECT_EQ(num_maps_in(folder.path()), 1);
        EXPECT_TRUE(free_scratch(memory));
        EXPECT_EQ(num_maps_in(folder.path()), 0);
    }
    EXPECT_EQ(allocate_scratch(kLeast, 16), nullptr);
}

TEST(ScratchMemory, IsZeroedAndKeepsWrittenValues)
{
    const TemporaryFolder folder;
    const ScratchMemory scratch(folder.path(), kNoLimit);
    constexpr std::size_t kBytes = kLeast + 12'345;
    void* const memory = allocate_scratch(kBytes, 16);
    const auto numbers = numbers_at(memory, kBytes);
    EXPECT_TRUE(std::ranges::all_of(numbers, [](std::uint64_t number) { return number == 0; }));
    std::ranges::fill(numbers, 42);
    EXPECT_EQ(numbers.back(), 42);
    free_scratch(memory);
}

TEST(ScratchMemory, DoesNotUseHugePages)
{
    if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage")) {
        GTEST_SKIP() << "/sys/kernel/mm/transparent_hugepage is missing: no huge pages, or /sys is "
                        "not mounted";
    }
    const TemporaryFolder folder;
    const ScratchMemory scratch(folder.path(), kNoLimit);
    void* const memory = allocate_scratch(kLeast, 16);
    EXPECT_THAT(mapping_flags(memory), HasSubstr(" nh "));
    free_scratch(memory);
}

TEST(ScratchMemory, DoesNotFreeOtherMemory)
{
    const TemporaryFolder folder;
    const ScratchMemory scratch(folder.path(), kNoLimit);
    void* const ours = allocate_scratch(kLeast, 16);
    EXPECT_FALSE(free_scratch(nullptr));
    void* page = nullptr;
    ASSERT_EQ(posix_memalign(&page, 4096, 4096), 0);
    EXPECT_FALSE(free_scratch(page));
    std::free(page);
    EXPECT_FALSE(free_scratch(static_cast<char*>(ours) + 4096)) << "not the first page";
    EXPECT_TRUE(free_scratch(ours));
    EXPECT_FALSE(free_scratch(ours)) << "already freed";
}

TEST(ScratchMemory, LeavesItsFolderEmptyAndCountsPeakBytes)
{
    const TemporaryFolder folder;
    const ScratchMemory scratch(folder.path(), kNoLimit);
    const std::int64_t before = ScratchMemory::peak_bytes();
    void* const memory = allocate_scratch(static_cast<std::size_t>(before) + kLeast, 16);
    EXPECT_EQ(folder.num_entries(), 0U);
    EXPECT_GE(ScratchMemory::peak_bytes(), before + static_cast<std::int64_t>(kLeast));
    free_scratch(memory);
    EXPECT_GE(ScratchMemory::peak_bytes(), before + static_cast<std::int64_t>(kLeast));
}

TEST(ScratchMemory, FreesArraysThatOutliveIt)
{
    const TemporaryFolder folder;
    void* memory = nullptr;
    {
        const ScratchMemory scratch(folder.path(), kNoLimit);
        memory = allocate_scratch(kLeast, 16);
    }
    numbers_at(memory, kLeast).back() = 1;
    EXPECT_TRUE(free_scratch(memory));
    EXPECT_EQ(num_maps_in(folder.path()), 0);
}

TEST(ScratchMemory, ExistsOncePerProcess)
{
    const TemporaryFolder folder;
    const ScratchMemory scratch(folder.path(), kNoLimit);
    EXPECT_THROW(ScratchMemory(folder.path(), kNoLimit), std::logic_error);
}

TEST(ScratchMemory, RejectsAMissingFolder)
{
    const TemporaryFolder folder;
    EXPECT_THAT(refusal<ScratchError>([&] { ScratchMemory(folder / "none", kNoLimit); }),
                HasSubstr("cannot create a file in the work folder " + (folder / "none").string() +
                          ": No such file or directory"));
}

TEST(ScratchMemory, ReportsMissingSpaceIfTheDiskIsFull)
{
    const TemporaryFolder folder;
    const ScratchMemory scratch(folder.path(), kNoLimit);
    const auto too_much = static_cast<std::size_t>(*free_space(folder.path())) * 2;
    EXPECT_THAT(
        refusal<ScratchError>([&] { allocate_scratch(too_much, 16); }),
        MatchesRegex("the work folder " + folder.path().string() +
                     " is full: [0-9.]+[KMG]? more are needed, but [0-9.]+[KMG]? are free"));
    EXPECT_EQ(folder.num_entries(), 0U);
    void* const memory = allocate_scratch(kLeast, 16);
    EXPECT_NE(memory, nullptr) << "smaller arrays still fit";
    free_scratch(memory);
}

TEST(ScratchMemory, LeavesFileDescriptorsForOtherFiles)
{
    rlimit limit = {};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
    const rlimit few = {64, limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
    const TemporaryFolder folder;
    const ScratchMemory scratch(folder.path(), kNoLimit);
    std::vector<void*> arrays(80);
    for (void*& array : arrays) {
        array = allocate_scratch(kLeast, 16);
        EXPECT_NE(array, nullptr);
    }
    for (void* const array : arrays) {
        EXPECT_TRUE(free_scratch(array));
    }
    ::setrlimit(RLIMIT_NOFILE, &limit);
}

TEST(ScratchMemory, IsNotMappedInForkedChildren)
{
    const TemporaryFolder folder;
    const ScratchMemory scratch(folder.path(), kNoLimit);
    void* const memory = allocate_scratch(kLeast, 16);
    const pid_t child = ::fork();
    if (child == 0) { // the child must not run other tests
        // mincore() fails for unmapped addresses.
        unsigned char resident = 0;
        ::_exit(::mincore(memory, 1, &resident) != 0 ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    free_scratch(memory);
}

TEST(ScratchMemory, IsThreadSafeWhilePagesAreDropped)
{
    const TemporaryFolder folder;
    const ScratchMemory scratch(folder.path(),
                                std::int64_t{16} << 20); // so pages are dropped all the time
    const auto work = [](std::uint64_t seed) {
        std::size_t wrong = 0;
        for (std::uint64_t round = 0; round < 6; ++round) {
            const std::size_t bytes = kLeast + 4096 * (seed + round);
            void* const memory = allocate_scratch(bytes, 16);
            const auto numbers = numbers_at(memory, bytes);
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                numbers[i] = i * seed + round;
            }
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                wrong += numbers[i] != i * seed + round ? 1 : 0;
            }
            free_scratch(memory);
        }
        return wrong;
    };
    std::vector<std::size_t> wrong(4, 1);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < wrong.size(); ++i) {
        threads.emplace_back([&, i] { wrong[i] = work(i + 1); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_THAT(wrong, ::testing::Each(0U));
}

#ifndef VCARVE_SANITIZED // sanitizers need additional memory
TEST(ScratchMemory, KeepsLittleOfALargeArrayInMemory)
{
    const TemporaryFolder folder;
    const std::int64_t before = resident_size()->all;
    constexpr std::int64_t kAllowed = std::int64_t{64} << 20;
    const ScratchMemory scratch(folder.path(), before + kAllowed);
    constexpr std::size_t kBytes = std::size_t{512} << 20;
    void* const memory = allocate_scratch(kBytes, 16);
    const auto numbers = numbers_at(memory, kBytes);
    constexpr std::size_t kStep = std::size_t{1} << 19;
    for (std::size_t i = 0; i < numbers.size(); i += kStep) {
        for (std::size_t k = i; k < i + kStep; ++k) {
            numbers[k] = k * k;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2)); // simulates computation
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_LE(resident_size()->all, before + kAllowed);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        ASSERT_EQ(numbers[k], k * k);
    }
    free_scratch(memory);
}
#endif

} // namespace
} // namespace vcarve::scratch_memory_test
