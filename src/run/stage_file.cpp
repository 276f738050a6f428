#include "run/stage_file.h"

#include "vcarve/error.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

constexpr std::array<char, 16> kMagic = {'v', 'c', 'a', 'r', 'v',  'e',  ' ', 's',
                                         't', 'a', 'g', 'e', '\r', '\n', 0,   1};
constexpr std::uint64_t kVersion = 5;
/// Content is written, read and digested in pieces of this size.
constexpr std::size_t kPieceBytes = 16 << 20;

/// The header as in the file, without padding bytes.
struct Header {
    std::array<char, 16> magic = kMagic;
    std::uint64_t version = kVersion;
    std::uint64_t bytes = 0; ///< size of the content
    Digest job{};
    std::array<char, StageLabel::kLongestName + 1> name{};
};

std::span<const char> bytes_of(const Header& header)
{
    return {reinterpret_cast<const char*>(&header), sizeof(header)};
}

void write_digest(std::ostream& out, const Digest& digest)
{
    out.write(reinterpret_cast<const char*>(digest.data()), digest.size());
}

} // namespace

StageWriter::StageWriter(const std::filesystem::path& path, const StageLabel& label,
                         std::uint64_t bytes)
    : file_(std::in_place, path)
{
    Header header;
    header.bytes = bytes;
    header.job = label.job;
    label.name.copy(header.name.data(), StageLabel::kLongestName);
    file_->stream().write(reinterpret_cast<const char*>(&header), sizeof(header));
    write_digest(file_->stream(), digest_of(bytes_of(header)));
}

void StageWriter::put_bytes(const void* data, std::size_t count)
{
    if (!file_) {
        done_ += count;
        return;
    }
    for (std::span<const char> left(static_cast<const char*>(data), count); !left.empty();) {
        const auto piece = left.first(std::min(left.size(), kPieceBytes));
        file_->stream().write(piece.data(), static_cast<std::streamsize>(piece.size()));
        digest_.add(piece);
        done_ += piece.size();
        left = left.subspan(piece.size());
        // Report a full disk at once.
        if (!file_->stream()) file_->commit();
    }
}

void StageWriter::commit()
{
    write_digest(file_->stream(), digest_.value());
    file_->commit();
}

StageReader::StageReader(std::filesystem::path path, const StageLabel& label)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "rbe"), &std::fclose)
{
    if (!file_) refuse(fmt::format("it cannot be opened: {}", std::strerror(errno)));
    read_header(label);
}

void StageReader::read_header(const StageLabel& label)
{
    struct stat status = {};
    if (::fstat(::fileno(file_.get()), &status) != 0) refuse(std::strerror(errno));
    const auto found = static_cast<std::uint64_t>(status.st_size);
    constexpr std::uint64_t kFrame = sizeof(Header) + 2 * sizeof(Digest);
    if (found < kFrame) {
        refuse(
            fmt::format("it is truncated: it has {} bytes, expected at least {}", found, kFrame));
    }
    Header header;
    Digest digest{};
    read(&header, sizeof(header));
    read(digest.data(), sizeof(digest));
    if (header.magic != kMagic) refuse("it is not a stage file");
    if (digest != digest_of(bytes_of(header))) {
        refuse("its header is damaged: the digest does not match");
    }
    if (header.version != kVersion) {
        refuse(fmt::format("its layout version is {}, expected {}", header.version, kVersion));
    }
    if (header.name.data() != label.name) {
        refuse(fmt::format("it contains stage {}, expected {}", header.name.data(), label.name));
    }
    if (header.job != label.job) refuse("it was made from other input or options");
    if (found != header.bytes + kFrame) {
        refuse(fmt::format("it has {} bytes, but its header records {}", found,
                           header.bytes + kFrame));
    }
    bytes_ = header.bytes;
}

void StageReader::read(void* data, std::size_t count)
{
    errno = 0;
    if (std::fread(data, 1, count, file_.get()) == count) return;
    refuse(std::ferror(file_.get()) != 0
               ? fmt::format("it cannot be read: {}", std::strerror(errno))
               : std::string("it was truncated while it was read"));
}

void StageReader::get_bytes(void* data, std::size_t count)
{
    if (count > bytes_ - done_) refuse("its content is damaged: an entry is too long");
    for (std::span<char> left(static_cast<char*>(data), count); !left.empty();) {
        const auto piece = left.first(std::min(left.size(), kPieceBytes));
        read(piece.data(), piece.size());
        digest_.add(piece);
        done_ += piece.size();
        left = left.subspan(piece.size());
    }
}

std::size_t StageReader::get_count(std::size_t item_bytes)
{
    std::uint64_t count = 0;
    get(count);
    if (count > (bytes_ - done_) / item_bytes) {
        refuse(fmt::format("its content is damaged: it records {} entries of at least {} bytes, "
                           "but only {} bytes are left",
                           count, item_bytes, bytes_ - done_));
    }
    return count;
}

void StageReader::finish()
{
    Digest expected{};
    read(expected.data(), sizeof(expected));
    const Digest found = digest_.value();
    if (done_ != bytes_ || found != expected) {
        refuse(fmt::format("its content is damaged: {} of {} bytes have the digest {}, "
                           "expected {}",
                           done_, bytes_, digest_text(found), digest_text(expected)));
    }
}

void StageReader::refuse(std::string_view what) const
{
    throw InputError(fmt::format("{}: {}", path_.string(), what));
}

} // namespace vcarve
