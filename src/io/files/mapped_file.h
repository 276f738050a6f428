#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <system_error>

namespace vcarve {

/// Pose files of nerfstudio, and of Blender's scripts for NeRF.
inline constexpr const char* kTransforms = "transforms.json";
inline constexpr const char* kTransformsTrain = "transforms_train.json";

/// Whether `path` is a file (is_folder: a folder). Follows links; false if the status is unknown.
inline bool is_file(const std::filesystem::path& path)
{
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
}

inline bool is_folder(const std::filesystem::path& path)
{
    std::error_code error;
    return std::filesystem::is_directory(path, error);
}

/// A clause that explains why `path` is not a file; empty if it is one.
std::string file_problem(const std::filesystem::path& path);

/// Maps a file into memory, read-only, while the object lives. An empty file gives an empty span.
/// Precondition: no other process truncates the file in the meantime.
class MappedFile {
  public:
    /// Throws InputError if `path` is not a readable file, or if refuse_foreign_file() throws.
    explicit MappedFile(const std::filesystem::path& path);
    MappedFile(MappedFile&&) = default;
    MappedFile& operator=(MappedFile&&) = default;
    ~MappedFile() = default;

    std::span<const char> bytes() const { return {mapping_.get(), mapping_.get_deleter().size}; }

    /// Releases the memory of the first `count` bytes, rounded down to whole pages. A later access
    /// reads them from the file again.
    void release(std::size_t count) const;

  private:
    struct Unmap {
        std::size_t size = 0;
        void operator()(char* begin) const;
    };
    using Mapping = std::unique_ptr<char, Unmap>; ///< null for an empty file
    static Mapping map(const std::filesystem::path& path);

    Mapping mapping_;
};

/// Releases the memory of a file while it is read from start to end, so that a large file is not in
/// memory together with the data made from it.
class ReadOnce {
  public:
    explicit ReadOnce(const MappedFile& file) : file_(file) {}

    /// Promises that the bytes before `offset` are not read again. Cost: none for most calls.
    void read_up_to(std::size_t offset)
    {
        constexpr std::size_t kAtOnce = std::size_t{1} << 20U;
        if (offset - released_ < kAtOnce) return;
        file_.release(offset);
        released_ = offset;
    }

  private:
    const MappedFile& file_;
    std::size_t released_ = 0;
};

} // namespace vcarve
