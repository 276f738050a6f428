#pragma once

#include "base/progress.h"
#include "io/files/output_file.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "run/digest.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

// A file with what a stage made: a header (a magic number, the layout's version, the stage's name,
// the digest of the job, how many bytes follow, and a digest of all that), the content, and a
// digest of the content. Arrays stand as they do in memory, so that they are written from and read
// into their place; numbers are those of the machine that wrote them. Large arrays begin with a
// page of the file, so that they can be mapped.
namespace vcarve {

/// How many fields a noun has that stands in a stage file. All of them are kept, in order: a number
/// that is not that of the fields does not compile, so that none can be forgotten.
template <typename Noun>
inline constexpr int kNumFields = 0;

template <>
inline constexpr int kNumFields<Camera> = 6;
template <>
inline constexpr int kNumFields<View> = 5;
template <>
inline constexpr int kNumFields<Tracks> = 2;
template <>
inline constexpr int kNumFields<Scene> = 11;
template <>
inline constexpr int kNumFields<TetMesh> = 4;
template <>
inline constexpr int kNumFields<FlowNetwork> = 2;
template <>
inline constexpr int kNumFields<VisibilityEnergy> = 3;
template <>
inline constexpr int kNumFields<TriMesh> = 6;
template <typename First, typename Second>
inline constexpr int kNumFields<std::pair<First, Second>> = 2;

/// Calls field() with each field of a noun.
template <typename Noun, typename Field>
void for_each_field(Noun& noun, const Field& field)
{
    const auto all = [&](auto&... fields) { (field(fields), ...); };
    constexpr int kCount = kNumFields<std::remove_const_t<Noun>>;
    if constexpr (kCount == 2) {
        auto& [a, b] = noun;
        all(a, b);
    } else if constexpr (kCount == 3) {
        auto& [a, b, c] = noun;
        all(a, b, c);
    } else if constexpr (kCount == 4) {
        auto& [a, b, c, d] = noun;
        all(a, b, c, d);
    } else if constexpr (kCount == 5) {
        auto& [a, b, c, d, e] = noun;
        all(a, b, c, d, e);
    } else if constexpr (kCount == 6) {
        auto& [a, b, c, d, e, f] = noun;
        all(a, b, c, d, e, f);
    } else {
        static_assert(kCount == 11, "say how many fields it has");
        auto& [a, b, c, d, e, f, g, h, i, j, k] = noun;
        all(a, b, c, d, e, f, g, h, i, j, k);
    }
}

/// Whether the bytes of a value in memory are all there is to it.
template <typename T>
inline constexpr bool kIsPlain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;
template <typename T, int Rows, int Columns>
inline constexpr bool kIsPlain<Eigen::Matrix<T, Rows, Columns>> = Rows > 0 && Columns > 0;
template <typename T>
inline constexpr bool kIsPlain<Eigen::Quaternion<T>> = true;
template <typename T, std::size_t kSize>
inline constexpr bool kIsPlain<std::array<T, kSize>> = kIsPlain<T>;

template <typename T>
inline constexpr bool kIsOptional = false;
template <typename T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

template <typename T>
inline constexpr bool kIsArray = false;
template <typename T, typename Allocator>
inline constexpr bool kIsArray<std::vector<T, Allocator>> = true;
template <>
inline constexpr bool kIsArray<std::string> = true;

/// What a stage file is of.
struct StageLabel {
    std::string name; ///< of the stage, at most kLongestName letters
    Digest job;       ///< input and options, see job.h

