#pragma once

#include "base/resident_limit.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <new>
#include <optional>
#include <string>

namespace vcarve {

/// An array that finds no place in the work folder: what() is one sentence with the folder. It is
/// what operator new may throw, and text of its own, since memory may be short.
class ScratchError : public std::bad_alloc {
  public:
    explicit ScratchError(const std::string& sentence);
    const char* what() const noexcept override { return sentence_.data(); }

  private:
    std::array<char, 1024> sentence_{};
};

/// While one lives, large arrays are kept in files of a folder instead of memory: what
/// allocate_scratch() gives is a file without a name, mapped; and pages of these files leave memory
/// where the process has more than so many bytes resident. Passes run unchanged on what does not
/// fit into memory. One at a time in a process; arrays may outlive it.
///
/// Only a program whose operator new asks allocate_scratch() has its arrays there; the one of
/// colmap-vcarve does (cli/scratch_new.cpp). A program that links the library keeps all its arrays
/// in memory unless it does the same.
///
/// The files are gone when their arrays are, and when the process ends, however that happens. Their
/// space is taken when they are made, so that a full disk is an exception there and no crash later.
/// What fails later is the disk itself: then the system sends SIGBUS. A process that forks keeps
/// the arrays for itself: in the child they are no memory.
class ScratchMemory {
  public:
    /// CGAL's and oneTBB's blocks are smaller, and stay in memory.
    static constexpr std::size_t kLeastBytes = std::size_t{8} << 20;

    /// Throws ScratchError where no file can be made in the folder, which must exist, and
    /// std::logic_error where there is a ScratchMemory.
    ScratchMemory(const std::filesystem::path& folder, std::int64_t most_resident);
    /// Arrays stay in memory, as where there is none, but map_over_scratch() can put files in their
    /// place.
    ScratchMemory();
    ScratchMemory(const ScratchMemory&) = delete;
    ScratchMemory& operator=(const ScratchMemory&) = delete;
    ~ScratchMemory();

    /// The most bytes that were in the folder at a time since the process began.
    static std::int64_t peak_bytes();

  private:
    std::optional<ResidentLimit> limit_;
};

/// Memory, in the work folder where the ScratchMemory has one, for an array of so many bytes,
/// aligned to pages and filled with zeros. Null where no ScratchMemory lives, the array has fewer
/// than kLeastBytes, or wants to be aligned to more than a page: then it is the caller's turn.
/// Throws ScratchError where the folder takes no more, and std::bad_alloc where the process has no
/// addresses left. Thread safe.
void* allocate_scratch(std::size_t bytes, std::size_t alignment);

/// Frees what allocate_scratch() gave and returns true; false for all other memory, which costs a
/// look at the address. Thread safe; works when the ScratchMemory is gone.
bool free_scratch(void* memory) noexcept;

/// A place in an open file.
struct FilePlace {
    int file = -1;          ///< descriptor; needed no longer than the call takes
    std::int64_t begin = 0; ///< where a page of the file begins
};

/// Puts bytes of a file in the place of what allocate_scratch() gave, to be read only: they are in
/// memory where they are looked at, and only then. What stood there, and its space, is gone. False
/// where the memory is none of allocate_scratch(), or the file cannot be mapped; nothing is changed
/// then. The file must keep its length.
bool map_over_scratch(void* memory, std::size_t bytes, const FilePlace& place);

/// How many bytes the file system of a folder still takes, for those who are not root; nothing
/// where it does not say.
std::optional<std::int64_t> free_space(const std::filesystem::path& folder);

} // namespace vcarve
