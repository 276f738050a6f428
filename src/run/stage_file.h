#pragma once

#include "io/files/output_file.h"
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

// A stage file has the result of a stage. The header has a magic number, the layout's version, the
// size of the content, the job's digest, the stage's name, and a digest of these. The content and
// its digest follow. Arrays have their memory layout, so no copy is needed, and numbers are in the
// format of the machine that wrote them.
namespace vcarve {

/// The number of fields of a struct in a stage file. All fields are saved, in order. A wrong number
/// does not compile, so no field can be forgotten.
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
inline constexpr int kNumFields<TriMesh> = 6;

/// Calls field() with each field of a struct.
template <typename Noun, typename Field>
void for_each_field(Noun& noun, const Field& field)
{
    const auto all = [&](auto&... fields) { (field(fields), ...); };
    constexpr int kCount = kNumFields<std::remove_const_t<Noun>>;
    if constexpr (kCount == 2) {
        auto& [a, b] = noun;
        all(a, b);
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
        static_assert(kCount == 11, "specialize kNumFields for this type");
        auto& [a, b, c, d, e, f, g, h, i, j, k] = noun;
        all(a, b, c, d, e, f, g, h, i, j, k);
    }
}

/// Whether the bytes of a value in memory are its complete content.
template <typename T>
inline constexpr bool kIsPlain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;
template <typename T, int Rows, int Columns>
inline constexpr bool kIsPlain<Eigen::Matrix<T, Rows, Columns>> = Rows > 0 && Columns > 0;
template <typename T>
inline constexpr bool kIsPlain<Eigen::Quaternion<T>> = true;
template <typename T, std::size_t kSize>
inline constexpr bool kIsPlain<std::array<T, kSize>> = kIsPlain<T>;

template <typename T>
inline constexpr bool kIsArray = false;
template <typename T, typename Allocator>
inline constexpr bool kIsArray<std::vector<T, Allocator>> = true;
template <>
inline constexpr bool kIsArray<std::string> = true;

/// Identifies the content of a stage file.
struct StageLabel {
    std::string name; ///< the stage, at most kLongestName bytes
    Digest job;       ///< digest of input and options, see job.h

    static constexpr std::size_t kLongestName = 63;
};

/// Writes a stage file. The file appears only when commit() returns.
class StageWriter {
  public:
    /// Writes nothing, but counts the bytes.
    StageWriter() = default;
    /// `bytes` is the count of a counting writer for the same values. This and all other functions
    /// throw UsageError if the file cannot be written.
    StageWriter(const std::filesystem::path& path, const StageLabel& label, std::uint64_t bytes);

    template <typename T>
    void put(const T& value);
    void commit();

    std::uint64_t bytes() const { return done_; } ///< of the content so far

  private:
    void put_bytes(const void* data, std::size_t count);

    std::optional<OutputFile> file_; ///< nullopt if it only counts
    std::uint64_t done_ = 0;
    RunningDigest digest_;
};

/// Reads a stage file. Values are valid only after finish() has returned. Every function throws
/// InputError if the file is missing, unreadable, truncated, damaged, or of another stage or job;
/// the message names the file, and what was found and expected. Never allocates more bytes than
/// the file has.
class StageReader {
  public:
    StageReader(std::filesystem::path path, const StageLabel& label);

    template <typename T>
    void get(T& value);
    void finish();

    std::uint64_t bytes() const { return bytes_; } ///< of the content

  private:
    void read_header(const StageLabel& label);
    void read(void* data, std::size_t count);
    void get_bytes(void* data, std::size_t count);
    /// Reads the number of items, each of at least `item_bytes` bytes.
    std::size_t get_count(std::size_t item_bytes);
    [[noreturn]] void refuse(std::string_view what) const;

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
    std::uint64_t bytes_ = 0;
    std::uint64_t done_ = 0;
    RunningDigest digest_;
};

template <typename T>
void StageWriter::put(const T& value)
{
    if constexpr (kIsPlain<T>) {
        put_bytes(&value, sizeof(T));
    } else if constexpr (kIsArray<T>) {
        put(std::uint64_t{value.size()});
        if constexpr (kIsPlain<typename T::value_type>) {
            put_bytes(value.data(), value.size() * sizeof(typename T::value_type));
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
        if (byte > 1) refuse("its content is damaged: a boolean is neither 0 nor 1");
        value = byte != 0;
    } else if constexpr (kIsPlain<T>) {
        get_bytes(&value, sizeof(T));
    } else if constexpr (kIsArray<T>) {
        using Item = typename T::value_type;
        value.clear();
        if constexpr (kIsPlain<Item>) {
            value.resize(get_count(sizeof(Item)));
            get_bytes(value.data(), value.size() * sizeof(Item));
        } else {
            // One by one, so that a wrong count fails at the end of the file.
            for (std::size_t left = get_count(1); left > 0; --left)
                get(value.emplace_back());
        }
    } else {
        for_each_field(value, [&](auto& field) { get(field); });
    }
}

} // namespace vcarve
