#include "base/droppable_pages.h"

#include <fcntl.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <mutex>

namespace vcarve {

namespace {

struct Range {
    std::size_t bytes;
    int file;
};

/// All ranges by their first byte, and the address at which the last drop ended.
struct Ranges {
    std::mutex mutex;
    std::map<std::uintptr_t, Range> by_begin;
    std::uintptr_t dropped_to = 0;
    int scattered_uses = 0;
};

/// Lives as long as the process, because pages may be unmapped after static objects are destroyed.
Ranges& ranges()
{
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): see above
    static auto* const all = new Ranges;
    return *all;
}

std::uintptr_t number_of(const void* address)
{
    return reinterpret_cast<std::uintptr_t>(address);
}

/// The range that contains `place`, else the next range, else the first. Needs at least one range.
auto range_at(const std::map<std::uintptr_t, Range>& by_begin, std::uintptr_t place)
{
    auto next = by_begin.upper_bound(place);
    if (next != by_begin.begin()) {
        const auto before = std::prev(next);
        if (place - before->first < before->second.bytes) return before;
    }
    return next == by_begin.end() ? by_begin.begin() : next;
}

void* address_of(std::uintptr_t number)
{
    return reinterpret_cast<void*>(number); // NOLINT(performance-no-int-to-ptr): was a pointer
}

/// Advises the system how all ranges are used. If it ignores the advice, it only reads too much.
void advise(const Ranges& all, int advice)
{
    for (const auto& [begin, range] : all.by_begin)
        static_cast<void>(::madvise(address_of(begin), range.bytes, advice));
}

std::size_t bytes_of(Ranges& all)
{
    const std::lock_guard lock(all.mutex);
    std::size_t bytes = 0;
    for (const auto& [begin, range] : all.by_begin)
        bytes += range.bytes;
    return bytes;
}

/// Drops pages, and starts to write them to the file if there is one. Failures only cost memory.
void drop(std::uintptr_t begin, std::size_t offset, std::size_t bytes, int written_back)
{
    static_cast<void>(::madvise(address_of(begin + offset), bytes, MADV_DONTNEED));
#ifdef __linux__
    if (written_back != DroppablePages::kNoFile) {
        static_cast<void>(::sync_file_range(written_back, static_cast<off_t>(offset),
                                            static_cast<off_t>(bytes), SYNC_FILE_RANGE_WRITE));
    }
#endif
}

} // namespace

DroppablePages::DroppablePages(const void* begin, std::size_t bytes, int file)
{
    if (bytes == 0) return;
    begin_ = begin;
    Ranges& all = ranges();
    const std::lock_guard lock(all.mutex);
    all.by_begin[number_of(begin)] = {bytes, file};
}

DroppablePages::~DroppablePages()
{
    if (begin_ == nullptr) return;
    Ranges& all = ranges();
    std::map<std::uintptr_t, Range>::node_type gone; // freed without the lock
    const std::lock_guard lock(all.mutex);
    gone = all.by_begin.extract(number_of(begin_));
}

ScatteredUse::ScatteredUse()
{
    Ranges& all = ranges();
    const std::lock_guard lock(all.mutex);
    if (all.scattered_uses++ == 0) advise(all, MADV_RANDOM);
}

ScatteredUse::~ScatteredUse()
{
    Ranges& all = ranges();
    const std::lock_guard lock(all.mutex);
    if (--all.scattered_uses == 0) advise(all, MADV_NORMAL);
}

std::size_t drop_next_pages(std::size_t bytes, bool write_back)
{
    // Holds the lock for a piece, because addresses of an unregistered range may be reused. A piece
    // needs a fraction of a millisecond.
    constexpr std::size_t kPiece = std::size_t{4} << 20;
    Ranges& all = ranges();
    const std::size_t most = std::min(bytes, bytes_of(all)); // each page at most once
    std::size_t looked_at = 0;
    while (looked_at < most) {
        const std::lock_guard lock(all.mutex);
        if (all.by_begin.empty()) break;
        const auto range = range_at(all.by_begin, all.dropped_to);
        const auto& [begin, what] = *range;
        const bool is_within = all.dropped_to >= begin && all.dropped_to - begin < what.bytes;
        const std::size_t offset = is_within ? all.dropped_to - begin : 0;
        const std::size_t piece = std::min(kPiece, what.bytes - offset);
        drop(begin, offset, piece, write_back ? what.file : DroppablePages::kNoFile);
        all.dropped_to = begin + offset + piece;
        looked_at += piece;
    }
    return looked_at;
}

} // namespace vcarve
