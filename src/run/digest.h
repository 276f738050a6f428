#pragma once

#include "base/progress.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// 128 bits that differ where bytes differ: they guard against mistakes and broken disks, not
/// against somebody who wants two contents to look the same.
using Digest = std::array<std::uint8_t, 16>;

/// As 32 letters.
std::string digest_text(const Digest& digest);

/// The digest of bytes that come piece by piece. It does not depend on how they are cut into
/// pieces: each whole MiB of them has an MD5 of its own, and these are chained. Cost: linear, in
/// parallel within a piece, some 400 MB/s a thread.
class RunningDigest {
  public:
    void add(std::span<const char> bytes);
    Digest value() const;

  private:
    Digest chain_{};
    std::vector<char> rest_; ///< of the bytes, what fills no block yet
};

Digest digest_of(std::span<const char> bytes);

/// The digest of a file's content. Throws InputError where it cannot be read, and Cancelled.
Digest digest_of_file(const std::filesystem::path& path, const Progress& progress = {});

} // namespace vcarve
