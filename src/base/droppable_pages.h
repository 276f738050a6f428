#pragma once

#include <cstddef>
#include <utility>

namespace vcarve {

/// Pages that are mapped, shared, from a file, and so may be dropped from memory at any time: what
/// is in them stays in the file, and the system reads it back where it is asked for again. As long
/// as the object lives, drop_next_pages() may do that. It must go before the pages are unmapped.
/// Never made of other memory: what is dropped of that is lost. Thread safe.
class DroppablePages {
  public:
    DroppablePages() = default;

    /// `begin` is where a page begins. `file` is open for writing, where pages that were written to
    /// are to go to the disk when they are dropped, or kNoFile.
    DroppablePages(const void* begin, std::size_t bytes, int file = kNoFile);
    DroppablePages(DroppablePages&& other) noexcept : begin_(std::exchange(other.begin_, nullptr))
    {
    }
    DroppablePages& operator=(DroppablePages&& other) noexcept
    {
        std::swap(begin_, other.begin_);
        return *this;
    }
    ~DroppablePages();

    static constexpr int kNoFile = -1;

  private:
    const void* begin_ = nullptr;
};

/// While one lives, threads touch droppable pages here and there: of those that are in files only,
/// the system reads what is touched, and not the megabytes around it, as it does for those who go
/// on from where they are. Costs nothing where there are no such pages. Thread safe; it holds for
/// the ranges that are droppable when the first is made, and until the last is gone.
class ScatteredUse {
  public:
    ScatteredUse();
    ScatteredUse(const ScatteredUse&) = delete;
    ScatteredUse& operator=(const ScatteredUse&) = delete;
    ~ScatteredUse();
};

/// Drops the next so many bytes of all droppable pages, at most, in turn; where there are fewer,
/// all. With `write_back` the system also begins to write those that differ from what is on the
/// disk, and does not wait for it. Returns how many bytes were looked at, whether they were in
/// memory or not: 0 where there is nothing to drop.
///
/// This is madvise(MADV_DONTNEED) on shared mappings of files, which only takes the pages out of
/// the process: they stay in the system's cache of the file, with all that was written to them, and
/// threads that read or write them at the same time find them there again (madvise(2)).
std::size_t drop_next_pages(std::size_t bytes, bool write_back);

} // namespace vcarve
