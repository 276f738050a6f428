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

/// The work folder cannot hold an array. what() is one sentence with the folder. A bad_alloc, so
/// that operator new may throw it. The text is stored inside, because memory may be short.
class ScratchError : public std::bad_alloc {
  public:
    explicit ScratchError(const std::string& sentence);
    const char* what() const noexcept override { return sentence_.data(); }

  private:
    std::array<char, 1024> sentence_{};
};

/// Keeps large arrays in files of a folder instead of memory, while the object lives.
/// allocate_scratch() returns mapped, unnamed files. Their pages leave memory if the process has
/// more than `most_resident` bytes resident (ResidentLimit). So algorithms process data larger than
/// memory unchanged. Only one object may exist per process; arrays may outlive it.
///
/// This works only in programs whose operator new calls allocate_scratch(), like that of
/// colmap-vcarve (cli/scratch_new.cpp). Other programs that link the library keep all arrays in
/// memory.
///
/// Files disappear with their arrays, and whenever the process ends. Their space is allocated at
/// creation, so a full disk throws then instead of crashing the process later. Later only the disk
/// itself can fail: the system then sends SIGBUS. Forked children do not inherit the arrays.
class ScratchMemory {
  public:
    /// The blocks of CGAL and oneTBB are smaller, and stay in memory.
    static constexpr std::size_t kLeastBytes = std::size_t{8} << 20;

    /// The folder must exist. Throws ScratchError if no file can be created in it, and
    /// std::logic_error if another ScratchMemory exists.
    ScratchMemory(const std::filesystem::path& folder, std::int64_t most_resident);
    ScratchMemory(const ScratchMemory&) = delete;
    ScratchMemory& operator=(const ScratchMemory&) = delete;
    ~ScratchMemory();

    /// The peak size of arrays in the folder since the process started, in bytes.
    static std::int64_t peak_bytes();

  private:
    std::optional<ResidentLimit> limit_;
};

/// Allocates `bytes` bytes of page-aligned, zeroed memory, in the folder of the ScratchMemory if it
/// has one. Returns null if no ScratchMemory exists, the array has fewer than kLeastBytes, or the
/// alignment exceeds a page. The caller then allocates otherwise. Throws ScratchError if the folder
/// is full, and std::bad_alloc if the process has no addresses left. Thread-safe.
void* allocate_scratch(std::size_t bytes, std::size_t alignment);

/// Frees memory of allocate_scratch() and returns true. Returns false for other memory, usually
/// after a single test of the address. Thread-safe; also works without a ScratchMemory.
bool free_scratch(void* memory) noexcept;

/// The free bytes of the folder's file system for users other than root; nothing if unknown.
std::optional<std::int64_t> free_space(const std::filesystem::path& folder);

} // namespace vcarve
