#include "base/droppable_pages.h"
#include "support/mapping_flags.h"
#include "support/temporary_folder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <span>
#include <string>
#include <utility>

namespace vcarve::droppable_pages_test {
namespace {

constexpr std::size_t kPiece = std::size_t{4} << 20;

/// A file that is mapped for writing, and its resident size in this process.
class Mapping {
  public:
    Mapping(const std::filesystem::path& path, std::size_t bytes)
        : bytes_(bytes), file_(::open(path.c_str(), O_RDWR | O_CREAT, 0600))
    {
        EXPECT_EQ(::ftruncate(file_, static_cast<off_t>(bytes)), 0);
        begin_ = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
        EXPECT_NE(begin_, MAP_FAILED);
        std::ranges::fill(letters(), 'a');
    }
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    ~Mapping()
    {
        ::munmap(begin_, bytes_);
        ::close(file_);
    }

    DroppablePages droppable() const { return {begin_, bytes_, file_}; }
    std::span<char> letters() const { return {static_cast<char*>(begin_), bytes_}; }

    /// The resident size of this mapping in kilobytes, from smaps.
    long resident() const
    {
        char first[32];
        std::snprintf(first, sizeof(first), "%lx-", reinterpret_cast<unsigned long>(begin_));
        std::ifstream smaps("/proc/self/smaps");
        bool is_here = false;
        for (std::string line; std::getline(smaps, line);) {
            if (line.find('-') < 20 && line.find(' ') > line.find('-')) {
                is_here = line.rfind(first, 0) == 0;
            }
            if (is_here && line.rfind("Rss:", 0) == 0) return std::stol(line.substr(4));
        }
        return -1;
    }

  private:
    std::size_t bytes_;
    int file_;
    void* begin_ = nullptr;
};

TEST(DroppablePages, AreDroppedInTurnAndReadBackOnAccess)
{
    const TemporaryFolder folder;
    const Mapping one(folder / "one", kPiece);
    const Mapping other(folder / "other", kPiece);
    const DroppablePages of_one = one.droppable();
    const DroppablePages of_other = other.droppable();
    EXPECT_EQ(drop_next_pages(kPiece, false), kPiece);
    EXPECT_EQ(std::min(one.resident(), other.resident()), 0) << "one is dropped";
    EXPECT_GT(std::max(one.resident(), other.resident()), 0);
    EXPECT_EQ(drop_next_pages(kPiece, true), kPiece);
    EXPECT_EQ(one.resident() + other.resident(), 0) << "then the other is dropped";
    EXPECT_EQ(one.letters().front(), 'a');
    EXPECT_EQ(other.letters().back(), 'a');
}

TEST(DroppablePages, AreVisitedAtMostOncePerCall)
{
    EXPECT_EQ(drop_next_pages(kPiece, false), 0U);
    const TemporaryFolder folder;
    const Mapping file(folder / "file", kPiece + 8192);
    const DroppablePages pages = file.droppable();
    EXPECT_EQ(drop_next_pages(100 * kPiece, false), kPiece + 8192);
    EXPECT_EQ(file.resident(), 0);
}

TEST(DroppablePages, AreNotDroppedAfterDestruction)
{
    const TemporaryFolder folder;
    const Mapping file(folder / "file", kPiece);
    {
        DroppablePages pages = file.droppable();
        drop_next_pages(kPiece, false); // moves the drop position to the end of this file
        const DroppablePages moved = std::move(pages);
        EXPECT_EQ(drop_next_pages(kPiece, false), kPiece) << "moved pages stay registered";
    }
    std::ranges::fill(file.letters(), 'b');
    EXPECT_EQ(drop_next_pages(kPiece, false), 0U);
    EXPECT_GT(file.resident(), 0);
}

/// Whether read-ahead is disabled for this mapping.
bool reads_touched_only(const Mapping& file)
{
    const std::string flags = mapping_flags(file.letters().data());
    EXPECT_THAT(flags, ::testing::HasSubstr(" rd ")) << "smaps lists the flags of the mapping";
    return flags.find(" rr ") != std::string::npos;
}

TEST(ScatteredUse, DisablesReadAheadUntilTheLastIsDestroyed)
{
    const TemporaryFolder folder;
    const Mapping file(folder / "file", kPiece);
    const Mapping other(folder / "other", kPiece);
    const DroppablePages pages = file.droppable();
    const DroppablePages of_other = other.droppable();
    EXPECT_FALSE(reads_touched_only(file));
    {
        const ScatteredUse use;
        EXPECT_TRUE(reads_touched_only(file));
        EXPECT_TRUE(reads_touched_only(other));
        {
            const ScatteredUse another;
        }
        EXPECT_TRUE(reads_touched_only(file)) << "one object is left";
    }
    EXPECT_FALSE(reads_touched_only(file));
    EXPECT_FALSE(reads_touched_only(other));
}

} // namespace
} // namespace vcarve::droppable_pages_test
