#pragma once

#include "base/droppable_pages.h"

#include <boost/interprocess/mapped_region.hpp>

#include <cstddef>
#include <filesystem>
#include <span>

namespace vcarve {

/// The bytes of a file, read-only and mapped into memory for as long as the object lives; an empty
/// file gives an empty span. The file must not be shortened by somebody else in the meantime.
class MappedFile {
  public:
    /// Throws InputError where `path` is not a file that can be read.
    explicit MappedFile(const std::filesystem::path& path);
    MappedFile(MappedFile&&) = default;
    MappedFile& operator=(MappedFile&&) = delete; // pages are forgotten before they are unmapped
    ~MappedFile() = default;

    std::span<const char> bytes() const;

    /// Gives back the memory of the first so many bytes, about, which are read from the file again
    /// where they are asked for again.
    void release(std::size_t count) const;

  private:
    boost::interprocess::mapped_region region_;
    DroppablePages pages_;
};

} // namespace vcarve
