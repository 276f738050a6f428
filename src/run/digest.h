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

/// A 128-bit digest. It detects mistakes and broken disks, but not somebody who constructs two
/// contents with the same digest.
using Digest = std::array<std::uint8_t, 16>;

/// The digest as 32 hexadecimal digits.
std::string digest_text(const Digest& digest);

/// The digest of bytes that are added in pieces. It does not depend on the sizes of the pieces: the
/// MD5 digests of each whole MiB are chained. Cost: linear, in parallel within a piece, about
/// 400 MB/s per thread.
class RunningDigest {
  public:
    void add(std::span<const char> bytes);
    Digest value() const;

  private:
    Digest chain_{};
    std::vector<char> rest_; ///< bytes of the incomplete last block
};

Digest digest_of(std::span<const char> bytes);

/// The digest of a file's content. Throws InputError if it cannot be read, and Cancelled.
Digest digest_of_file(const std::filesystem::path& path, const Progress& progress = {});

} // namespace vcarve
