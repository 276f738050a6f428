#include "run/digest.h"

#include "base/parallel.h"
#include "io/files/mapped_file.h"

#include <boost/uuid/name_generator_md5.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace vcarve {

namespace {

constexpr std::size_t kBlockBytes = 1 << 20;

/// The MD5 of the previous digest and some bytes, as in a name of RFC 4122.
Digest chained(const Digest& before, std::span<const char> bytes)
{
    // Boost reads whole words, so unaligned bytes are copied to aligned memory. An empty span is
    // copied, too, because its pointer may be null.
    const bool begins_a_word =
        reinterpret_cast<std::uintptr_t>(bytes.data()) % alignof(std::uint32_t) == 0;
    std::string copy;
    if (bytes.empty() || !begins_a_word) {
        copy.reserve(bytes.size() + 64); // on the heap, not in the string object
        copy.assign(bytes.begin(), bytes.end());
        bytes = copy;
    }
    boost::uuids::uuid space;
    std::ranges::copy(before, space.begin());
    const boost::uuids::uuid name =
        boost::uuids::name_generator_md5(space)(bytes.data(), bytes.size());
    Digest digest;
    std::ranges::copy(name, digest.begin());
    return digest;
}

std::span<const char> as_bytes(const Digest& digest)
{
    return {reinterpret_cast<const char*>(digest.data()), digest.size()};
}

} // namespace

std::string digest_text(const Digest& digest)
{
    return fmt::format("{:02x}", fmt::join(digest, ""));
}

void RunningDigest::add(std::span<const char> bytes)
{
    if (!rest_.empty()) {
        const auto head = bytes.first(std::min(bytes.size(), kBlockBytes - rest_.size()));
        rest_.insert(rest_.end(), head.begin(), head.end());
        bytes = bytes.subspan(head.size());
        if (rest_.size() < kBlockBytes) return;
        const Digest block = chained({}, rest_);
        chain_ = chained(chain_, as_bytes(block));
        rest_.clear();
    }
    std::vector<Digest> blocks(bytes.size() / kBlockBytes);
    parallel_for(
        blocks.size(),
        [&](std::size_t i) {
            blocks[i] = chained({}, bytes.subspan(i * kBlockBytes, kBlockBytes));
        },
        1);
    for (const Digest& block : blocks) {
        chain_ = chained(chain_, as_bytes(block));
    }
    const auto rest = bytes.subspan(blocks.size() * kBlockBytes);
    rest_.assign(rest.begin(), rest.end());
}

Digest RunningDigest::value() const
{
    return chained(chain_, rest_);
}

Digest digest_of(std::span<const char> bytes)
{
    RunningDigest digest;
    digest.add(bytes);
    return digest.value();
}

Digest digest_of_file(const std::filesystem::path& path, const Progress& progress)
{
    constexpr std::size_t kPieceBytes = 16 * kBlockBytes;
    const MappedFile file(path);
    RunningDigest digest;
    for (std::size_t done = 0; done < file.bytes().size(); done += kPieceBytes) {
        const auto left = file.bytes().subspan(done);
        digest.add(left.first(std::min(left.size(), kPieceBytes)));
        file.release(done); // read pages need not stay in memory
        progress.report(static_cast<double>(done), static_cast<double>(file.bytes().size()));
    }
    return digest.value();
}

} // namespace vcarve
