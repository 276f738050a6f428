#pragma once

#include "base/droppable_pages.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <system_error>

namespace vcarve {

/// Files with the poses of nerfstudio, and of Blender's scripts for NeRF.
inline constexpr const char* kTransforms = "transforms.json";
inline constexpr const char* kTransformsTrain = "transforms_train.json";

/// Whether there is a file, or a folder, that links lead to; what cannot be asked is none.
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

/// Why there is no file of that path, as a clause; empty where there is one.
std::string why_no_file(const std::filesystem::path& path);

/// The bytes of a file, read-only and mapped into memory for as long as the object lives; an empty
/// file gives an empty span. The file must not be shortened by somebody else in the meantime.
class MappedFile {
  public:
    /// Throws InputError where `path` is not a file that can be read.
    explicit MappedFile(const std::filesystem::path& path);
    MappedFile(MappedFile&&) = default;
    MappedFile& operator=(MappedFile&&) = delete; // pages are forgotten before they are unmapped
    ~MappedFile() = default;

    std::span<const char> bytes() const { return {mapping_.get(), mapping_.get_deleter().size}; }

    /// Gives back the memory of the first so many bytes, about, which are read from the file again
    /// where they are asked for again.
    void release(std::size_t count) const;

  private:
    struct Unmap {
        std::size_t size = 0;
        void operator()(char* begin) const;
    };
    using Mapping = std::unique_ptr<char, Unmap>; ///< null for an empty file
    static Mapping map(const std::filesystem::path& path);

    Mapping mapping_;
    DroppablePages pages_;
};

/// Gives the memory of a file back while it is read from its begin to its end, so that what is read
/// of a large one does not stay beside what is made of it.
class ReadOnce {
  public:
    explicit ReadOnce(const MappedFile& file) : file_(file) {}

    /// The bytes before this one will not be read again. Cost: most often none.
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
