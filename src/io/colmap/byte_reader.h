#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace vcarve {

/// A cursor over a little-endian binary file that never reads past its end. Errors throw InputError
/// with the file and the byte offset. The argument `what` names the expected data in messages, with
/// its article: "the pose of an image".
class ByteReader {
  public:
    /// `bytes` must outlive the reader. `name` is the file name in messages.
    ByteReader(std::span<const char> bytes, std::string name)
        : bytes_(bytes), name_(std::move(name))
    {
    }

    std::size_t offset() const { return offset_; }
    /// The fraction of the file that was read, 0 to 1.
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

    /// Reads a count of records of at least `record_bytes` each. Throws if the remaining bytes
    /// cannot hold them, so the count is a safe allocation size. `what` is a plural.
    std::uint64_t read_count(std::size_t record_bytes, const char* what);

    /// Reads up to the next zero byte, and skips that byte. The result points into the file.
    std::string_view read_zero_terminated(const char* what);

    /// Skips `count` records of `record_bytes`. Precondition: `count` comes from read_count().
    void skip(std::uint64_t count, std::size_t record_bytes) { offset_ += count * record_bytes; }

    /// Throws if bytes remain. `what` names the last data of the file.
    void expect_end(const char* what) const;

  private:
    [[noreturn]] void fail_short(std::size_t expected, std::string_view what) const;

    std::span<const char> bytes_;
    std::size_t offset_ = 0;
    std::string name_;
};

} // namespace vcarve
