#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace vcarve {

/// A cursor over the bytes of a little-endian binary file that never reads past their end.
/// All that fails throws InputError naming the file and the offset of the byte; `what` is how the
/// message calls the thing that was to be read, with its article: "the pose of an image".
class ByteReader {
  public:
    /// `bytes` must outlive the reader; `name` is how messages call the file.
    ByteReader(std::span<const char> bytes, std::string name)
        : bytes_(bytes), name_(std::move(name))
    {
    }

    std::size_t offset() const { return offset_; }
    /// How much of the file is read, 0 to 1.
    double share_read() const
    {
        return static_cast<double>(offset_) / static_cast<double>(bytes_.size());
    }
    std::size_t left() const { return bytes_.size() - offset_; }

    template <typename T>
    requires std::is_trivially_copyable_v<T> T read(const char* what)
    {
        static_assert(std::endian::native == std::endian::little, "the bytes need swapping here");
        if (left() < sizeof(T)) fail_short(sizeof(T), what);
        T value;
        std::memcpy(&value, bytes_.data() + offset_, sizeof(T));
        offset_ += sizeof(T);
        return value;
    }

    /// Reads a count of records of at least `record_bytes` each, and refuses one that the bytes
    /// left cannot hold: what it returns is safe to size an allocation from. `what` is a plural.
    std::uint64_t read_count(std::size_t record_bytes, const char* what);

    /// Characters up to the next zero byte, which is skipped; they point into the file.
    std::string_view read_zero_terminated(const char* what);

    /// Goes `count` records of `record_bytes` ahead; `count` must come from read_count.
    void skip(std::uint64_t count, std::size_t record_bytes) { offset_ += count * record_bytes; }

    /// Refuses bytes after the end; `what` is what should have come last.
    void expect_end(const char* what) const;

  private:
    [[noreturn]] void fail_short(std::size_t expected, std::string_view what) const;

    std::span<const char> bytes_;
    std::size_t offset_ = 0;
    std::string name_;
};

} // namespace vcarve
