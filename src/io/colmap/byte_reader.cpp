#include "io/colmap/byte_reader.h"

#include "vcarve/error.h"

#include <fmt/format.h>

namespace vcarve {

void ByteReader::fail_short(std::size_t expected, std::string_view what) const
{
    throw InputError(
        fmt::format("{}: byte {}: the file ends inside {} (bytes expected: {}, found: {})", name_,
                    offset_, what, expected, left()));
}

std::uint64_t ByteReader::read_count(std::size_t record_bytes, const char* what)
{
    if (bytes_.empty()) throw InputError(fmt::format("{}: the file is empty", name_));
    const std::size_t begin = offset_;
    if (left() < sizeof(std::uint64_t)) {
        fail_short(sizeof(std::uint64_t), fmt::format("the number of {}", what));
    }
    const auto count = read<std::uint64_t>(what);
    const std::uint64_t most = left() / record_bytes;
    if (count > most) {
        throw InputError(
            fmt::format("{}: byte {}: found a count of {} {}, but the rest of the file "
                        "can hold {} at most",
                        name_, begin, count, what, most));
    }
    return count;
}

std::string_view ByteReader::read_zero_terminated(const char* what)
{
    const char* begin = bytes_.data() + offset_;
    const void* end = left() == 0 ? nullptr : std::memchr(begin, 0, left());
    if (end == nullptr) {
        throw InputError(
            fmt::format("{}: byte {}: the file ends inside {} (no terminating zero byte)", name_,
                        offset_, what));
    }
    const std::string_view text(begin, static_cast<const char*>(end));
    offset_ += text.size() + 1;
    return text;
}

void ByteReader::expect_end(const char* what) const
{
    if (left() == 0) return;
    throw InputError(fmt::format("{}: byte {}: expected the end of the file after {}, found more "
                                 "bytes: {}",
                                 name_, offset_, what, left()));
}

} // namespace vcarve
