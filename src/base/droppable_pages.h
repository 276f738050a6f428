#pragma once

#include <cstddef>
#include <utility>

namespace vcarve {

/// Registers pages of a shared file mapping, which may be dropped from memory at any time. The file
/// keeps their content, and the system reads it back on access. drop_next_pages() may drop them
/// while the object lives. Destroy the object before unmapping the pages. Never register other
/// memory: its content would be lost. Thread-safe.
class DroppablePages {
  public:
    DroppablePages() = default;

    /// `begin` is the start of a page. `file` is a descriptor open for writing, to which dropped
    /// pages can be written back, or kNoFile.
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

/// Disables read-ahead of droppable pages while an object lives, for threads with random access.
/// The system then reads only touched pages from files, not the megabytes around them. Costs
/// nothing without such pages. Thread-safe. Applies to the ranges that are registered when the
/// first object is created, until the last object is destroyed.
class ScatteredUse {
  public:
    ScatteredUse();
    ScatteredUse(const ScatteredUse&) = delete;
    ScatteredUse& operator=(const ScatteredUse&) = delete;
    ~ScatteredUse();
};

/// Drops the next `bytes` of all droppable pages in cyclic order, or all pages if there are fewer.
/// With `write_back` the system also starts to write modified pages to the disk, without waiting.
/// Returns the number of visited bytes, whether they were in memory or not; 0 if no pages are
/// droppable.
///
/// Uses madvise(MADV_DONTNEED) on shared file mappings, which only removes pages from the process.
/// They stay in the system's page cache with all modifications, so concurrent readers and writers
/// get them back (madvise(2)).
std::size_t drop_next_pages(std::size_t bytes, bool write_back);

} // namespace vcarve