    static constexpr std::size_t kLongestName = 63;
};

/// Where the content of a stage file begins.
inline constexpr std::uint64_t kContentBegin = 128;

/// How many bytes stand before an array, so that large ones begin with a page.
constexpr std::uint64_t stage_padding(std::uint64_t content_before, std::uint64_t array_bytes)
{
    constexpr std::uint64_t kPage = 4096;
    constexpr std::uint64_t kLarge = std::uint64_t{1} << 20;
    if (array_bytes < kLarge) return 0;
    return (kPage - (kContentBegin + content_before) % kPage) % kPage;
}

/// Writes a stage file, which is there when commit() has ended and not before.
class StageWriter {
  public:
    /// Writes nothing, but counts the bytes that would be written.
    StageWriter() = default;
    /// `bytes` is what one that counts says of all that will be put. Throws UsageError where the
    /// file cannot be written, as everything else here does, and Cancelled where the progress does.
    StageWriter(const std::filesystem::path& path, const StageLabel& label, std::uint64_t bytes,
                const Progress& progress);

    template <typename T>
    void put(const T& value);
    void commit();

    std::uint64_t bytes() const { return done_; } ///< of the content, up to now

  private:
    void put_bytes(const void* data, std::size_t count);
    void put_array(const void* data, std::size_t bytes);

    std::optional<OutputFile> file_; ///< nothing where it counts
    std::uint64_t bytes_ = 0;
    std::uint64_t done_ = 0;
    RunningDigest digest_;
    Progress progress_;
};

/// Reads a stage file. What was got counts only when finish() has found all of it in order: every
/// function throws InputError, one sentence with the file, what was found and what was expected,
/// where the file is missing, unreadable, cut off, damaged, or of another stage or job. Never
/// allocates more than there are bytes in the file.
class StageReader {
  public:
    /// How the content is taken.
    enum class Content {
        checked, ///< read, and found to be what was written
        mapped,  ///< believed; large arrays in scratch memory are mapped from the file, read only
    };

    StageReader(std::filesystem::path path, const StageLabel& label, const Progress& progress,
                Content content = Content::checked);

    template <typename T>
    void get(T& value);
    void finish();

    std::uint64_t bytes() const { return bytes_; } ///< of the content

  private:
    void read_header(const StageLabel& label);
    void read(void* data, std::size_t count);
    void get_bytes(void* data, std::size_t count);
    void get_array(void* data, std::size_t bytes);
    bool map_array(void* data, std::size_t bytes);
    /// How many items follow; each takes so many bytes at least.
    std::size_t get_count(std::size_t item_bytes);
    [[noreturn]] void refuse(std::string_view what) const;

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
    Content content_;
    std::uint64_t bytes_ = 0;
    std::uint64_t done_ = 0;
    RunningDigest digest_;
    Progress progress_;
};

template <typename T>
void StageWriter::put(const T& value)
{
    if constexpr (kIsPlain<T>) {
        put_bytes(&value, sizeof(T));
    } else if constexpr (kIsOptional<T>) {
        put(value.has_value());
        if (value) put(*value);
    } else if constexpr (kIsArray<T>) {
        put(std::uint64_t{value.size()});
        if constexpr (kIsPlain<typename T::value_type>) {
            put_array(value.data(), value.size() * sizeof(typename T::value_type));
        } else {
            for (const auto& item : value)
                put(item);
        }
    } else {
        for_each_field(value, [&](const auto& field) { put(field); });
    }
}

template <typename T>
void StageReader::get(T& value)
{
    if constexpr (std::is_same_v<T, bool>) {
        std::uint8_t byte = 0;
        get(byte);
        if (byte > 1) refuse("its content is damaged: a yes or no is neither");
        value = byte != 0;
    } else if constexpr (kIsPlain<T>) {
        get_bytes(&value, sizeof(T));
    } else if constexpr (kIsOptional<T>) {
        bool has_value = false;
        get(has_value);
        value.reset();
        if (has_value) get(value.emplace());
    } else if constexpr (kIsArray<T>) {
        using Item = typename T::value_type;
        value.clear();
        if constexpr (kIsPlain<Item>) {
            value.resize(get_count(sizeof(Item)));
            get_array(value.data(), value.size() * sizeof(Item));
        } else {
            // One by one, so that a wrong count ends at the end of the file.
            for (std::size_t left = get_count(1); left > 0; --left)
                get(value.emplace_back());
        }
    } else {
        for_each_field(value, [&](auto& field) { get(field); });
    }
}

} // namespace vcarve
