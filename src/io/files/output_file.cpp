#include "io/files/output_file.h"

#include "vcarve/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

namespace vcarve {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, std::string_view reason)
{
    throw UsageError(fmt::format("cannot write {}: {}", path.string(), reason));
}

/// The file that a write to `path` replaces: the target if `path` is a symbolic link, which stays.
fs::path followed(const fs::path& path)
{
    std::error_code error;
    const fs::path real = fs::is_symlink(path, error) ? fs::canonical(path, error) : path;
    return error ? path : real;
}

fs::path folder_of(const fs::path& path)
{
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Throws UsageError if `target` cannot be written for a reason that shows before it is opened.
void require_sound_target(const fs::path& path, const fs::path& target)
{
    if (path.empty()) refuse("the output", "its path is empty");
    std::error_code error;
    const fs::file_status status = fs::status(target, error);
    if (fs::is_directory(status)) refuse(path, "it is a folder");
    if (!path.has_filename()) refuse(path, "it names a folder, not a file");
    const bool can_stand =
        !fs::exists(status) || fs::is_regular_file(status) || fs::is_character_file(status);
    if (!can_stand) refuse(path, "it is neither a file nor a character device");
    if (fs::exists(status) && ::access(target.c_str(), W_OK) != 0) {
        refuse(path, std::strerror(errno));
    }
    const std::string reason = error.message();
    const fs::path folder = folder_of(target);
    const fs::file_type type = fs::status(folder, error).type();
    if (type == fs::file_type::not_found) {
        refuse(path, fmt::format("the folder {} does not exist", folder.string()));
    }
    if (type != fs::file_type::none && type != fs::file_type::directory) {
        refuse(path, fmt::format("{} is not a folder", folder.string()));
    }
    // For example circular links
    if (!fs::status_known(status) && fs::is_symlink(target, error)) refuse(path, reason);
}

bool is_device(const fs::path& target)
{
    std::error_code error;
    return fs::is_character_file(target, error);
}

/// Opens the temporary file `part`, or the target if `part` is empty. Deletes an existing temporary
/// file: it belongs to a dead process with the same PID.
int open_for_writing(const fs::path& path, const fs::path& target, const fs::path& part)
{
    require_sound_target(path, target);
    if (part.empty()) {
        const int device = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
        if (device < 0) refuse(path, std::strerror(errno));
        return device;
    }
    ::unlink(part.c_str());
    struct stat replaced = {};
    const bool exists = ::stat(target.c_str(), &replaced) == 0;
    const int descriptor =
        ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, exists ? 0600 : 0666);
    if (descriptor < 0) {
        refuse(path, fmt::format("the system allows no new file in the folder {} ({})",
                                 folder_of(target).string(), std::strerror(errno)));
    }
    // This fails on file systems without permissions, where all files have the same mode.
    if (exists) static_cast<void>(::fchmod(descriptor, replaced.st_mode & 0777));
    return descriptor;
}

} // namespace

OutputFile::Sink::Sink() : buffer_(1 << 16)
{
    setp(buffer_.data(), buffer_.data() + buffer_.size());
}

bool OutputFile::Sink::write_all(const char* bytes, std::size_t count)
{
    while (count > 0 && error_ == 0) {
        const ssize_t written = ::write(descriptor_, bytes, count);
        if (written >= 0) {
            bytes += written;
            count -= static_cast<std::size_t>(written);
        } else if (errno != EINTR) {
            error_ = errno;
        }
    }
    return error_ == 0;
}

bool OutputFile::Sink::flush()
{
    const bool whole = write_all(pbase(), static_cast<std::size_t>(pptr() - pbase()));
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return whole;
}

OutputFile::Sink::int_type OutputFile::Sink::overflow(int_type byte)
{
    if (!flush()) return traits_type::eof();
    if (!traits_type::eq_int_type(byte, traits_type::eof())) {
        sputc(traits_type::to_char_type(byte));
    }
    return traits_type::not_eof(byte);
}

std::streamsize OutputFile::Sink::xsputn(const char* bytes, std::streamsize count)
{
    // Large blocks bypass the buffer.
    if (count < static_cast<std::streamsize>(buffer_.size() / 4)) {
        return std::streambuf::xsputn(bytes, count);
    }
    return flush() && write_all(bytes, static_cast<std::size_t>(count)) ? count : 0;
}

OutputFile::OutputFile(std::filesystem::path path)
    : path_(std::move(path)),
      target_(followed(path_)),
      part_(is_device(target_) ? fs::path() : part_path(path_)),
      stream_(&sink_),
      descriptor_(open_for_writing(path_, target_, part_))
{
    sink_.write_to(descriptor_);
}

OutputFile::~OutputFile()
{
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!part_.empty()) ::unlink(part_.c_str());
}

void OutputFile::commit()
{
    sink_.flush();
    int error = sink_.error();
    // Some file systems report that they are full only here or on closing. A device cannot sync.
    if (error == 0 && !part_.empty() && ::fsync(descriptor_) != 0) error = errno;
    if (::close(std::exchange(descriptor_, -1)) != 0 && error == 0) error = errno;
    if (error == 0 && !part_.empty() && ::rename(part_.c_str(), target_.c_str()) != 0) {
        error = errno;
    }
    if (error != 0) refuse(path_, std::strerror(error));
    part_.clear();
}

std::filesystem::path part_path(const std::filesystem::path& path)
{
    fs::path part = followed(path);
    part += fmt::format(".part-{}", ::getpid());
    return part;
}

void require_writable(const std::filesystem::path& path)
{
    const OutputFile probe(path);
}

void print(std::string_view text)
{
    const std::size_t written = std::fwrite(text.data(), 1, text.size(), stdout);
    // fflush() reports errors of buffered bytes, ferror() those of earlier flushes.
    if (std::fflush(stdout) == 0 && written == text.size() && std::ferror(stdout) == 0) return;
    throw UsageError("cannot write to the standard output");
}

} // namespace vcarve
